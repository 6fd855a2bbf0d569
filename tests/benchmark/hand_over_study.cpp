// Whether one sees where a new model takes over, on a car's reference gyro plus the noise of a still one (samples 2400..9600 of
// support/drive_rows.hpp): the table of docs/measured.md, "Hand-overs".
//   GYROD_DATA=... hand_over_study
//   GYROD_DATA=... hand_over_study at_once
// For lag 16 and lag 0: what the new model's answer is less what the old one's was (rms and largest), the largest step
// between answers where models change, and the largest elsewhere; all in standard deviations of the steps elsewhere. `at_once`: without
// taking back what the new model makes of the same samples.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/joint/joint_fit.hpp"
#include "core/joint/kalman_bank.hpp"
#include "core/noise/still_noise.hpp"
#include "support/drive_rows.hpp"

namespace {

using namespace gyrod;

constexpr std::size_t kHop = 32;
constexpr std::size_t kWindow = 1024;

/// A bank, and what its answers did.
class Watched {
 public:
  Watched(const core::JointOptions& options, std::size_t lag) : lag_(lag), bank_(options, lag) {}

  void use(const core::JointModel& model, bool judged) {
    const double before = bank_.held(lag_).rate;
    bank_.use(model);
    const double jump = std::abs(bank_.held(lag_).rate - before);
    if (!judged) return;
    hand_over_ = true;
    hand_overs_ += 1.0;
    jumps_ += jump * jump;
    largest_jump_ = std::max(largest_jump_, jump);
  }

  void step(double sample, bool judged) {
    const core::BankEstimates both = bank_.step(sample);
    const double answer = lag_ == 0 ? both.realtime.rate : both.denoised.rate;
    const double step = std::abs(answer - last_);
    last_ = answer;
    if (judged && hand_over_) largest_at_ = std::max(largest_at_, step);
    if (judged && !hand_over_) {
      largest_else_ = std::max(largest_else_, step);
      steps_ += step * step;
      count_ += 1.0;
    }
    hand_over_ = false;
  }

  void print() const {
    const double ordinary = std::sqrt(steps_ / count_);
    std::printf(" | %5.2f %5.2f %5.2f %5.2f", std::sqrt(jumps_ / hand_overs_) / ordinary,
                largest_jump_ / ordinary, largest_at_ / ordinary, largest_else_ / ordinary);
  }

 private:
  std::size_t lag_;
  core::KalmanBank bank_;
  bool hand_over_ = false;
  double last_ = 0.0;
  double hand_overs_ = 0.0;
  double jumps_ = 0.0;
  double largest_jump_ = 0.0;
  double largest_at_ = 0.0;
  double largest_else_ = 0.0;
  double steps_ = 0.0;
  double count_ = 0.0;
};

void study(const test::DriveRow& row, const core::JointOptions& options) {
  const core::NoiseModel noise = core::scaled(core::still_noise(row.still_dps).value(), core::kNoiseMargin);
  core::JointFit fit(kWindow);
  std::array<Watched, 2> banks = {Watched(options, 16), Watched(options, 0)};
  const auto model = std::make_unique<core::JointModel>();
  core::WindowReport report;
  for (std::size_t t = 0; t < test::kJudgedEnd + 16; ++t) {
    const bool judged = t > test::kJudgedBegin;
    if (t % kHop == 0 && t >= core::JointFit::kMinSamples + kHop) {
      const std::size_t end = t - kHop;
      const std::size_t begin = end - std::min(end, kWindow);
      fit.fit(std::span(row.noisy_dps).subspan(begin, end - begin), noise, *model, report);
      for (Watched& bank : banks) bank.use(*model, judged);
    }
    for (Watched& bank : banks) bank.step(row.noisy_dps[t], judged);
  }
  std::printf("%-12s", row.name.c_str());
  for (const Watched& bank : banks) bank.print();
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (!test::has_drive_rows()) {
    std::fprintf(stderr, "hand_over_study: no recordings in %s\n", test::data_folder().c_str());
    return 1;
  }
  core::JointOptions options;
  if (argc > 1 && std::string_view(argv[1]) == "at_once") options.hand_over_memory = 0.0;
  std::printf("%-12s | lag 16: jump rms, largest; step there, elsewhere | lag 0: the same\n", "row");
  for (const test::DriveRow& row : test::drive_rows()) study(row, options);
  return 0;
}
