// What a sensor keeps and sends once more: what has left already fills the window and does not leave again.
#include <algorithm>

#include "stream/channel.hpp"

namespace gyrod::stream {
namespace {

/// Another process has told how far it has served the sensor. Where the network loses packets the same samples reach two hosts at times
/// that are many seconds apart.
constexpr double kLongestHandOver_s = 60.0;
/// A sensor that was not heard for so long may have been out of sight: DDS's leases are longer.
constexpr double kOutOfSight_s = 1.0;
/// A process that goes on after a pause takes what has waited, and is told within this time whom it has lost meanwhile.
constexpr double kJustHeard_s = 5.0;

}  // namespace

bool Channel::heard_again_after_longer(double now_s) const noexcept {
  return heard_again_s_ && now_s - *heard_again_s_ <= kJustHeard_s && now_s - heard_s_ < silence_s_;
}

void Channel::note_silence(double now_s) noexcept {
  if (asleep || heard_again_after_longer(now_s)) return;
  before_silence_ = last_published();
}

void Channel::lose_sight(double now_s) noexcept {
  seen_ = asleep || heard_again_after_longer(now_s) ? before_silence_ : last_published();
}

/// The newest sample that has left, or that need not leave. What a worker is about to send counts as held.
std::optional<PublishedMark> Channel::last_published() const noexcept {
  std::uint64_t held = counts().in_flight;
  const Position oldest = std::max(Position{0}, ring.end() - static_cast<Position>(ring.capacity()));
  for (Position position = ring.end() - 1; position >= oldest; --position) {
    if (held == 0) {
      const Sample sample = ring.at(position);
      return PublishedMark{sample.sequence, sample.stamp_ns};
    }
    if (ring.released(position)) --held;
  }
  return std::nullopt;
}

void Channel::expect_history() noexcept {
  published_before_ = seen_;
  history_until_s_.reset();
  history_lasts_s_ = kLongestHistory_s;
}

void Channel::continue_after(const PublishedMark& mark) noexcept {
  // What this process knows itself is older, but where it is ahead in both.
  const bool ahead = published_before_ && published_before_->sequence > mark.sequence &&
                     published_before_->stamp_ns > mark.stamp_ns;
  if (!ahead) published_before_ = mark;
  history_until_s_.reset();
  history_lasts_s_ = kLongestHandOver_s;
}

std::optional<PublishedMark> Channel::taken_up_to() const noexcept {
  if (published_before_ || ring.end() == 0) return published_before_;
  const Sample newest = ring.at(ring.end() - 1);
  return PublishedMark{newest.sequence, newest.stamp_ns};
}

bool Channel::is_history(const Sample& sample) noexcept {
  if (!published_before_) return false;
  const bool known =
      sample.sequence <= published_before_->sequence && sample.stamp_ns <= published_before_->stamp_ns;
  if (!known) end_history();
  return known;
}

/// Before the channel is heard at now_s.
void Channel::look_for_history(double now_s) {
  if (ring.end() > 0 && now_s - heard_s_ >= kOutOfSight_s && !heard_again_after_longer(now_s)) {
    note_silence(now_s);  // what is held leaves only now
    silence_s_ = now_s - heard_s_;
    heard_again_s_ = now_s;
  }
  if (!published_before_) return;
  if (!history_until_s_) history_until_s_ = now_s + history_lasts_s_;
  if (now_s > *history_until_s_) end_history();
}

}  // namespace gyrod::stream
