// Accelerometer and reference columns: names, units, frames, gaps, and what is missing.
#include "files/navigation_columns.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/inertial/attitude.hpp"
#include "files/file_error.hpp"
#include "support/scratch_folder.hpp"

namespace gyrod::files {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr core::GeodeticPosition kReference{45.0 * kDegree, 0.0, 0.0};

/// Ten samples at 10 Hz.
Record record_with(std::map<std::string, std::vector<double>, std::less<>> others) {
  Record record;
  record.name = "walk.csv";
  for (int n = 0; n < 10; ++n) record.time_s.push_back(0.1 * n);
  record.first_stamp_s = 1000.0;
  record.others = std::move(others);
  return record;
}
std::vector<double> constant(double value, std::size_t size = 10) { return std::vector<double>(size, value); }

TEST(AccelerometerColumns, AreTakenInMps2GAndMg) {
  for (const auto& [unit, mps2] :
       std::map<std::string, double>{{"mps2", 1.0}, {"g", 9.80665}, {"mg", 9.80665e-3}}) {
    const Record record = record_with({{"accel_x_" + unit, constant(1.0)},
                                       {"accel_y_" + unit, constant(2.0)},
                                       {"accel_z_" + unit, constant(-4.0)}});
    const Accelerometer accelerometer = accelerometer_of(record);
    EXPECT_EQ(accelerometer.specific_force_mps2[0], constant(mps2)) << unit;
    EXPECT_EQ(accelerometer.specific_force_mps2[2], constant(-4.0 * mps2)) << unit;
    EXPECT_EQ(accelerometer.bridged, 0U);
  }
}

TEST(AccelerometerColumns, ThatAreMissingAreNamedTogetherWithWhatThereIs) {
  const auto complaint = AllOf(HasSubstr("walk.csv"), HasSubstr("accel_x_UNIT"), HasSubstr("mps2"));
  EXPECT_THAT([] { static_cast<void>(accelerometer_of(record_with({}))); },
              ThrowsMessage<FileError>(AllOf(complaint, HasSubstr("found none"))));
  const Record mixed =
      record_with({{"accel_x_g", constant(0)}, {"accel_y_g", constant(0)}, {"accel_z_mps2", constant(9.8)}});
  EXPECT_THAT([&] { static_cast<void>(accelerometer_of(mixed)); },
              ThrowsMessage<FileError>(AllOf(complaint, HasSubstr("accel_x_g, accel_y_g, accel_z_mps2"))));
}

TEST(AccelerometerColumns, AreBridgedOverShortGapsAndRefusedOverLongOnes) {
  std::vector<double> z = {kNan, 2.0, 3.0, kNan, kNan, kNan, 7.0, 8.0, 9.0, kNan};
  Record record =
      record_with({{"accel_x_mps2", constant(0)}, {"accel_y_mps2", constant(0)}, {"accel_z_mps2", z}});
  const Accelerometer accelerometer = accelerometer_of(record);
  EXPECT_EQ(accelerometer.bridged, 5U);
  EXPECT_EQ(accelerometer.specific_force_mps2[2], (std::vector<double>{2, 2, 3, 4, 5, 6, 7, 8, 9, 9}));

  record = record_with({});
  record.time_s.clear();
  for (int n = 0; n < 40; ++n) record.time_s.push_back(0.1 * n);
  std::vector<double> holed = constant(1.0, 40);
  for (std::size_t n = 10; n < 10 + kMostBridgedAccelSamples + 1; ++n) holed[n] = kNan;
  record.others = {
      {"accel_x_mps2", holed}, {"accel_y_mps2", constant(0, 40)}, {"accel_z_mps2", constant(0, 40)}};
  EXPECT_THAT(
      [&] { static_cast<void>(accelerometer_of(record)); },
      ThrowsMessage<FileError>(AllOf(HasSubstr("accel_x_mps2"), HasSubstr("16"), HasSubstr("1.000 s"))));
}

TEST(TruthColumns, QuaternionsAndPlacesOfALevelFrameBecomeNed) {
  std::vector<double> x;
  for (int n = 0; n < 10; ++n) x.push_back(5.0 + 0.2 * n);
  const Record record = record_with({{"gt_q_w", constant(std::cos(0.15))},
                                     {"gt_q_x", constant(0.0)},
                                     {"gt_q_y", constant(0.0)},
                                     {"gt_q_z", constant(std::sin(0.15))},
                                     {"gt_p_x_m", x},
                                     {"gt_p_y_m", constant(3.0)},
                                     {"gt_p_z_m", constant(1.0)}});
  const auto truth = truth_columns(record, std::nullopt, kReference);
  ASSERT_TRUE(truth);
  EXPECT_TRUE(truth->local);
  EXPECT_TRUE(truth->velocity_differentiated);
  const core::EulerAngles angles = core::euler_of(truth->truth.attitude[3]);
  EXPECT_NEAR(angles.heading_rad, -0.3, 1e-15);  // to the left
  EXPECT_NEAR(std::abs(angles.roll_rad), std::numbers::pi, 1e-15);
  const Eigen::Vector3d way = core::way_m(kReference, truth->truth.position[5]);
  EXPECT_LT((way - Eigen::Vector3d(1.0, 0.0, 0.0)).norm(), 1e-8);  // the first place is the reference
  EXPECT_NEAR(truth->truth.velocity_mps[5].x(), 2.0, 1e-6);
}

TEST(TruthColumns, OtherSpellingsAreTheSame) {
  const Record record = record_with({{"opt_pos_x_m", constant(1.0)},
                                     {"opt_pos_y_m", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}},
                                     {"opt_pos_z_m", constant(1.0)},
                                     {"opt_roll_deg", constant(10.0)},
                                     {"opt_pitch_deg", constant(-20.0)},
                                     {"opt_yaw_deg", constant(170.0)}});
  const auto truth = truth_columns(record, "opt", kReference);
  ASSERT_TRUE(truth);
  EXPECT_NEAR(core::euler_of(truth->truth.attitude[0]).heading_rad, 170.0 * kDegree, 1e-14);
  EXPECT_NEAR(core::way_m(kReference, truth->truth.position[1]).y(), -1.0, 1e-8);
}

