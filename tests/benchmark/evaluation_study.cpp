// Filters tuned on the truth, on a car's reference gyro plus the noise of a still one: RMSE in deg/s over samples 2400..9600.
//   GYROD_DATA=... evaluation_study          best causal Butterworth (order 1, 2, 4; any delay <= L) and best zero-phase one
//   GYROD_DATA=... evaluation_study --all    every rival by itself
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "core/evaluation/tuning.hpp"
#include "support/drive_rows.hpp"

namespace {

using gyrod::core::Rival;
using gyrod::core::TunedRival;

constexpr std::array<std::size_t, 3> kLags = {0, 8, 16};

std::vector<TunedRival> tuned(Rival rival, const gyrod::test::DriveRow& row) {
  const gyrod::core::TuningCase on{
      row.noisy_dps, row.truth_dps, {gyrod::test::kJudgedBegin, gyrod::test::kJudgedEnd}};
  return gyrod::core::tune(rival, on, kLags);
}

/// The better for each lag.
std::vector<TunedRival> best_of(std::initializer_list<Rival> rivals, const gyrod::test::DriveRow& row) {
  std::vector<TunedRival> best;
  for (const Rival rival : rivals) {
    const auto now = tuned(rival, row);
    if (best.empty()) best = now;
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now[i].rmse < best[i].rmse) best[i] = now[i];
    }
  }
  return best;
}

std::string words(const TunedRival& best, double rate_hz) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%s %.3g Hz d %zu",
                std::string(name_of(best.setting.rival)).c_str(), best.setting.parameter * rate_hz,
                best.setting.delay);
  return text.data();
}

void butterworth_rows(const std::vector<gyrod::test::DriveRow>& rows) {
  std::printf("%-12s %7s | %6s %6s %6s | %6s | filters\n", "row", "raw", "L = 0", "8", "16", "zero");
  for (const auto& row : rows) {
    const auto raw = tuned(Rival::kRaw, row);
    const auto causal = best_of({Rival::kButterworth1, Rival::kButterworth2, Rival::kButterworth4}, row);
    const auto zero = best_of({Rival::kZeroPhase1, Rival::kZeroPhase2, Rival::kZeroPhase4}, row);
    std::printf("%-12s %7.4f | %6.3f %6.3f %6.3f | %6.3f | %s; %s; %s; %s\n", row.name.c_str(), raw[0].rmse,
                causal[0].rmse, causal[1].rmse, causal[2].rmse, zero[0].rmse,
                words(causal[0], row.rate_hz).c_str(), words(causal[1], row.rate_hz).c_str(),
                words(causal[2], row.rate_hz).c_str(), words(zero[0], row.rate_hz).c_str());
  }
}

void all_rows(const std::vector<gyrod::test::DriveRow>& rows) {
  std::printf("%-12s %-16s %7s %7s %7s   parameter, second, delay at L = 16\n", "row", "rival", "L = 0", "8",
              "16");
  for (const auto& row : rows) {
    for (const Rival rival : gyrod::core::kAllRivals) {
      const auto best = tuned(rival, row);
      std::printf("%-12s %-16s %7.4f %7.4f %7.4f   %.4g, %.3g, %zu\n", row.name.c_str(),
                  std::string(name_of(rival)).c_str(), best[0].rmse, best[1].rmse, best[2].rmse,
                  best[2].setting.parameter, best[2].setting.second, best[2].setting.delay);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (!gyrod::test::has_drive_rows()) {
    std::fprintf(stderr, "evaluation_study: no recordings in %s\n", gyrod::test::data_folder().c_str());
    return 1;
  }
  const auto rows = gyrod::test::drive_rows();
  if (argc > 1 && std::strcmp(argv[1], "--all") == 0) {
    all_rows(rows);
  } else {
    butterworth_rows(rows);
  }
  return 0;
}
