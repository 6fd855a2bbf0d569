/// What became of HTTP requests since the start.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace gyrod::monitor {

/// Why a request or a connection is turned away, whatever it asks for.
enum class Refusal : std::uint8_t {
  kHost,              ///< calls gyrod by a name that is not this machine's
  kNoCredentials,     ///< does not say who it is, which is how a browser begins
  kWrongCredentials,  ///< a token or password that does not hold
  kGuessing,          ///< too many wrong passwords before
  kRate,              ///< too many requests of one address
  kMethod,            ///< neither GET nor HEAD
  kMalformed,         ///< no HTTP
  kTooLarge,          ///< more bytes than a request may have
  kTimeout,           ///< did not come whole in time
  kTls,               ///< ended, broken or too slow before TLS was agreed on
  kNoPlace,           ///< idle the longest where a new client needed a place
  kNotTaken,          ///< its answer was not taken in time
  kStreams,           ///< as many event streams as gyrod serves are open
};
inline constexpr std::size_t kRefusals = 13;

/// Stable snake_case name, as used in metrics.
[[nodiscard]] std::string_view name_of(Refusal why) noexcept;

/// Statuses that gyrod answers with; any other counts as one.
inline constexpr std::array<int, 13> kStatuses = {200, 304, 400, 401, 403, 404, 405,
                                                  408, 414, 429, 431, 500, 503};

/// The counts at one moment.
struct HttpSnapshot {
  std::array<std::uint64_t, kStatuses.size() + 1> answers{};  ///< by status; the last: any other
  std::array<std::uint64_t, kRefusals> refusals{};

  [[nodiscard]] std::uint64_t answered(int status) const noexcept;
  [[nodiscard]] std::uint64_t refused(Refusal why) const noexcept {
    return refusals[static_cast<std::size_t>(why)];
  }
};

/// Thread-safe; nobody waits.
class HttpCounts {
 public:
  /// @param status 0: disconnected without an answer
  void count(int status, std::optional<Refusal> refusal) noexcept;
  void count(Refusal why, std::size_t times = 1) noexcept;
  [[nodiscard]] HttpSnapshot snapshot() const noexcept;

 private:
  template <std::size_t kSize>
  using Counters = std::array<std::atomic<std::uint64_t>, kSize>;

  Counters<kStatuses.size() + 1> answers_{};
  Counters<kRefusals> refusals_{};
};

}  // namespace gyrod::monitor
