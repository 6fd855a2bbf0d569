/// Full-rate samples of the few sensors that somebody looks at.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>

#include "live/rest_trail.hpp"
#include "live/sample_trail.hpp"
#include "stream/report.hpp"
#include "stream/sample.hpp"

namespace gyrod::live {

/// What is kept of a sensor while somebody looks at it.
struct Watched {
  Watched(std::size_t capacity, double began) : raw(capacity), denoised(capacity), began_s(began) {}
  SampleTrail raw;
  SampleTrail denoised;
  RestTrail rests;
  double began_s;
};

/// Keeps raw and denoised samples of at most kMost sensors, from the first time somebody asks for one until kLinger after the last time.
/// Samples' threads never allocate nor wait here; while nobody looks they pay for one load.
class Tap {
 public:
  static constexpr std::size_t kMost = 16;
  static constexpr double kLingerS = 60.0;
  /// Of a sensor, at most: 3 MB raw, and as much denoised.
  static constexpr std::size_t kMostSamples = std::size_t{1} << 17U;
  static constexpr double kMostSeconds = 600.0;

  /// Somebody looks at the sensor: keeps its samples from now on, if nobody did.
  /// @param sample_rate_hz 0 where it is not known @param now_s of a steady clock
  /// @return none where kMost others are looked at
  [[nodiscard]] std::shared_ptr<const Watched> look(std::string_view sensor, double sample_rate_hz,
                                                    double now_s);
  /// Lets go of what nobody looks at any more: about once a second.
  void tidy(double now_s);

  // The samples' threads; of one sensor, each method by one thread at a time.
  void on_raw(std::string_view sensor, std::span<const stream::Sample> samples) noexcept;
  void on_denoised(std::string_view sensor, std::span<const stream::DenoisedSample> samples) noexcept;
  void on_report(std::string_view sensor, const stream::NoiseReport& report) noexcept;

 private:
  enum Way : std::size_t { kRaw, kDenoised, kReports, kWays };

  /// A sensor that is looked at. `busy` of a way is held by its thread while it adds, and all of them while `sensor` and `watched` change.
  struct Place {
    std::atomic<std::uint64_t> hash{0};  ///< of the id; 0: free
    std::array<std::atomic_flag, kWays> busy;
    std::string sensor;
    std::shared_ptr<Watched> watched;
    double asked_s = 0.0;
  };

  template <class Add>
  void with(Way way, std::string_view sensor, const Add& add) noexcept;
  static void change(Place& place, std::string_view sensor, std::shared_ptr<Watched> watched) noexcept;

  std::atomic<std::size_t> looked_at_{0};
  std::array<Place, kMost> places_;
  std::mutex mutex_;  ///< of look() and tidy()
};

}  // namespace gyrod::live
