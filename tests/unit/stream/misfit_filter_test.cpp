// When one filter of method joint says that its models do not fit, and for how long: the limits of docs/joint.md, "What is reported".
#include <algorithm>
#include <cmath>
#include <memory>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "misfit_support.hpp"
#include "stream/joint_method.hpp"
#include "support/signals.hpp"

namespace gyrod::stream {
namespace {

using ::testing::Each;
using ::testing::Ge;

/// A filter with the model of white noise, and what it says of noise so much stronger than that.
class MisfitOfAFilter : public ::testing::Test {
 protected:
  MisfitOfAFilter() { open(100.0); }
  void open(double rate_hz) {
    filter_ = factory_.filter(16);
    use(rate_hz, 1.0);
  }
  /// @param believed the noise's variance, in parts of what it is; 0: nothing is
  void use(double rate_hz, double believed) {
    use(rate_hz, believed, testing::times(testing::white_noise(1024, 1), kStd));
  }
  void use(double rate_hz, double believed, const std::vector<double>& noise) {
    const auto model = factory_.model(1024);
    const auto method = factory_.method(1024, 32);
    core::WindowReport report;
    const WindowInput window{.samples = noise,
                             .sample_rate_hz = rate_hz,
                             .noise_source = believed > 0.0 ? NoiseSource::kCalibrated : NoiseSource::kNone,
                             .noise = core::white_noise(believed * kStd * kStd)};
    for (int windows = 0; windows < 32; ++windows) method->fit(window, *model, report);
    filter_->use(*model);
  }
  std::vector<bool> after(double variance, std::size_t samples) {
    std::vector<bool> misfit;
    for (const double value : testing::white_noise(samples, 2)) {
      filter_->step(std::sqrt(variance) * kStd * value);
      misfit.push_back(filter_->model_fit().misfit);
      const bool beyond = filter_->model_fit().normalised_innovation > 2.0;
      crossings_ += beyond && !beyond_ ? 1U : 0U;
      beyond_ = beyond;
    }
    return misfit;
  }

