/// A monitor on a free port, before a view with known values.
#pragma once

#include <chrono>
#include <memory>

#include <gtest/gtest.h>

#include "monitor/monitor.hpp"
#include "unit/monitor/fixed_view.hpp"
#include "unit/monitor/http_client.hpp"

namespace gyrod::monitor::test {

inline MonitorOptions any_port() {
  MonitorOptions options;
  options.port = 0;
  return options;
}

class MonitorTest : public ::testing::Test {
 protected:
  /// The view may be changed before this.
  void start() {
    monitor_ = std::make_unique<Monitor>(any_port(), view_);
    monitor_->start();
    port_ = monitor_->port();
  }

  [[nodiscard]] std::chrono::steady_clock::duration time_to_stop() {
    const auto begin = std::chrono::steady_clock::now();
    monitor_->stop();
    return std::chrono::steady_clock::now() - begin;
  }

  Shown shown_ = busy_gyrod();
  View view_ = view_of(shown_);
  std::unique_ptr<Monitor> monitor_;
  std::uint16_t port_ = 0;
};

}  // namespace gyrod::monitor::test
