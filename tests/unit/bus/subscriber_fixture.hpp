/// What the tests of the subscriber share.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string_view>

#include <gtest/gtest.h>

#include "bus/raw_writer.hpp"
#include "unit/bus/bus_test.hpp"

namespace gyrod::bus::test {

/// Raw writers on one side, a collector for a subscriber on the other.
class SubscriberTest : public BusTest {
 protected:
  /// Writes all, however long the readers hold back.
  static void publish_all(RawWriter& writer, std::string_view sensor,
                          std::span<const stream::Sample> samples) {
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (!samples.empty()) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline);
      samples = samples.subspan(writer.publish(sensor, samples));
    }
  }

  [[nodiscard]] RawWriter matched_writer(std::size_t batch_samples) const {
    return matched_writer(options_, batch_samples);
  }
  /// One that knows its readers and that they know.
  [[nodiscard]] RawWriter matched_writer(const BusOptions& options, std::size_t batch_samples) const {
    RawWriter writer(writer_domain(), options, batch_samples);
    EXPECT_TRUE(writer.wait_for_subscriber(kPatience));
    settle(writer_domain(), reader_domain());
    return writer;
  }

  SampleCollector collector_;
};

}  // namespace gyrod::bus::test
