/// The filters that stand beside gyrod's estimators in an evaluation.
#pragma once

#include <string>
#include <vector>

#include "app/evaluation.hpp"
#include "core/evaluation/rivals.hpp"
#include "core/evaluation/tuning.hpp"

namespace gyrod::app {

inline constexpr const char* kTunedName = "Butterworth";

/// Rivals of which the best stands in one line.
struct RivalFamily {
  const char* name;
  EstimatorKind kind;
  std::vector<core::Rival> rivals;
};

/// In the table's order.
[[nodiscard]] const std::vector<RivalFamily>& rival_families();

/// The causal Butterworths, kTunedName.
[[nodiscard]] const RivalFamily& tuned_butterworths();

/// The best of a family on a record for each bound of the lag.
[[nodiscard]] std::vector<core::TunedRival> tuned(const RivalFamily& family, const core::TuningCase& on,
                                                  const std::vector<std::size_t>& bounds);

/// "order 2, cut-off 2.13 Hz"; empty where there is nothing to tune.
[[nodiscard]] std::string tuning_words(const core::RivalSetting& setting, double rate_hz);

}  // namespace gyrod::app
