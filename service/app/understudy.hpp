/// What a daemon of several keeps of sensors that others serve, to go on where they stop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "bus/given_up.hpp"
#include "stream/sample.hpp"

namespace gyrod::app {

/// Two things make a hand-over without a hole and without a number twice. The daemon that gives up a sensor tells up to which sample it
/// has taken it: the mark. And the one that goes on has kept what came meanwhile: what came in the last kKept. What it then hands to the
/// engine begins before the mark, so that the window is warm, and leaves behind it.
///
/// Times are ns of one steady clock. One thread at a time.
class Understudy {
 public:
  /// Longer than news of a hand-over take, also where one packet in five is lost.
  static constexpr std::int64_t kKeptNs = 3'000'000'000;
  /// Samples kept at the most, over all sensors: some 20 MB. What no longer finds room is passed over.
  static constexpr std::size_t kMostSamples = 262'144;
  /// Sensors at the most; further ones are passed over.
  static constexpr std::size_t kMostSensors = 65'536;
  /// Where packets are lost, what was sent before the mark may come so much later.
  static constexpr std::int64_t kMarkHoldsNs = 60'000'000'000;

  /// What is known of a sensor that is to be served.
  struct Part {
    std::string sensor;
    std::vector<stream::Sample> samples;  ///< that came last, oldest first
    bool ended = false;                   ///< the sensor has ended since
  };

  /// These came of a sensor that another daemon serves, and that may come to this one.
  void follow(std::string_view sensor, std::span<const stream::Sample> samples, std::int64_t now_ns);
  /// Such a sensor has ended.
  void end(std::string_view sensor);
  /// Another daemon tells up to where it has taken sensors.
  void note(std::span<const bus::GivenUp> given, std::int64_t now_ns);

  /// Gives out, and keeps no longer, what it has of the sensors that are served now, as the daemons before have told how far they are.
  [[nodiscard]] std::vector<Part> take(const std::function<bool(std::string_view)>& now_served,
                                       std::int64_t now_ns);
  /// Keeps no longer what it has of the sensors that are served now: nobody has told how far they are.
  void drop(const std::function<bool(std::string_view)>& now_served);

  /// Whether take_mark() can answer.
  [[nodiscard]] bool has_marks() const noexcept { return !marks_.empty(); }
  /// The sensor that has a mark has ended: what it sends next is new.
  void forget_mark(std::string_view sensor);
  /// The mark of a sensor, once.
  [[nodiscard]] std::optional<stream::PublishedMark> take_mark(std::string_view sensor, std::int64_t now_ns);

 private:
  struct Kept {
    stream::Sample sample;
    std::int64_t came_ns;
  };
  struct Followed {
    std::deque<Kept> samples;
    bool ended = false;
  };
  struct Mark {
    stream::PublishedMark mark;
    std::int64_t told_ns;
  };
  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const noexcept {
      return std::hash<std::string_view>{}(text);
    }
  };
  template <class Value>
  using BySensor = std::unordered_map<std::string, Value, Hash, std::equal_to<>>;

  [[nodiscard]] static bool begins_anew(const Followed& followed, const stream::Sample& sample) noexcept;
  void clear(Followed& followed) noexcept;
  /// What came too long ago goes.
  void let_go(Followed& followed, std::int64_t now_ns);
  /// The same of all sensors, at most once a second.
  void make_room(std::int64_t now_ns);

  BySensor<Followed> followed_;
  BySensor<Mark> marks_;
  std::size_t samples_ = 0;
  std::optional<std::int64_t> made_room_ns_;
};

}  // namespace gyrod::app
