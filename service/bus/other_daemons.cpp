#include "bus/other_daemons.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

namespace gyrod::bus {
namespace {

/// How long what another daemon has published may wait to be looked at.
constexpr double kLongestTick_s = 0.02;

/// Other daemons that are looked at; more would be a mistake.
constexpr std::size_t kMostOthers = 16;

std::uint32_t strength_of(dds_entity_t reader, dds_instance_handle_t writer) {
  dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(reader, writer);
  if (endpoint == nullptr) return 0;
  std::int32_t strength = 0;
  (void)dds_qget_ownership_strength(endpoint->qos, &strength);
  dds_builtintopic_free_endpoint(endpoint);
  return static_cast<std::uint32_t>(std::max(strength, 0));
}

}  // namespace

double steady_now_s() noexcept {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double tick_s(double takeover_s) noexcept { return std::min(kLongestTick_s, takeover_s / 20.0); }

void OtherDaemons::heed(std::span<const PromiseWatch::Event> signs) {
  for (const PromiseWatch::Event& sign : signs) {
    if (sign.kind == PromiseWatch::Event::Kind::kLivelinessLost) silent_.insert(sign.handle);
    if (sign.kind == PromiseWatch::Event::Kind::kWriterBack) silent_.erase(sign.handle);
  }
}

void OtherDaemons::look(dds_entity_t reader, double now_s) {
  looked_s_ = now_s;
  std::array<dds_instance_handle_t, kMostOthers> handles{};
  const dds_return_t found = dds_get_matched_publications(reader, handles.data(), handles.size());
  const std::size_t count =
      std::min<std::size_t>(found > 0 ? static_cast<std::size_t>(found) : 0, kMostOthers);
  const auto before = std::exchange(stronger_, {});
  for (std::size_t i = 0; i < count; ++i) {
    // A writer without a strength is no daemon of these.
    if (const std::uint32_t strength = strength_of(reader, handles[i]); strength > 0)
      stronger_[handles[i]] = strength > strength_;
  }
  for (const auto& [writer, stronger] : before) {
    if (stronger_.contains(writer)) continue;
    if (left_.size() >= kMostOthers) left_.clear();
    left_[writer] = {stronger, now_s};
  }
  if (std::ranges::any_of(stronger_,
                          [this](const auto& one) { return one.second && !silent_.contains(one.first); }))
    stronger_lived_s_ = now_s;
}

bool OtherDaemons::was_stopped(double now_s) noexcept {
  if (now_s - looked_s_ < 0.5 * takeover_s_) return false;
  looked_s_ = now_s;
  if (stronger_.empty()) return false;
  looking_since_s_ = now_s;
  return true;
}

bool OtherDaemons::is_stronger(dds_instance_handle_t writer) const {
  if (const auto found = stronger_.find(writer); found != stronger_.end()) return found->second;
  const auto left = left_.find(writer);
  return left != left_.end() && left->second.stronger;
}

Others OtherDaemons::now(double now_s) const {
  const auto just_left = [now_s](const auto& one) { return now_s - one.second.since_s < kLongestTick_s; };
  const auto is_stronger_one = [&](const auto& one) { return one.second.stronger && just_left(one); };
  return {.any = !stronger_.empty() || std::ranges::any_of(left_, just_left),
          .stronger = std::ranges::any_of(stronger_, [](const auto& writer) { return writer.second; }) ||
                      std::ranges::any_of(left_, is_stronger_one),
          .looked = now_s - looking_since_s_ >= kTimeToLook_s,
          .stronger_lived_s = stronger_lived_s_};
}

}  // namespace gyrod::bus
