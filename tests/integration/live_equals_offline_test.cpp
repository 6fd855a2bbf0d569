#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <zlib.h>

#include "app/exit_code.hpp"
#include "rig.hpp"
#include "support/data_folder.hpp"
#include "support/slow_build.hpp"

namespace gyrod::testing {
namespace {

const auto kWorkers = kSlowBuild ? std::vector<std::size_t>{1, 4} : std::vector<std::size_t>{1, 2, 4};
const std::size_t kDrive = kSlowBuild ? 2500 : 5000;
const auto kBatches = kSlowBuild ? std::vector<std::size_t>{7} : std::vector<std::size_t>{1, 7, 64};

const std::vector<std::string> kRates = {"gyro_x_radps", "gyro_y_radps", "gyro_z_radps"};

class LiveEqualsOffline : public Rig {
 protected:
  /// Replays the recording under that sensor's name and records what the daemon publishes, every number to
  /// the last bit.
  void replay(const std::string& recording, const std::string& sensor, std::size_t batch,
              const std::string& unit, const std::string& out, int recorded = app::kDone) {
    const auto recorder = start_recorder(out, {"--sensor", sensor, "--until-end", "--unit", unit});
    send(recording, sensor, batch);
    ASSERT_EQ(recorder->wait(), recorded) << recorder->err();
  }
  /// The same, with what is published without look-ahead in `realtime`.
  void replay_both(const std::string& recording, const std::string& sensor, std::size_t batch,
                   const std::string& unit, const std::string& out, const std::string& realtime) {
    const auto recorder =
        start_recorder(realtime, {"--sensor", sensor, "--until-end", "--unit", unit}, "gyro/realtime");
    replay(recording, sensor, batch, unit, out);
    ASSERT_EQ(recorder->wait(), app::kDone) << recorder->err();
  }
  void simulate_drive(const std::string& out, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {
        "simulate", "--motion", "drive", "--samples", std::to_string(kDrive), "-o", path(out)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(run(arguments).exit_code, 0);
  }
  void denoise(const std::string& recording, const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"denoise", path(recording), "-o", path(out), "--std"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result result = run(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  /// Live and offline, by method joint, with look-ahead and without.
  void expect_same(const std::string& recording, const std::string& unit) {
    denoise(recording, "offline.csv", {});
    denoise(recording, "offline_realtime.csv", {"--estimate", "realtime"});
    const auto columns = rates_and_deviations(unit);
    const auto denoised = columns_of(path("offline.csv"), columns);
    const auto realtime = columns_of(path("offline_realtime.csv"), columns);
    ASSERT_FALSE(denoised == realtime);
    for (const std::size_t workers : kWorkers) {
      const auto daemon = start_daemon({.workers = workers});
      for (const std::size_t batch : kBatches) {
        replay_both(path(recording), "batch" + std::to_string(batch), batch, unit, "live.csv",
                    "live_realtime.csv");
        const std::string where = std::to_string(workers) + " workers, batches of " + std::to_string(batch);
        EXPECT_TRUE(columns_of(path("live.csv"), columns) == denoised) << where;
        EXPECT_TRUE(columns_of(path("live_realtime.csv"), columns) == realtime) << where << ", realtime";
      }
      EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
    }
  }
  static std::vector<std::string> rates_and_deviations(const std::string& unit) {
    std::vector<std::string> names;
    for (const std::string column : {"gyro_x", "gyro_y", "gyro_z", "gyro_std_x", "gyro_std_y", "gyro_std_z"})
      names.push_back(column + "_" + unit);
    return names;
  }

 private:
  void send(const std::string& recording, const std::string& sensor, std::size_t batch) {
    const Result replayed = run_on_bus({"replay", recording, "--sensor", sensor, "--speed", "max", "--batch",
                                        std::to_string(batch), "--wait", "60"});
    ASSERT_EQ(replayed.exit_code, 0) << replayed.err;
  }
};

TEST_F(LiveEqualsOffline, OnASimulatedDriveForAnyNumberOfWorkersAndAnyBatch) {
  simulate_drive("drive.csv");
  expect_same("drive.csv", "radps");
  EXPECT_EQ(columns_of(path("live.csv"), {"sequence"}).size(), kDrive);
}

TEST_F(LiveEqualsOffline, OnAFastSensorWhoseWindowsDouble) {
  simulate_drive("fast.csv", {"--rate", "1000"});
  expect_same("fast.csv", "radps");
}

TEST_F(LiveEqualsOffline, ByMethodPaper) {
  simulate_drive("drive.csv");
  denoise("drive.csv", "offline.csv", {"--method", "paper"});
  const auto daemon = start_daemon({.method = "paper"});
  replay(path("drive.csv"), "imu", 7, "radps", "live.csv");
  const auto columns = rates_and_deviations("radps");
  EXPECT_TRUE(columns_of(path("live.csv"), columns) == columns_of(path("offline.csv"), columns));
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

TEST_F(LiveEqualsOffline, OnARecordingWithEverythingThatIsRefused) {
  std::string text = noisy_recording(2000);
  const auto append = [&text](int sequence, std::int64_t stamp_ms, const std::string& rate) {
    text +=
        std::to_string(sequence) + "," + std::to_string(stamp_ms * 1'000'000) + "," + rate + ",0.01,0.02\n";
  };
  append(2000, 20000, "nan");
  append(2001, 20010, "inf");
  append(2002, 20020, "1e300");
  append(2003, 20030, "0.01");
  append(2003, 20030, "0.01");  // duplicate
  append(1990, 19900, "0.01");  // out of order: position 1990 has arrived
  append(2004, 20020, "0.01");  // time goes back
  append(2008, 20080, "0.01");  // a gap of 3 and the refused one
  // A gap of 10 windows, then a constant, then zero, then the coarse steps of a converter.
  const std::array<std::string, 3> plateaus = {"0.01", "0", "0.0008726646259971648"};
  for (std::size_t n = 0; n < 900; ++n) {
    const std::string& rate = n < 600 ? plateaus[n / 300] : plateaus[n / 7 % 2 + 1];
    append(13000 + static_cast<int>(n), 130000 + 10 * static_cast<std::int64_t>(n), rate);
  }
  write_file("bad.csv", text);
  const Result offline =
      run({"denoise", path("bad.csv"), "-o", path("offline.csv"), "--summary", path("summary.json")});
  ASSERT_EQ(offline.exit_code, 0) << offline.err;

  const auto daemon = start_daemon();
  replay(path("bad.csv"), "imu", 7, "radps", "live.csv", app::kIncomplete);  // what is refused is missing
  const auto counted = [&](const std::string& reason) {
    return metric(*daemon, "gyrod_samples_rejected_total{reason=\"" + reason + "\"}").value_or(-1.0);
  };
  EXPECT_EQ(counted("not_finite"), 2.0);
  EXPECT_EQ(counted("out_of_range"), 1.0);
  EXPECT_EQ(counted("duplicate") + counted("out_of_order"), 2.0);
  EXPECT_EQ(counted("time_backwards"), 1.0);
  EXPECT_EQ(metric(*daemon, "gyrod_samples_received_total"), 2908.0);
  EXPECT_EQ(metric(*daemon, "gyrod_samples_published_total"), 2902.0);
  EXPECT_EQ(metric(*daemon, "gyrod_samples_in_flight"), 0.0);

  // Offline keeps refused rows where they were: they are the rows that live does not have.
  auto kept = columns_of(path("offline.csv"), {"sequence", "gyro_x_radps", "gyro_y_radps", "gyro_z_radps"});
  const auto refused =
      columns_of(path("bad.csv"), {"sequence", "gyro_x_radps", "gyro_y_radps", "gyro_z_radps"});
  std::vector<std::size_t> refused_rows = {2000, 2001, 2002, 2004, 2005, 2006};
  for (std::size_t i = refused_rows.size(); i-- > 0;) {
    EXPECT_EQ(kept[refused_rows[i]], refused[refused_rows[i]]) << "kept as it was";
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(refused_rows[i]));
  }
  EXPECT_EQ(columns_of(path("live.csv"), {"sequence", "gyro_x_radps", "gyro_y_radps", "gyro_z_radps"}), kept);
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

TEST_F(LiveEqualsOffline, OnRecordingsOfOneToEightSamples) {
  const auto daemon = start_daemon();
  for (std::uint64_t samples = 1; samples <= 8; ++samples) {
    write_file("short.csv", noisy_recording(samples));
    ASSERT_EQ(run({"denoise", path("short.csv"), "-o", path("offline.csv")}).exit_code, 0);
    replay(path("short.csv"), "short" + std::to_string(samples), 1, "radps", "live.csv");
    const auto live = columns_of(path("live.csv"), kRates);
    EXPECT_EQ(live.size(), samples);
    EXPECT_EQ(live, columns_of(path("offline.csv"), kRates));
  }
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

/// The first rows of a gzip recording, or nothing where it is not there.
std::string first_rows(const std::filesystem::path& file, std::size_t rows) {
  gzFile in = gzopen(file.c_str(), "rb");
  if (in == nullptr) return {};
  std::string text;
  std::array<char, 4096> line{};
  for (std::size_t n = 0; n <= rows && gzgets(in, line.data(), static_cast<int>(line.size())) != nullptr;
       ++n) {
    text += line.data();
  }
  gzclose(in);
  return text;
}

TEST_F(LiveEqualsOffline, OnARealGyroThatLearnsItsNoise) {
  const auto file = test::data_folder() / "adis16405_imu1_static_100hz.csv.gz";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no real recording: " << file << " (set GYROD_DATA)";
  write_file("real.csv", first_rows(file, kSlowBuild ? 3000 : 8000));
  expect_same("real.csv", "dps");
}

}  // namespace
}  // namespace gyrod::testing
