/// Which of the samples that this daemon releases it publishes, where several daemons have the same output. Internal to bus/.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <ranges>
#include <span>
#include <vector>

#include "stream/sample.hpp"

namespace gyrod::bus {

/// Time for one that starts, or was stopped for a while, to find those that run and to hear what they have published.
inline constexpr double kTimeToLook_s = 1.0;

/// What is known of the other daemons.
struct Others {
  bool any = false;       ///< there is another one
  bool stronger = false;  ///< and one that is stronger than this
  bool looked = true;     ///< there has been time to find them, and to hear what they published
  /// When a stronger one last said that it is alive; readers drop what a weaker one sends until they have noticed that it does not.
  double stronger_lived_s = std::numeric_limits<double>::lowest();
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
///   nobody else is there or was, or this one is the strongest and the sensor is at its first sample;
///   this one is the strongest, and what it holds continues what has been published: the takeover back, without a seam;
///   a sample has been held for takeover_s, and no stronger one has given a sign of life for half of that;
///   a stronger one lives, but has not published the sensor: after twice takeover_s. What one that lives has published stays its own in
///   the readers: they would drop the sample.
/// What one daemon releases at once another may still have in its window, up to a whole release of it. So the strongest, where samples
/// are missing before its first or it has not heard where the others are, leaves them time until its next release has been held
/// for takeover_s and kTimeToLook_s: by then they have published what is missing, if they have it.
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
    complete_ = false;
    for (const Sample& sample : samples) {
      if (size_ == held_.size()) grow();
      Held& held = held_[(first_ + size_++) % held_.size()];
      held.sample = sample;
      held.since_s = now_s;
    }
  }

  /// No more will be released, but for a sensor that begins anew.
  void complete() noexcept { complete_ = true; }

  /// Another daemon has published the sensor's samples up to this one.
  void hear(const stream::PublishedMark& newest, bool from_stronger) noexcept {
    ended_s_.reset();
    heard_ = true;
    owned_ = from_stronger;
    if (from_stronger) active_ = false;
    if (active_ && rules_.exclusive) return;
    mark_ = newest;
    let_go_heard();
  }

  /// The other has left, or gives no sign of life, or has no more of the sensor. Where readers take all that comes, what it published is not
  /// published again by one that releases it a little later, but may begin anew after that.
  void hear_end(double now_s) noexcept {
    owned_ = false;
    if (!rules_.exclusive) ended_s_ = now_s;
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
    if (active_ && rules_.exclusive) mark_ = last_;
  }

  [[nodiscard]] bool active() const noexcept { return active_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Samples that were published elsewhere and not here.
  [[nodiscard]] std::uint64_t let_go() const noexcept { return let_go_; }
  /// Times that this one went on where another had published.
  [[nodiscard]] std::uint64_t takeovers() const noexcept { return takeovers_; }

 private:
  /// A writer's lease is the other half: readers that notice its end later than this daemon have this part of takeover_s for it.
  static constexpr double kMargin = 0.5;
  /// So many takeover_s a sample is held where a stronger one is alive and has not published the sensor.
  static constexpr double kPatience = 2.0;

  struct Held {
    Sample sample;
    double since_s = 0.0;
  };

  void let_go_heard() noexcept {
    while (!active_ && size_ > 0 && is_published(mark_of(front().sample))) {
      drop();
      ++let_go_;
    }
  }

  [[nodiscard]] const Held& front() const noexcept { return held_[first_]; }

  void drop() noexcept {
    last_ = mark_of(front().sample);
    first_ = (first_ + 1) % held_.size();
    --size_;
  }

  void grow() {
    std::rotate(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(first_), held_.end());
    first_ = 0;
    held_.resize(std::max<std::size_t>(64, 2 * held_.size()));
  }

  static stream::PublishedMark mark_of(const Sample& sample) noexcept {
    return {sample.sequence, sample.stamp_ns};
  }

  [[nodiscard]] bool is_published(const stream::PublishedMark& sample) const noexcept {
    return mark_ && sample.sequence <= mark_->sequence && sample.stamp_ns <= mark_->stamp_ns;
  }

  /// Whether the next sample after those that were published is the first that is held.
  [[nodiscard]] bool continues() const noexcept {
    return mark_ && (front().sample.sequence == mark_->sequence + 1 || (last_ && is_published(*last_)));
  }

  [[nodiscard]] bool may_publish(double now_s, const Others& others) const noexcept {
    if (size_ >= rules_.most) return true;
    if (!others.looked) return false;
    if (!others.any && !heard_) return true;
    const bool strongest = others.any && !others.stronger;
    if (rules_.exclusive) return strongest ? may_take_back(now_s) : may_stand_in(now_s, others);
    if (strongest && !mark_) return true;
    const double since_s = std::max(front().since_s, unsure_until_s_);
    return !others.any || now_s - since_s >= rules_.takeover_s;
  }

  [[nodiscard]] bool may_take_back(double now_s) const noexcept {
    if (continues() || (!mark_ && front().sample.sequence == 0)) return true;
    const auto next = next_release_s();
    return next && now_s - *next >= rules_.takeover_s + kTimeToLook_s;
  }

  /// Where another has just left, readers may not know it yet, and would drop what comes at once.
  [[nodiscard]] bool may_stand_in(double now_s, const Others& others) const noexcept {
    const double held_s = now_s - front().since_s;
    if (now_s - others.stronger_lived_s < kMargin * rules_.takeover_s)
      return !owned_ && held_s >= kPatience * rules_.takeover_s;
    return held_s >= rules_.takeover_s;
  }

  /// When the samples were released that came after the first that is held, or that first one where no more will come.
  [[nodiscard]] std::optional<double> next_release_s() const noexcept {
    if (complete_) return front().since_s;
    const auto at = [this](std::size_t i) { return held_[(first_ + i) % held_.size()].since_s; };
    const auto all = std::views::iota(std::size_t{0}, size_);
    const auto next =
        std::ranges::partition_point(all, [&](std::size_t i) { return at(i) <= front().since_s; });
    return next == all.end() ? std::nullopt : std::optional(at(*next));
  }

  HoldRules rules_;
  bool active_ = false;
  bool heard_ = false;                         ///< another one has ever published
  double unsure_until_s_ = 0.0;                ///< when others had not been looked for long enough, last
  bool owned_ = false;                         ///< readers have it from a stronger one, while that lives
  bool complete_ = false;                      ///< all has been released
  std::optional<stream::PublishedMark> mark_;  ///< the newest that was heard, or published here
  std::optional<stream::PublishedMark> last_;  ///< the one before those that are held
  std::optional<double> ended_s_;              ///< when the other left, since it was heard
  std::vector<Held> held_;                     ///< ring
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  std::uint64_t let_go_ = 0;
  std::uint64_t takeovers_ = 0;
};

}  // namespace gyrod::bus