TEST(TruthColumns, GeodeticPlacesAndVelocitiesAreTakenAsTheyAre) {
  const Record record = record_with({{"lat_deg", constant(40.0)},
                                     {"lon_deg", constant(-105.0)},
                                     {"h_m", constant(1600.0)},
                                     {"vn_mps", constant(1.0)},
                                     {"ve_mps", constant(2.0)},
                                     {"vu_mps", constant(3.0)}});
  const auto truth = truth_columns(record, std::nullopt, kReference);
  ASSERT_TRUE(truth);
  EXPECT_FALSE(truth->local);
  EXPECT_FALSE(truth->velocity_differentiated);
  EXPECT_FALSE(truth->truth.has_attitude());
  EXPECT_DOUBLE_EQ(truth->truth.position[4].longitude_rad, -105.0 * kDegree);
  EXPECT_EQ(truth->truth.velocity_mps[4], Eigen::Vector3d(1.0, 2.0, -3.0));
}

TEST(TruthColumns, LostSamplesAndBrokenQuaternionsAreNotANumber) {
  std::vector<double> w = constant(1.0);
  w[2] = kNan;
  w[3] = 0.5;  // length 0.5
  const Record record =
      record_with({{"q_w", w}, {"q_x", constant(0)}, {"q_y", constant(0)}, {"q_z", constant(0)}});
  const auto truth = truth_columns(record, std::nullopt, kReference);
  ASSERT_TRUE(truth);
  EXPECT_TRUE(core::is_known(truth->truth.attitude[1]));
  EXPECT_FALSE(core::is_known(truth->truth.attitude[2]));
  EXPECT_FALSE(core::is_known(truth->truth.attitude[3]));
}

