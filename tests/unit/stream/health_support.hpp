/// What the tests of a sensor's health share.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include <gtest/gtest.h>

#include "stream/health_judge.hpp"
#include "stream/health_watch.hpp"

namespace gyrod::stream {

inline constexpr std::size_t kWindow = 64;
inline constexpr double kHz = 100.0;

/// A sensor at 100 Hz whose window is full, and who judges it. Its values change from sample to sample, each axis on its own.
class SensorHealthTest : public ::testing::Test {
 protected:
  SensorHealthTest() { send(kWindow); }

  using Values = std::function<std::array<double, kAxes>(std::uint64_t)>;
  static std::array<double, kAxes> moving(std::uint64_t n) {
    const double odd = n % 2 == 0 ? 0.01 : -0.01;
    return {odd, 2.0 * odd, 3.0 * odd};
  }
  void send(std::uint64_t count, const Values& values = moving) {
    for (std::uint64_t i = 0; i < count; ++i) {
      Sample sample{.sequence = n_, .stamp_ns = static_cast<std::int64_t>(n_) * 10'000'000};
      sample.rate_radps = values(n_++);
      watch_.step(sample, true);
    }
    now_s_ = static_cast<double>(n_) / kHz;
    watch_.hear(now_s_, kHz);
  }
  void send_s(double seconds, const Values& values = moving) {
    send(static_cast<std::uint64_t>(seconds * kHz + 0.5), values);
  }
  SensorHealth judge(unsigned overload_step = 0) {
    return judge_.judge(watch_.evidence(), {now_s_, deaf_until_s_, overload_step});
  }
  Health state() { return judge().state; }

  HealthOptions options_;
  HealthWatch watch_{options_, kWindow};
  HealthJudge judge_{options_, kWindow};
  std::uint64_t n_ = 0;
  double now_s_ = 0.0;
  double deaf_until_s_ = 0.0;
};

}  // namespace gyrod::stream
