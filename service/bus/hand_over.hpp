/// What a subscriber hands over while it ends. Internal to bus/.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bus/subscriber.hpp"

namespace gyrod::bus {

/// Hands over at once, or keeps for later.
class HandOver final : public SampleHandler {
 public:
  explicit HandOver(SampleHandler& handler) : handler_(handler) {}

  void on_samples(std::string_view sensor, std::span<const stream::Sample> samples) noexcept override {
    if (!keeping_) return handler_.on_samples(sensor, samples);
    kept_.push_back({std::string(sensor), Kept::Kind::kSamples, {samples.begin(), samples.end()}});
  }
  void on_end(std::string_view sensor) noexcept override {
    if (!keeping_) return handler_.on_end(sensor);
    kept_.push_back({std::string(sensor), Kept::Kind::kEnd, {}});
  }
  void on_return(std::string_view sensor) noexcept override {
    if (!keeping_) return handler_.on_return(sensor);
    kept_.push_back({std::string(sensor), Kept::Kind::kReturn, {}});
  }
  /// While all that is left is handed over nothing needs to be told of why it ends.
  void on_broken_promise(std::string_view sensor, stream::ChannelState why) noexcept override {
    if (!keeping_) handler_.on_broken_promise(sensor, why);
  }

  void keep() noexcept { keeping_ = true; }
  void hand_over_kept() noexcept {
    keeping_ = false;
    for (const Kept& kept : kept_) {
      if (kept.kind == Kept::Kind::kSamples) handler_.on_samples(kept.sensor, kept.samples);
      if (kept.kind == Kept::Kind::kEnd) handler_.on_end(kept.sensor);
      if (kept.kind == Kept::Kind::kReturn) handler_.on_return(kept.sensor);
    }
    kept_.clear();
  }

 private:
  struct Kept {
    enum class Kind { kSamples, kEnd, kReturn };
    std::string sensor;
    Kind kind;
    std::vector<stream::Sample> samples;
  };

  SampleHandler& handler_;
  bool keeping_ = false;
  std::vector<Kept> kept_;
};

}  // namespace gyrod::bus
