#include "files/sample_writer.hpp"

#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include "files/recording_reader.hpp"
#include "support/scratch_folder.hpp"

namespace gyrod::files {
namespace {

/// No digits that a short decimal could stand for.
const stream::Sample kSample{7, 1'700'000'000'123'456'789, {1.0 / 3.0, -2.0 / 7.0, 1e-17 / 3.0}};

TEST(SampleWriter, MeasuredRowHasItsColumns) {
  const gyrod::testing::ScratchFolder scratch;
  SampleWriter writer(scratch.path("a.csv"), RowKind::kMeasured, RateUnit::kRadps);
  writer.write_measured("imu", {1, -2, {0.5, 0.25, -1.0}});
  writer.close();
  EXPECT_EQ(scratch.read("a.csv"),
            "sensor,sequence,stamp_ns,gyro_x_radps,gyro_y_radps,gyro_z_radps\nimu,1,-2,0.5,0.25,-1\n");
}

TEST(SampleWriter, DenoisedRowHasItsColumns) {
  const gyrod::testing::ScratchFolder scratch;
  SampleWriter writer(scratch.path("a.csv"), RowKind::kDenoised, RateUnit::kRadps);
  stream::DenoisedSample sample;
  sample.sequence = 3;
  sample.rate_radps = {1.0, 2.0, 3.0};
  sample.rate_std_radps = {0.01, 0.02, 0.03};
  sample.flags = 5;
  sample.noise_source = stream::NoiseSource::kImf1;
  sample.noise_floor_radps = {0.1, 0.2, 0.3};
  sample.model_epoch = 9;
  writer.write_denoised("imu", sample);
  writer.close();
  EXPECT_EQ(scratch.read("a.csv"),
            "sensor,sequence,stamp_ns,gyro_x_radps,gyro_y_radps,gyro_z_radps,"
            "gyro_std_x_radps,gyro_std_y_radps,gyro_std_z_radps,flags,noise_source,"
            "noise_floor_x_radps,noise_floor_y_radps,noise_floor_z_radps,model_epoch\n"
            "imu,3,0,1,2,3,0.01,0.02,0.03,5,1,0.1,0.2,0.3,9\n");
}

TEST(SampleWriter, SimulatedRowHoldsTheTruth) {
  const gyrod::testing::ScratchFolder scratch;
  SampleWriter writer(scratch.path("a.csv"), RowKind::kSimulated, RateUnit::kMradps);
  writer.write_simulated("imu", {0, 0, {0.5, 0.25, 1.0}}, {1.0, 2.0, 4.0});
  writer.close();
  EXPECT_EQ(
      scratch.read("a.csv"),
      "sensor,sequence,stamp_ns,gyro_x_mradps,gyro_y_mradps,gyro_z_mradps,truth_x_mradps,truth_y_mradps,"
      "truth_z_mradps\nimu,0,0,500,250,1000,1000,2000,4000\n");
}

TEST(SampleWriter, ReadsBackBitForBit) {
  const gyrod::testing::ScratchFolder scratch;
  for (const RowKind kind : {RowKind::kMeasured, RowKind::kSimulated}) {
    SampleWriter writer(scratch.path("a.csv.gz"), kind, RateUnit::kRadps);
    if (kind == RowKind::kMeasured) writer.write_measured("front, left \"A\"", kSample);
    if (kind == RowKind::kSimulated) writer.write_simulated("front", kSample, {});
    writer.close();
    RecordingReader reader(scratch.path("a.csv.gz"));
    RecordingRow row;
    ASSERT_TRUE(reader.next(row));
    EXPECT_EQ(row.sample.sequence, kSample.sequence);
    EXPECT_EQ(row.sample.stamp_ns, kSample.stamp_ns);
    EXPECT_EQ(row.sample.rate_radps, kSample.rate_radps);
  }
}

}  // namespace
}  // namespace gyrod::files