TEST(TruthColumns, AReferenceSlowerThanTheRecordingCountsWhereItIsNew) {
  const Record record =
      record_with({{"ref_lat_deg", {40, 40, 40, 40, 40.0001, 40.0001, 40.0001, 40.00015, 40.0002, 40.0002}},
                   {"ref_lon_deg", constant(0.0)},
                   {"ref_h_m", constant(0.0)}});
  const auto truth = truth_columns(record, std::nullopt, kReference);
  ASSERT_TRUE(truth);
  EXPECT_EQ(truth->held, 7U);
  ASSERT_EQ(truth->truth.size(), 3U);
  EXPECT_DOUBLE_EQ(truth->truth.time_s[1], 0.4);
  EXPECT_DOUBLE_EQ(truth->truth.time_s[2], 0.8) << "not 0.7, which lies between two of the reference's own";
}

TEST(TruthColumns, NeedAChoiceWhereThereAreSeveral) {
  std::map<std::string, std::vector<double>, std::less<>> columns;
  for (const std::string name :
       {"a_lat_deg", "a_lon_deg", "a_h_m", "b_vn_mps", "b_ve_mps", "b_vd_mps", "c_q_w"})
    columns[name] = constant(1.0);
  const Record record = record_with(columns);
  EXPECT_THAT([&] { static_cast<void>(truth_columns(record, std::nullopt, kReference)); },
              ThrowsMessage<FileError>(AllOf(HasSubstr("'a_', 'b_'"), HasSubstr("--truth"))));
  EXPECT_TRUE(truth_columns(record, "b_", kReference)->truth.has_velocity());
  EXPECT_THAT([&] { static_cast<void>(truth_columns(record, "c", kReference)); },
              ThrowsMessage<FileError>(AllOf(HasSubstr("'c'"), HasSubstr("'a_', 'b_'"))));
  EXPECT_FALSE(truth_columns(record_with({{"temp_c", constant(20)}}), std::nullopt, kReference));
}

class TruthFile : public ::testing::Test {
 protected:
  NavigationTruth load(const std::string& text, double offset_s = 0.0) {
    return load_truth(folder_.write("gnss.csv", text), record_with({}), {offset_s, kReference});
  }
  void expect_refused(const std::string& text, const ::testing::Matcher<std::string>& message) {
    EXPECT_THAT([&] { static_cast<void>(load(text)); }, ThrowsMessage<FileError>(message));
  }

 private:
  testing::ScratchFolder folder_;
};

TEST_F(TruthFile, HasTimesOfItsOwn) {
  const NavigationTruth truth =
      load("stamp_ms,vn_mps,ve_mps,vu_mps,fix\n1000100,1,2,3,1\n1000350,1,2,nan,1\n1000600,1,2,3,1\n", -0.05);
  ASSERT_EQ(truth.truth.size(), 3U);
  EXPECT_NEAR(truth.truth.time_s[0], 0.05, 1e-9);
  EXPECT_NEAR(truth.truth.time_s[2], 0.55, 1e-9);
  EXPECT_FALSE(core::is_known(truth.truth.velocity_mps[1]));
  EXPECT_EQ(truth.source, "gnss.csv");
}

TEST_F(TruthFile, ThatCannotBeUsedIsNamedWithTheReason) {
  expect_refused("", AllOf(HasSubstr("gnss.csv"), HasSubstr("empty")));
  expect_refused("vn_mps,ve_mps,vu_mps\n1,2,3\n", HasSubstr("timestamp_s"));
  expect_refused("timestamp_s,vn_mps,ve_mps\n1000,1,2\n",
                 AllOf(HasSubstr("no reference"), HasSubstr("ve_mps")));
  expect_refused("timestamp_s,vn_mps,ve_mps,vu_mps\n1000,1,2\n",
                 AllOf(HasSubstr("gnss.csv:2"), HasSubstr("4")));
  expect_refused("timestamp_s,vn_mps,ve_mps,vu_mps\nten,1,2,3\n",
                 AllOf(HasSubstr("gnss.csv:2"), HasSubstr("ten")));
  expect_refused("timestamp_s,vn_mps,ve_mps,vu_mps\n1000.2,1,2,3\n1000.1,1,2,3\n",
                 AllOf(HasSubstr("gnss.csv:3"), HasSubstr("rise")));
  expect_refused("timestamp_s,vn_mps,ve_mps,vu_mps\n5.0,1,2,3\n",
                 AllOf(HasSubstr("walk.csv"), HasSubstr("--truth-offset")));
}

}  // namespace
}  // namespace gyrod::files
