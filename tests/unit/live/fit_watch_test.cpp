#include "live/fit_watch.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace gyrod::live {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

constexpr std::size_t kY = 1;

stream::ChannelSnapshot sensor_of(const std::string& name) {
  stream::ChannelSnapshot sensor;
  sensor.sensor = name;
  sensor.last_report.noise_source = stream::NoiseSource::kCalibrated;
  sensor.last_report.model_fit.emplace();
  return sensor;
}

class FitWatchTest : public ::testing::Test {
 protected:
  /// A round every ten seconds.
  std::vector<FitWatch::News> after(double seconds) {
    std::vector<FitWatch::News> all;
    for (double end_s = now_s_ + seconds; now_s_ < end_s;) {
      now_s_ += 10.0;
      for (const auto& sensor : sensors_) watch_.note(now_s_, sensor);
      for (auto& news : watch_.end_round(now_s_)) all.push_back(std::move(news));
    }
    return all;
  }
  stream::ModelFit& fit(std::size_t axis, std::size_t sensor = 0) {
    return (*sensors_[sensor].last_report.model_fit)[axis];
  }
  void break_fit(std::size_t axis, std::size_t sensor = 0) {
    fit(axis, sensor).misfit = true;
    ++fit(axis, sensor).misfits;
    fit(axis, sensor).normalised_innovation = 3.14159;
  }

  FitWatch watch_;
  std::vector<stream::ChannelSnapshot> sensors_{sensor_of("front")};
  double now_s_ = 1000.0;
};

TEST_F(FitWatchTest, AModelThatFitsAndAWindowMethodAreNoNews) {
  EXPECT_THAT(after(600.0), IsEmpty());
  sensors_[0].last_report.model_fit.reset();
  EXPECT_THAT(after(600.0), IsEmpty());
}

TEST_F(FitWatchTest, NoiseThatALowPassHidesAsksForRest) {
  sensors_[0].last_report.noise_source = stream::NoiseSource::kImf1;
  fit(kY).misfit = fit(kY).hidden_noise = true;
  fit(kY).misfits = 1;
  const auto begun = after(80.0);
  ASSERT_THAT(begun, SizeIs(1));
  EXPECT_EQ(
      begun[0].text,
      "front axis y: the model has not fitted for a minute (y has noise that a low-pass of the sensor's own "
      "hides; noise source imf1): let it stand still for two minutes, with the engine off, or calibrate it");
}

TEST_F(FitWatchTest, AMisfitIsToldOnceWhenItHasHeldForAMinuteAndOnceWhenItHasBeenOverForOne) {
  break_fit(kY);
  EXPECT_THAT(after(60.0), IsEmpty());
  const auto begun = after(10.0);
  ASSERT_THAT(begun, SizeIs(1));
  EXPECT_TRUE(begun[0].trouble);
  EXPECT_EQ(begun[0].sensor, "front");
  EXPECT_EQ(
      begun[0].text,
      "front axis y: the model has not fitted for a minute (y has a normalised innovation of 3.1; noise "
      "source calibrated): do not trust its deviations; if that stays while it stands still, calibrate it");
  EXPECT_THAT(after(600.0), IsEmpty());
  fit(kY).misfit = false;
  EXPECT_THAT(after(60.0), IsEmpty());
  const auto over = after(10.0);
  ASSERT_THAT(over, SizeIs(1));
  EXPECT_FALSE(over[0].trouble);
  EXPECT_EQ(over[0].text, "front axis y: the model has fitted again for a minute");
  EXPECT_THAT(after(600.0), IsEmpty());
}

TEST_F(FitWatchTest, AMisfitThatComesAndGoesBetweenTwoLooksHasNotHeld) {
  for (int i = 0; i < 100; ++i) {
    break_fit(kY);
    EXPECT_THAT(after(10.0), IsEmpty());
  }
  EXPECT_THAT(after(60.0), SizeIs(1));
}

