/// Which of the samples that this daemon releases it publishes, where several daemons have the same output. Internal to bus/.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "stream/sample.hpp"

namespace gyrod::bus {

/// What is known of the other daemons.
struct Others {
  bool any = false;       ///< there is another one
  bool stronger = false;  ///< and one that is stronger than this
  bool looked = true;     ///< there has been time to find them, and to hear what they published
};

/// The released samples of one sensor, until they are published here or another daemon has published them. A function of what it is
/// told and of the time it is told; no clock.
///
/// At any time a sensor is published by one daemon, the *active* one. The others hold what they release, let go what they hear from
/// the active one, and publish what they do not hear for `takeover_s`: a daemon that dies, stops or loses a sensor's input is
/// replaced, and the first sample that comes from the next one is the first that was missing. Who turns active:
///   nobody else is there or was, or this one is the strongest and nobody has published the sensor;
///   this one is the strongest, and what it holds continues what the other has published: the takeover back, without a seam;
///   a sample has been held for takeover_s; by the strongest for a quarter of it.
/// Who hears a stronger one turns passive. An active one publishes all that it releases, whatever weaker ones did meanwhile: as long as it
/// says that it is alive, readers drop what those send.
///
/// Grows to what is held, at most `most` samples: then the oldest is published, and counts as missing elsewhere.
class HeldSamples {
 public:
  HeldSamples(double takeover_s, std::size_t most) : takeover_s_(takeover_s), most_(most) {}

  /// The engine has released these.
  void release(std::span<const stream::DenoisedSample> samples, double now_s) {
    for (const stream::DenoisedSample& sample : samples) {
      if (size_ == held_.size()) grow();
      held_[(first_ + size_++) % held_.size()] = {sample, now_s};
    }
  }

  /// Another daemon has published the sensor's samples up to this one.
  void hear(const stream::PublishedMark& newest, bool from_stronger) noexcept {
    mark_ = newest;
    heard_ = true;
    if (from_stronger) active_ = false;
  }

  /// Nobody else has the sensor any more: it has ended there, or the other is gone.
  void hear_end() noexcept { mark_.reset(); }

  /// This daemon was stopped for a while, and another may publish by now.
  void doubt() noexcept { active_ = false; }

  /// Calls publish(sample) for what is to be published now, oldest first. Call it after each of the above, and when time has passed.
  template <class Publish>
  void take(double now_s, const Others& others, const Publish& publish) {
    while (!active_ && size_ > 0 && is_published(front().sample)) {
      drop();
      ++let_go_;
    }
    if (size_ == 0) return;
    if (!active_ && may_publish(now_s, others)) {
      active_ = true;
      if (heard_) ++takeovers_;
    }
    for (; active_ && size_ > 0; drop()) publish(front().sample);
  }

  [[nodiscard]] bool active() const noexcept { return active_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Samples that were published elsewhere and not here.
  [[nodiscard]] std::uint64_t let_go() const noexcept { return let_go_; }
  /// Times that this one went on where another had published.
  [[nodiscard]] std::uint64_t takeovers() const noexcept { return takeovers_; }

 private:
  /// The strongest waits for this part of takeover_s, so that no other one takes over meanwhile.
  static constexpr double kStrongest = 0.25;

  struct Held {
    stream::DenoisedSample sample;
    double since_s = 0.0;
  };

  [[nodiscard]] const Held& front() const noexcept { return held_[first_]; }

  void drop() noexcept {
    first_ = (first_ + 1) % held_.size();
    --size_;
  }

  void grow() {
    std::rotate(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(first_), held_.end());
    first_ = 0;
    held_.resize(std::max<std::size_t>(64, 2 * held_.size()));
  }

  [[nodiscard]] bool is_published(const stream::DenoisedSample& sample) const noexcept {
    return mark_ && sample.sequence <= mark_->sequence && sample.stamp_ns <= mark_->stamp_ns;
  }

  [[nodiscard]] bool may_publish(double now_s, const Others& others) const noexcept {
    if (size_ >= most_) return true;
    if (!others.looked) return false;
    const bool strongest = others.any && !others.stronger;
    const bool continues = mark_ && front().sample.sequence == mark_->sequence + 1;
    if (strongest && (continues || !mark_)) return true;
    // Where another has just left, readers may not know it yet, and would drop what comes at once.
    if (!others.any && !heard_) return true;
    return now_s - front().since_s >= (strongest ? kStrongest * takeover_s_ : takeover_s_);
  }

  double takeover_s_;
  std::size_t most_;
  bool active_ = false;
  bool heard_ = false;                         ///< another one has ever published
  std::optional<stream::PublishedMark> mark_;  ///< the newest that was heard
  std::vector<Held> held_;                     ///< ring
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  std::uint64_t let_go_ = 0;
  std::uint64_t takeovers_ = 0;
};

}  // namespace gyrod::bus
