/// What the engine does about once a second besides samples: health, and the coefficients of the Allan curves.
#include <algorithm>

#include "core/allan/noise_coefficients.hpp"
#include "core/allan/online_allan.hpp"
#include "stream/engine_impl.hpp"

namespace gyrod::stream {

void Engine::Impl::judge_health() {
  const double now_s = clock_();
  // While push() waits for workers nobody is heard, which says nothing of the sensors.
  const HealthContext context{now_s, waits_ ? now_s : deaf_until_s_.load(), 0};
  judged_.clear();
  registry_.for_each(options_.max_channels, [this](Channel& channel) { judged_.push_back(&channel); });
  HealthCounts by_health{};
  HealthCounts changes{};
  unsigned overload_step = 0;
  for (Channel* channel : judged_) {  // only this thread removes channels
    const Channel::Judgement judgement = channel->judge_health(context);
    ++by_health[static_cast<std::size_t>(judgement.now.state)];
    overload_step = std::max(overload_step, judgement.overload_step);
    if (!judgement.changed) continue;
    ++changes[static_cast<std::size_t>(judgement.now.state)];
    sink_.on_health(channel->sensor(), judgement.before, judgement.now);
  }
  const std::lock_guard lock(health_mutex_);
  by_health_ = by_health;
  overload_step_ = overload_step;
  for (std::size_t i = 0; i < kHealthStates; ++i) health_changes_[i] += changes[i];
}

/// In turn, so that every sensor gets its fit.
void Engine::Impl::fit_curves() {
  judged_.clear();
  registry_.for_each(options_.max_channels, [this](Channel& channel) { judged_.push_back(&channel); });
  for (std::size_t i = 0; i < judged_.size(); ++i) {
    Channel& channel = *judged_[(next_to_fit_ + i) % judged_.size()];
    double rate_hz = 0.0;
    const auto curves = channel.curves_to_fit(rate_hz);
    if (!curves || !(rate_hz > 0.0)) continue;
    std::array<core::NoiseCoefficients, kAxes> coefficients{};
    for (std::size_t axis = 0; axis < kAxes; ++axis)
      coefficients[axis] = core::fit_coefficients(core::allan_points((*curves)[axis], rate_hz));
    channel.keep_fit(*curves, coefficients);
    next_to_fit_ = (next_to_fit_ + i + 1) % judged_.size();
    return;
  }
}

}  // namespace gyrod::stream
