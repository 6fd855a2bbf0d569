#include "app/offline_denoiser.hpp"

#include <cassert>
#include <utility>

#include "app/options.hpp"

namespace gyrod::app {
namespace {

double clock_that_stands_still() { return 0.0; }

}  // namespace

OfflineDenoiser::OfflineDenoiser(const settings::Settings& settings, RowHandler& handler,
                                 DenoiseSummary& summary, OfflineChoice choice)
    : handler_(handler),
      summary_(summary),
      choice_(std::move(choice)),
      noise_(settings.noise, remembered_noise(settings.noise)),
      engine_(offline_engine_options(settings, noise_), method(settings), *this, clock_that_stands_still) {}

void OfflineDenoiser::push(files::RecordingRow& row) {
  waiting_.push_back({std::move(row.text), row.sample.rate_radps, true});
  // A refused sample releases nothing, so the row's fate is known before anyone asks for it.
  waiting_.back().accepted = engine_.push(choice_.sensor, {&row.sample, 1}) == 1;
  hand_on();
}

void OfflineDenoiser::finish() {
  engine_.end_of_stream(choice_.sensor);
  hand_on();
  hand_on_refused();
  assert(waiting_.empty());
}

void OfflineDenoiser::hand_on() {
  for (const stream::DenoisedSample& sample : released_) {
    hand_on_refused();
    const WaitingRow row = std::move(waiting_.front());
    waiting_.pop_front();
    summary_.add(row.measured_radps, sample.rate_radps);
    handler_.on_denoised(row.text, sample.rate_radps, sample.rate_std_radps);
  }
  released_.clear();
}

/// Rows at the front whose samples will never be released.
void OfflineDenoiser::hand_on_refused() {
  while (!waiting_.empty() && !waiting_.front().accepted) {
    handler_.on_refused(waiting_.front().text);
    waiting_.pop_front();
  }
}

void OfflineDenoiser::on_samples(std::string_view, std::span<const stream::DenoisedSample> samples) noexcept {
  if (choice_.estimate == EstimateKind::kDenoised)
    released_.insert(released_.end(), samples.begin(), samples.end());
}

void OfflineDenoiser::on_realtime(std::string_view,
                                  std::span<const stream::DenoisedSample> samples) noexcept {
  if (choice_.estimate == EstimateKind::kRealtime)
    released_.insert(released_.end(), samples.begin(), samples.end());
}

void OfflineDenoiser::on_report(std::string_view, const stream::NoiseReport& report) noexcept {
  summary_.add(report);
}

void OfflineDenoiser::on_end(std::string_view) noexcept {}

}  // namespace gyrod::app