  ModelMethodFactory factory_ = std::get<ModelMethodFactory>(MethodFactory(joint_method({})));
  std::unique_ptr<SampleFilter> filter_;
  bool beyond_ = false;
  std::size_t crossings_ = 0;  ///< of the limit from below
};

TEST_F(MisfitOfAFilter, IsNotLeftAndEnteredAgainAtTheLimit) {
  const auto misfit = after(2.5, 20000);  // members that allow for more motion take part: the mean is about 2
  EXPECT_GT(crossings_, 100U) << "what one limit for both would have counted";
  EXPECT_LE(filter_->model_fit().misfits, 4U);
  EXPECT_THAT(spells(misfit), Each(Ge(128U)));
}

TEST_F(MisfitOfAFilter, IsLeftSecondsAfterWhatDoesNotFitIsOverAtEitherEnd) {
  for (const double variance : {6.0, 0.2}) {
    EXPECT_TRUE(after(variance, 2000).back()) << variance;
    const auto over = after(1.0, 2000);
    EXPECT_FALSE(over.back()) << variance;
    // From about 6 to 1.6 by a mean of 256 samples: 256 ln(5 / 0.6) = 543.
    EXPECT_LT(flagged(over), 1000) << variance;
  }
}

// At eight times the design's rate the same times are eight times the samples: of the mean, and of the shortest spell.
TEST_F(MisfitOfAFilter, TakesTheSameSecondsAtAHighRate) {
  open(8.0 * core::kDesignRateHz);
  after(6.0, 16000);
  const auto over = after(1.0, 16000);
  EXPECT_FALSE(over.back());
  EXPECT_GT(flagged(over), 8 * 256) << "8 * 256 ln(5 / 0.6) = 4342";
  EXPECT_LT(flagged(over), 8 * 1000);
}

TEST_F(MisfitOfAFilter, LastsForTheSameSecondsAtLeastAtAHighRate) {
  for (const auto& [rate_hz, least] : {std::pair{100.0, 128U}, std::pair{960.0, 8U * 128U}}) {
    open(rate_hz);
    unsigned silent = 0;  // the mean falls from 1 to 0.7 in 91 or 730 samples
    while (silent < 8 * 256 && !after(0.0, 1).back()) ++silent;
    // It is back at 0.8 of 1.5 in 35 or 274.
    EXPECT_EQ(flagged(after(1.5, 4 * least)), least - 1) << rate_hz;
  }
}

/// Behind a low-pass: a pole at 0.5, and the mean of two samples. At 0.28, 0.34, 0.41, 0.47 cycles a sample it leaves 0.070, 0.033, 0.0094, 0.0010 of
/// the power.
std::vector<double> low_passed_noise(std::size_t samples) {
  auto noise = testing::times(testing::white_noise(samples, 4), kStd);
  double slow = 0.0;
  for (double& value : noise) {
    const double before = slow;
    slow = 0.5 * (slow + value);
    value = 0.5 * (slow + before);
  }
  return noise;
}

// What a window's guess is made of is what the low-pass leaves. Said from the 512th sample in a row on.
TEST_F(MisfitOfAFilter, IsThereForNoiseThatALowPassHidesUntilTheNoiseIsKnown) {
  const auto noise = low_passed_noise(1024);
  use(100.0, 0.0, noise);
  unsigned taken = 0;
  while (taken < 512 && !filter_->model_fit().hidden_noise) filter_->step(noise[taken++]);
  EXPECT_EQ(taken, 512U);
  EXPECT_TRUE(filter_->model_fit().misfit);
  EXPECT_FALSE(filter_->model_fit().wrong_noise);
  use(100.0, 1.0, noise);
  EXPECT_FALSE(filter_->model_fit().hidden_noise);
  filter_->reset();
  use(100.0, 0.0, noise);
  EXPECT_TRUE(filter_->model_fit().hidden_noise) << "what models remember outlasts a gap";
  filter_->reset();
  EXPECT_FALSE(filter_->model_fit().hidden_noise) << "no model yet";
}

// A level that is a ninth of the believed one is said to be wrong by the 512th sample in a row, and right again by the 512th.
TEST_F(MisfitOfAFilter, AsksForTheSameSecondsOfNoiseThatIsNotAsBelieved) {
  for (const auto& [rate_hz, expected] : {std::pair{100.0, 512U}, std::pair{960.0, 8U * 512U}}) {
    open(rate_hz);
    const auto noise = testing::times(testing::white_noise(expected, 3), kStd);
    for (const bool wrong : {true, false}) {
      use(rate_hz, wrong ? 9.0 : 1.0);
      unsigned taken = 0;
      while (taken < expected && filter_->model_fit().wrong_noise != wrong) filter_->step(noise[taken++]);
      EXPECT_EQ(filter_->model_fit().wrong_noise, wrong) << rate_hz;
      EXPECT_EQ(taken, expected) << rate_hz << wrong;
    }
  }
}

// A sensor may forget what it believed, as where a level that was learned is far too high. Then nothing is wrong, and there is nothing to be a part of.
TEST_F(MisfitOfAFilter, IsOverWhereNothingIsBelievedAnyMore) {
  use(100.0, 9.0);
  after(1.0, 1000);
  ASSERT_TRUE(filter_->model_fit().wrong_noise);
  ASSERT_NEAR(filter_->model_fit().noise_ratio, 1.0 / 3.0, 0.05);
  use(100.0, 0.0);
  filter_->step(0.0);
  EXPECT_FALSE(filter_->model_fit().wrong_noise);
  EXPECT_EQ(filter_->model_fit().noise_ratio, 1.0);
}

// A gap ends what the filter knows, and not what the models have seen: a calibration that is wrong is so from the first of them on.
TEST_F(MisfitOfAFilter, SaysAtOnceAfterAGapThatTheNoiseIsNotAsBelieved) {
  use(100.0, 9.0);
  after(1.0, 1000);
  ASSERT_TRUE(filter_->model_fit().wrong_noise);
  filter_->reset();
  after(1.0, 10);
  EXPECT_FALSE(filter_->model_fit().wrong_noise) << "no model yet";
  use(100.0, 9.0);
  after(1.0, 1);
  EXPECT_TRUE(filter_->model_fit().wrong_noise);
}

// What a window guesses of noise that nobody knows may be too much by half where the road has tones.
TEST_F(MisfitOfAFilter, IsNotSaidOfAGuessThatIsTooHighByHalf) {
  const auto flagged_at = [this](double believed, double variance) {
    open(100.0);
    use(100.0, believed);
    return after(variance, 2000).back();
  };
  EXPECT_TRUE(flagged_at(1.0, 0.6));
  EXPECT_FALSE(flagged_at(0.0, 0.6));
  EXPECT_TRUE(flagged_at(0.0, 0.4));
  EXPECT_TRUE(flagged_at(0.0, 3.0));
}

// Entered where the mean of the innovations leaves 0.7 to 2; left within 0.8 to 1.6, 128 samples later at the earliest.
TEST_F(MisfitOfAFilter, HasTheLimitsOfTheManual) {
  std::size_t lasted = 0;
  std::size_t entered_above = 0;
  std::size_t entered_below = 0;
  const auto scales = testing::white_noise(300, 3);
  const auto noise = testing::white_noise(scales.size() * 400, 4);
  for (std::size_t n = 0; n < noise.size(); ++n) {
    filter_->step(kStd * noise[n] * std::exp(0.6 * scales[n / 400]));
    const ModelFit fit = filter_->model_fit();
    const double mean = fit.normalised_innovation;
    const bool leaves = lasted >= 128 && mean >= 0.8 && mean <= 1.6;
    const bool expected = lasted > 0 ? !leaves : mean < 0.7 || mean > 2.0;
    ASSERT_EQ(fit.misfit, expected) << n << ": " << mean;
    entered_above += expected && lasted == 0 && mean > 2.0 ? 1U : 0U;
    entered_below += expected && lasted == 0 && mean < 0.7 ? 1U : 0U;
    lasted = expected ? lasted + 1 : 0;
  }
  EXPECT_GT(entered_above, 10U);
  EXPECT_GT(entered_below, 10U);
}

}  // namespace
}  // namespace gyrod::stream