TEST_F(FitWatchTest, OneThatIsToldIsNotOverForASecondWithoutIt) {
  break_fit(kY);
  EXPECT_THAT(after(70.0), SizeIs(1));
  for (int i = 0; i < 20; ++i) {
    fit(kY).misfit = false;
    EXPECT_THAT(after(30.0), IsEmpty());
    break_fit(kY);
    EXPECT_THAT(after(90.0), IsEmpty());
  }
}

TEST_F(FitWatchTest, ANoiseThatIsBelievedWronglyIsToldAsSuchOfAllAxesAtOnceWithWhatToDo) {
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    break_fit(axis);
    fit(axis).wrong_noise = true;
    fit(axis).noise_ratio = 0.333 + 0.1 * static_cast<double>(axis);
  }
  const auto news = after(70.0);
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_EQ(news[0].text,
            "front axes x, y, z: the model has not fitted for a minute (x has 0.33 times the noise that is "
            "believed, y has 0.43 times the noise that is believed, z has 0.53 times the noise that is "
            "believed; noise "
            "source calibrated): calibrate it again, or take the calibration out and let it stand still for "
            "a minute");
}

TEST_F(FitWatchTest, LearnedNoiseIsLearnedAgainByStandingStill) {
  break_fit(kY);
  fit(kY).wrong_noise = true;
  sensors_[0].last_report.noise_source = stream::NoiseSource::kStandstill;
  const auto news = after(70.0);
  ASSERT_THAT(news, SizeIs(1));
  EXPECT_THAT(news[0].text,
              AllOf(HasSubstr("noise source standstill"),
                    EndsWith("let it stand still for a minute, with the engine off, or calibrate it")));
}

TEST_F(FitWatchTest, ASensorThatIsSilentOrStuckTellsThatInstead) {
  break_fit(kY);
  sensors_[0].state = stream::ChannelState::kSilent;
  EXPECT_THAT(after(600.0), IsEmpty());
  sensors_[0].state = stream::ChannelState::kActive;
  sensors_[0].health.emplace().state = stream::Health::kStuck;
  EXPECT_THAT(after(600.0), IsEmpty());
  sensors_[0].health->state = stream::Health::kNoisy;
  EXPECT_THAT(after(60.0), SizeIs(1));
}

TEST_F(FitWatchTest, ASensorThatIsGoneIsForgottenAndToldAnewWhenItIsBack) {
  break_fit(kY);
  EXPECT_THAT(after(70.0), SizeIs(1));
  auto gone = std::move(sensors_);
  sensors_.clear();
  EXPECT_THAT(after(10.0), IsEmpty());
  sensors_ = std::move(gone);
  EXPECT_THAT(after(60.0), IsEmpty());
  EXPECT_THAT(after(10.0), SizeIs(1));
}

TEST_F(FitWatchTest, OfThousandsTenAreToldOneByOneAMinuteAndTheRestInSum) {
  (void)after(10.0);  // the first minute has begun
  sensors_.clear();
  constexpr std::size_t kMany = 3000;
  for (std::size_t i = 0; i < kMany; ++i) {
    sensors_.push_back(sensor_of(std::to_string(i)));
    break_fit(kY, i);
  }
  const auto news = after(180.0);
  ASSERT_THAT(news, SizeIs(FitWatch::kMostSensors + 1));
  EXPECT_EQ(
      news.back().text,
      "The models of 2990 more sensors have not fitted for a minute: gyrod_axis_model_misfit says which");
  EXPECT_EQ(news.back().sensor, "");
  EXPECT_TRUE(news.back().trouble);
  for (std::size_t i = 0; i < kMany; ++i) fit(kY, i).misfit = false;
  const auto over = after(180.0);
  ASSERT_THAT(over, SizeIs(FitWatch::kMostSensors + 1));
  EXPECT_THAT(over.back().text, StartsWith("The models of 2990 more sensors have fitted again"));
  EXPECT_FALSE(over.back().trouble);
}

}  // namespace
}  // namespace gyrod::live
