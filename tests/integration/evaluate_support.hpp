/// A recording whose error is known, and `gyrod evaluate` on it.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/exit_code.hpp"
#include "rig.hpp"

namespace gyrod::testing {

using app::ExitCode;
using nlohmann::json;

/// One axis, 100 Hz: a slow swing, measured with white noise of 0.2 deg/s and a bias of 0.05 deg/s.
struct Recording {
  int samples = 6000;
  double rate_hz = 100.0;
  double noise_dps = 0.2;
  double bias_dps = 0.05;
  double amplitude_dps = 5.0;
  bool stamps = true;
  std::string_view truth = "truth_z_dps";
  int lost_from = 0;
  int lost_to = 0;

  [[nodiscard]] std::string text() const {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal(0.0, 1.0);
    std::ostringstream out;
    out.precision(17);
    out << (stamps ? "timestamp_s," : "") << "gyro_z_dps" << (truth.empty() ? "" : ",") << truth << '\n';
    for (int n = 0; n < samples; ++n) {
      const double right = amplitude_dps * std::sin(2.0 * std::numbers::pi * 0.1 * n / rate_hz);
      if (stamps) out << n / rate_hz << ',';
      out << right + bias_dps + noise_dps * normal(random);
      if (!truth.empty() && n >= lost_from && n < lost_to) out << ",nan";
      if (!truth.empty() && (n < lost_from || n >= lost_to)) out << ',' << right;
      out << '\n';
    }
    return out.str();
  }
};

/// Runs the subcommand on it.
class EvaluateRig : public Rig {
 protected:
  Result evaluate(const std::string& file, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"evaluate", path(file), "--axis", "z", "--lag", "0,16"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  /// @return the JSON
  json figures(const std::string& file, std::vector<std::string> more = {"--no-turns"}) {
    more.insert(more.end(), {"-o", path("out")});
    const Result result = evaluate(file, more);
    EXPECT_EQ(result.exit_code, ExitCode::kDone) << result.err;
    return result.exit_code == ExitCode::kDone ? json::parse(read_file("out/evaluation.json")) : json();
  }
  static json estimator(const json& all, const std::string& name, std::size_t row = 0) {
    for (const json& one : all["rows"][row]["estimators"]) {
      if (one["name"] == name) return one;
    }
    ADD_FAILURE() << "no estimator " << name;
    return {};
  }
};

}  // namespace gyrod::testing
