/// How often each address may do something.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>

namespace gyrod::monitor {

/// A bucket of `burst` tokens for each address, filled again at `per_second`. Thread-safe, bounded: addresses beyond
/// `max_addresses` share one bucket.
class RateLimit {
 public:
  using Time = std::chrono::steady_clock::time_point;
  struct Options {
    double burst = 1.0;
    double per_second = 1.0;
    std::size_t max_addresses = 4096;
  };

  explicit RateLimit(const Options& options) : options_(options) {}

  /// @return whether there is a token left; it is not taken
  [[nodiscard]] bool allows(const std::string& address, Time now);
  /// Takes a token, if there is one.
  /// @return whether there was
  bool take(const std::string& address, Time now);

 private:
  struct Bucket {
    double tokens = 0.0;
    Time filled{};
  };

  [[nodiscard]] Bucket& bucket_of(const std::string& address, Time now);
  void fill(Bucket& bucket, Time now) const;
  void forget_full_ones(Time now);

  Options options_;
  std::mutex mutex_;
  std::map<std::string, Bucket> buckets_;  ///< "": of the addresses beyond
  Time forget_again_{};
};

}  // namespace gyrod::monitor
