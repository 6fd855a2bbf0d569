/// Keeps a log from being flooded.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace gyrod::bus {

/// Lets a message pass when it is new, and then once a minute with how often it came in between. Beyond kMostTexts different
/// messages a minute the rest is one message, too. Not thread-safe.
class RepeatFilter {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::minutes kEvery{1};
  static constexpr std::size_t kMostTexts = 64;

  /// @return what is to be logged now, if anything
  [[nodiscard]] std::optional<std::string> pass(std::string_view message, Clock::time_point now);

 private:
  struct Text {
    Clock::time_point last_passed;
    std::uint64_t held_back = 0;
  };
  std::map<std::string, Text, std::less<>> texts_;
};

}  // namespace gyrod::bus
