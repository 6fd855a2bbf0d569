/// Rivals on real drives in real noise: what another program found with the same set-up. Skipped where GYROD_DATA is absent.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/evaluation/tuning.hpp"
#include "support/drive_rows.hpp"

namespace gyrod::core {
namespace {

/// RMSE in deg/s: best causal Butterworth at lags 0, 8, 16, and best zero-phase one. From the prototype of the method, which shares no
/// code with this, to three digits; it tried orders 1 and 2 and few delays.
struct Published {
  const char* row;
  std::array<double, 3> causal;
  double zero_phase;
};
constexpr std::array<Published, 18> kPublished = {{{"06 x", {.333, .333, .333}, .285},
                                                   {"06 y", {.333, .333, .333}, .266},
                                                   {"06 z", {.137, .112, .109}, .108},
                                                   {"09 x", {.333, .333, .333}, .287},
                                                   {"09 y", {.327, .327, .327}, .260},
                                                   {"09 z", {.167, .114, .111}, .110},
                                                   {"06 x at 0.3", {.104, .104, .104}, .098},
                                                   {"06 y at 0.3", {.104, .104, .104}, .096},
                                                   {"06 z at 0.3", {.074, .061, .060}, .057},
                                                   {"09 x at 0.3", {.104, .104, .104}, .100},
                                                   {"09 y at 0.3", {.104, .104, .104}, .096},
                                                   {"09 z at 0.3", {.077, .056, .056}, .054},
                                                   {"06 x at 3", {.660, .582, .582}, .571},
                                                   {"06 y at 3", {.733, .668, .668}, .645},
                                                   {"06 z at 3", {.225, .206, .203}, .169},
                                                   {"09 x at 3", {.597, .530, .530}, .515},
                                                   {"09 y at 3", {.650, .579, .579}, .587},
                                                   {"09 z at 3", {.321, .256, .231}, .212}}};

constexpr std::array<std::size_t, 3> kLags = {0, 8, 16};

std::vector<TunedRival> best_of(std::initializer_list<Rival> rivals, const test::DriveRow& row) {
  const TuningCase on{row.noisy_dps, row.truth_dps, {test::kJudgedBegin, test::kJudgedEnd}};
  std::vector<TunedRival> best;
  for (const Rival rival : rivals) {
    const auto now = tune(rival, on, kLags);
    if (best.empty()) best = now;
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now[i].rmse < best[i].rmse) best[i] = now[i];
    }
  }
  return best;
}

TEST(DriveRivals, AreAsGoodAsPublishedOrBetter) {
  if (!test::has_drive_rows()) GTEST_SKIP() << "no recordings in " << test::data_folder();
  const auto rows = test::drive_rows();
  ASSERT_EQ(rows.size(), kPublished.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].name, kPublished[i].row);
    const auto causal = best_of({Rival::kButterworth1, Rival::kButterworth2}, rows[i]);
    // The mean of the noise that they took off is not known: it is worth up to 0.002 at scale 3.
    EXPECT_NEAR(causal[0].rmse, kPublished[i].causal[0], 0.002) << rows[i].name;
    for (const std::size_t lag : {1U, 2U}) {
      EXPECT_LT(causal[lag].rmse, kPublished[i].causal[lag] + 0.003) << rows[i].name;
    }
    const auto zero = best_of({Rival::kZeroPhase1, Rival::kZeroPhase2, Rival::kZeroPhase4}, rows[i]);
    EXPECT_NEAR(zero[0].rmse, kPublished[i].zero_phase, 0.005)
        << rows[i].name;  // and other paddings at the ends
  }
}

}  // namespace
}  // namespace gyrod::core
