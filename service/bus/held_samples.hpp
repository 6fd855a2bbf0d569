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

struct HoldRules {
  double takeover_s = 0.5;  ///< how long a sample may be missing from what others publish
  std::size_t most = 1024;  ///< samples that are held
  bool exclusive =
      true;  ///< readers choose the strongest that lives (DDS exclusive ownership); false: they take all that comes
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
/// Where readers take all that comes (HoldRules::exclusive), two active ones would show. There the strongest takes nothing back: who
/// publishes goes on until it is not heard for takeover_s, by whoever waits, or leaves, and then the next one goes on at once.
///
/// Grows to what is held, at most `most` samples: then the oldest is published, and counts as missing elsewhere.
///
/// @tparam Sample has sequence and stamp_ns; of a sensor that does not count, all sequences are 0
template <class Sample>
class HeldSamples {
 public:
  explicit HeldSamples(const HoldRules& rules) : rules_(rules) {}

  /// The engine has released these.
  void release(std::span<const Sample> samples, double now_s) {
    if (ended_s_ && now_s - *ended_s_ > rules_.takeover_s) mark_.reset();
    for (const Sample& sample : samples) {
      if (size_ == held_.size()) grow();
      Held& held = held_[(first_ + size_++) % held_.size()];
      held.sample = sample;
      held.since_s = now_s;
    }
  }

  /// Another daemon has published the sensor's samples up to this one.
  void hear(const stream::PublishedMark& newest, bool from_stronger) noexcept {
    mark_ = newest;
    ended_s_.reset();
    heard_ = true;
    if (from_stronger) active_ = false;
    let_go_heard();
  }

  /// Nobody else has the sensor any more: it has ended there, and may begin anew. Where readers take all that comes, it is the other that has
  /// left: what it published is not published again by one that releases it a little later.
  void hear_end(double now_s) noexcept {
    if (rules_.exclusive) {
      mark_.reset();
    } else {
      ended_s_ = now_s;
    }
  }

  /// This daemon was stopped for a while, and another may publish by now.
  void doubt() noexcept { active_ = false; }

  /// Calls publish(sample) for what is to be published now, oldest first. Call it after each of the above, and when time has passed.
  template <class Publish>
  void take(double now_s, const Others& others, const Publish& publish) {
    let_go_heard();
    if (!others.looked) unsure_until_s_ = now_s;
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
    Sample sample;
    double since_s = 0.0;
  };

  void let_go_heard() noexcept {
    while (!active_ && size_ > 0 && is_published(front().sample)) {
      drop();
      ++let_go_;
    }
  }

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

  [[nodiscard]] bool is_published(const Sample& sample) const noexcept {
    return mark_ && sample.sequence <= mark_->sequence && sample.stamp_ns <= mark_->stamp_ns;
  }

  [[nodiscard]] bool may_publish(double now_s, const Others& others) const noexcept {
    if (size_ >= rules_.most) return true;
    if (!others.looked) return false;
    if (!others.any && !heard_) return true;
    const bool strongest = others.any && !others.stronger;
    if (strongest && !mark_) return true;
    if (!rules_.exclusive) {
      const double since_s = std::max(front().since_s, unsure_until_s_);
      return !others.any || now_s - since_s >= rules_.takeover_s;
    }
    if (strongest && front().sample.sequence == mark_->sequence + 1) return true;
    // Where another has just left, readers may not know it yet, and would drop what comes at once.
    return now_s - front().since_s >= (strongest ? kStrongest : 1.0) * rules_.takeover_s;
  }

  HoldRules rules_;
  bool active_ = false;
  bool heard_ = false;                         ///< another one has ever published
  double unsure_until_s_ = 0.0;                ///< when others had not been looked for long enough, last
  std::optional<stream::PublishedMark> mark_;  ///< the newest that was heard
  std::optional<double> ended_s_;              ///< when the other left, since it was heard
  std::vector<Held> held_;                     ///< ring
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  std::uint64_t let_go_ = 0;
  std::uint64_t takeovers_ = 0;
};

}  // namespace gyrod::bus
