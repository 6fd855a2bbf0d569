// The judges of an evaluation's rows: what several threads make of them is what one does.
#include "app/evaluation.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/evaluation_report.hpp"
#include "app/remembered_runs.hpp"
#include "support/signals.hpp"

namespace gyrod {
namespace {

using namespace testing;

constexpr std::size_t kJudgedSamples = 700;

/// 100 Hz: a swing of 5 deg/s about each axis in noise of its own, of which nothing is known.
app::EvaluationRows swings(std::size_t rows) {
  app::EvaluationRows all;
  all.rate_hz = 100.0;
  all.samples = kJudgedSamples;
  for (std::size_t i = 0; i < rows; ++i) {
    app::EvaluationRow row;
    row.axis = std::string(1, static_cast<char>('x' + i));
    row.truth_dps = times(tone(kJudgedSamples, 0.003), 5.0);
    row.noise_dps = white_noise(kJudgedSamples, 3 + static_cast<unsigned>(i));
    row.noisy_dps = sum(row.truth_dps, row.noise_dps);
    all.axes.push_back(row.axis);
    all.rows.push_back(std::move(row));
  }
  return all;
}

app::EvaluationOptions judged_in(std::size_t threads) {
  app::EvaluationOptions options;
  options.methods = {"joint", "realtime"};
  options.lag_samples = {0, 16};
  options.range = {200, kJudgedSamples};
  options.turns = false;
  options.threads = threads;
  return options;
}

std::string told(const app::EvaluationRows& rows, const app::EvaluationOptions& options) {
  const auto judged = app::evaluate(rows, options);
  return app::evaluation_json({rows, options, judged}).dump();
}

TEST(EvaluationOfRows, IsTheSameInAnyNumberOfThreads) {
  const app::EvaluationRows rows = swings(3);
  const std::string alone = told(rows, judged_in(1));
  EXPECT_EQ(told(rows, judged_in(2)), alone);
  EXPECT_EQ(told(rows, judged_in(64)), alone) << "more than rows";
}

TEST(EvaluationOfRows, TellsHowFarAllThreadsAre) {
  const app::EvaluationRows rows = swings(3);
  app::EvaluationOptions options = judged_in(3);
  std::vector<double> fractions;
  options.look = [&fractions](double fraction) {
    fractions.push_back(fraction);
    return true;
  };
  EXPECT_EQ(app::evaluate(rows, options).size(), 3U);
  ASSERT_GT(fractions.size(), 3U);
  EXPECT_EQ(fractions.front(), 0.0);
  EXPECT_TRUE(std::ranges::is_sorted(fractions));
  EXPECT_LT(fractions.back(), 1.0);
}

TEST(EvaluationOfRows, StopsInAllThreads) {
  const app::EvaluationRows rows = swings(3);
  app::EvaluationOptions options = judged_in(2);
  std::size_t looks = 0;
  options.look = [&looks](double) { return ++looks < 5; };
  EXPECT_TRUE(app::evaluate(rows, options).empty());
  EXPECT_EQ(looks, 5U) << "nobody is asked again";
}

TEST(EvaluationOfRows, TellsItsCallerWhatAThreadCannotDo) {
  const app::EvaluationRows rows = swings(3);
  app::EvaluationOptions options = judged_in(2);
  options.look = [](double) -> bool { throw std::runtime_error("no terminal"); };
  EXPECT_THROW(static_cast<void>(app::evaluate(rows, options)), std::runtime_error);
}

/// Answers with the record's sum and with its size; counts its runs.
class CountedRuns {
 public:
  explicit CountedRuns(std::size_t records)
      : remembered_(
            [this](std::span<const double> noisy) {
              ++runs;
              double total = 0.0;
              for (const double value : noisy) total += value;
              std::vector<core::Contender> answers(2);
              answers[0].estimate = {total};
              answers[1].estimate = {static_cast<double>(noisy.size())};
              return answers;
            },
            records) {}

  double answer(const std::vector<double>& noisy, std::size_t which) {
    return remembered_.answer(noisy, which).estimate.front();
  }

  int runs = 0;

 private:
  app::RememberedRuns remembered_;
};

TEST(RememberedRuns, GiveAllAnswersToARecordForOnePass) {
  CountedRuns all(1);
  EXPECT_EQ(all.answer({1.0, 2.0}, 0), 3.0);
  EXPECT_EQ(all.answer({1.0, 2.0}, 1), 2.0);
  EXPECT_EQ(all.runs, 1);
  EXPECT_EQ(all.answer({1.0, 2.5}, 0), 3.5) << "another record";
  EXPECT_EQ(all.answer({1.0, 2.0, 0.0}, 1), 3.0) << "a longer one";
  EXPECT_EQ(all.runs, 3);
}

TEST(RememberedRuns, ForgetTheRecordThatWasAskedForLongestAgo) {
  CountedRuns all(2);
  all.answer({1.0}, 0);
  all.answer({2.0}, 0);
  all.answer({1.0}, 1);
  all.answer({3.0}, 0);
  EXPECT_EQ(all.runs, 3);
  EXPECT_EQ(all.answer({1.0}, 0), 1.0);
  EXPECT_EQ(all.runs, 3) << "was asked for again";
  EXPECT_EQ(all.answer({2.0}, 0), 2.0);
  EXPECT_EQ(all.runs, 4);
}

core::Guard seam_guard(std::optional<double> value, double limit) {
  return {core::GuardKind::kSeamRoughness,
          value ? core::Verdict::kPass : core::Verdict::kNotApplicable,
          value,
          std::nullopt,
          limit,
          ""};
}

/// The line of the table that is printed.
std::string guard_line(std::vector<app::JudgedGuards> guards) {
  const app::EvaluationRows rows = swings(1);
  const app::EvaluationOptions options = judged_in(1);
  std::vector<app::JudgedRow> judged = app::evaluate(rows, options);
  judged.front().guards = std::move(guards);
  const std::string text = app::evaluation_text({rows, options, judged});
  const std::size_t begin = text.find("seam-roughness");
  return text.substr(begin, text.find('\n', begin) - begin);
}

// 1.338 may pass beside 1.4 where joint's limit is 1.2.
TEST(EvaluationText, GivesEachMethodsLimitWhereTheyDiffer) {
  EXPECT_THAT(guard_line({{"joint", {seam_guard(1.017, 1.2)}},
                          {"improved", {seam_guard(1.338, 1.4)}},
                          {"Butterworth", {seam_guard(std::nullopt, 1.2)}}}),
              ::testing::EndsWith(" 1.2; 1.4"));
  EXPECT_THAT(guard_line({{"joint", {seam_guard(1.017, 1.2)}}, {"improved", {seam_guard(1.1, 1.2)}}}),
              ::testing::EndsWith(" 1.2"));
}

TEST(EvaluationText, GivesNothingNoSign) {
  const app::EvaluationRows rows = swings(1);
  const app::EvaluationOptions options = judged_in(1);
  std::vector<app::JudgedRow> judged = app::evaluate(rows, options);
  core::TurnResponse response;
  response.half_delay_s = -0.0004;
  response.time_95_s = 0.3;
  response.overshoot = -0.0004;
  response.peak_error_dps = 1.0;
  judged.front().turns = {{"joint", "a turn", response}};
  const std::string text = app::evaluation_text({rows, options, judged});
  EXPECT_THAT(text.substr(text.find("a turn")), ::testing::ContainsRegex(" 0 +300 +0\\.0 +1\\.00"));
}

}  // namespace
}  // namespace gyrod
