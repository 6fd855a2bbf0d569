/// What the API tells of one sensor, figure by figure: units, axes, times, and what is left out.
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "unit/monitor/api_fixture.hpp"

namespace gyrod::monitor::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class ApiFiguresTest : public ApiTest {
 protected:
  static constexpr std::int64_t kPeriodNs = 10'000'000;
  static constexpr std::int64_t kStartNs = 1'700'000'000'000'000'000;

  [[nodiscard]] json sensor() { return get("channels/imu_front"); }
  stream::NoiseReport& report() { return shown_.channels[0].last_report; }

  /// A sample of a 100 Hz sensor, raw and, a tenth of it, denoised.
  void send(std::int64_t number, double x, double y, double z) {
    const std::int64_t stamp_ns = kStartNs + number * kPeriodNs;
    const stream::Sample raw{
        .sequence = static_cast<std::uint64_t>(number), .stamp_ns = stamp_ns, .rate_radps = {x, y, z}};
    live_.tap.on_raw("imu_front", {&raw, 1});
    stream::DenoisedSample denoised;
    denoised.stamp_ns = stamp_ns;
    denoised.rate_radps = {0.1 * x, 0.1 * y, 0.1 * z};
    live_.tap.on_denoised("imu_front", {&denoised, 1});
  }
};

TEST_F(ApiFiguresTest, AModeInItsUnits) {
  report().sample_rate_hz = 200.0;
  report().axis[2].imf[1] = {.imf_class = core::ImfClass::kMixed,
                             .pcc = 0.5,
                             .acf_variance = 0.01,
                             .acf_concentration = 0.6,
                             .mean_period_samples = 50.0,
                             .energy = 0.0625,
                             .excess = 3.0,
                             .noise_excess_low = 0.7,
                             .noise_excess_high = 1.4,
                             .noise_probability = 0.02,
                             .model = {}};
  core::ModelFigures& model = report().axis[2].imf[1].model;
  model.family = core::ModelFamily::kArma;
  model.ar_order = 3;
  model.ma_order = 2;
  model.innovation_variance = 0.0004;
  model.used = true;
  EXPECT_EQ(sensor().at("report").at("axes")[2].at("imfs")[1], json::parse(R"({
    "class": "mixed", "mean_period_s": 0.25, "mean_period_samples": 50.0, "energy": 0.0625, "rms_radps": 0.25,
    "pcc": 0.5, "acf_variance": 0.01, "acf_concentration": 0.6, "excess": 3.0, "noise_excess_low": 0.7,
    "noise_excess_high": 1.4, "noise_probability": 0.02,
    "model": {"family": "arma", "ar_order": 3, "ma_order": 2, "innovation_std_radps": 0.02, "used": true}})"));
  const json untested = sensor().at("report").at("axes")[2].at("imfs")[0];
  for (const char* key : {"mean_period_s", "pcc", "acf_variance", "excess", "noise_probability", "model"})
    EXPECT_TRUE(untested.at(key).is_null()) << key;
}

TEST_F(ApiFiguresTest, EveryAxisHasItsOwn) {
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    const double scale = 1.0 + static_cast<double>(axis);
    shown_.channels[0].health->axis[axis] = {static_cast<stream::Health>(5 + axis), 2.0 * scale, scale};
    const json row = sensor().at("axes")[axis];
    EXPECT_EQ(row.at("health"), stream::name_of(static_cast<stream::Health>(5 + axis)));
    EXPECT_EQ(row.at("value"), 2.0 * scale);
    EXPECT_EQ(row.at("limit"), scale);
    const json of_window = sensor().at("report").at("axes")[axis];
    EXPECT_EQ(of_window.at("noise_floor_radps"), 0.008 * scale);
    EXPECT_EQ(of_window.at("output_noise_radps"), 0.002 * scale);
    EXPECT_EQ(of_window.at("tone").at("frequency_hz"), 0.2 * scale * 98.0);
  }
  EXPECT_EQ(sensor().at("bias").at("seconds"), 60.0);
}

TEST_F(ApiFiguresTest, EveryFlagHasItsName) {
  using stream::SampleFlag;
  const std::vector<std::pair<SampleFlag, std::string>> names = {{SampleFlag::kWarmingUp, "warming_up"},
                                                                 {SampleFlag::kTail, "tail"},
                                                                 {SampleFlag::kPassThrough, "pass_through"},
                                                                 {SampleFlag::kHopWidened, "hop_widened"},
                                                                 {SampleFlag::kModelMisfit, "model_misfit"}};
  for (const auto& [flag, name] : names) {
    report().flags = static_cast<std::uint32_t>(flag);
    EXPECT_THAT(sensor().at("report").at("flags"), ElementsAre(name));
  }
  report().flags = 0;
  EXPECT_THAT(sensor().at("report").at("flags"), IsEmpty());
}

/// sigma^2 = squares / (2 m^2 M): a term of 8 is 4 (rad/s)^2 at m = 1, and 1 at m = 2.
TEST_F(ApiFiguresTest, TheAllanCurveIsThatOfItsAxis) {
  shown_.channels[0].curves_rate_hz = 50.0;
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    auto& sums = shown_.channels[0].curves[axis];
    sums = {};
    const double scale = 1.0 + static_cast<double>(axis);
    sums.terms = {400, 100};
    sums.squares = {400.0 * 8.0 * scale * scale, 100.0 * 8.0 * scale * scale};
    const json allan = sensor().at("allan").at("axes")[axis];
    EXPECT_THAT(allan.at("tau_s"), ElementsAre(0.02, 0.04));
    EXPECT_THAT(allan.at("deviation_radps"), ElementsAre(2.0 * scale, scale));
    EXPECT_THAT(allan.at("terms"), ElementsAre(400, 100));
  }
}

TEST_F(ApiFiguresTest, SamplesAreOfTheirAxisAndTime) {
  (void)get("channels/imu_front/samples?seconds=10&points=100");
  for (int n = 0; n < 20; ++n) send(n, n, 100.0 + n, -n);
  const json samples = get("channels/imu_front/samples?seconds=10&points=100");
  EXPECT_EQ(samples.at("bucket_s"), 0.1);
  const double first_s =
      static_cast<double>(kStartNs - std::stoll(samples.at("from_ns").get<std::string>())) / 1e9;
  const json& raw = samples.at("raw");
  ASSERT_EQ(raw.at("t_s").size(), 2U);
  EXPECT_NEAR(raw.at("t_s")[0].get<double>(), first_s + 0.05, 1e-9) << "the middle of its stretch";
  EXPECT_THAT(raw.at("x_min"), ElementsAre(0.0, 10.0));
  EXPECT_THAT(raw.at("x_max"), ElementsAre(9.0, 19.0));
  EXPECT_THAT(raw.at("y_min"), ElementsAre(100.0, 110.0));
  EXPECT_THAT(raw.at("y_max"), ElementsAre(109.0, 119.0));
  EXPECT_THAT(raw.at("z_min"), ElementsAre(-9.0, -19.0));
  EXPECT_THAT(raw.at("z_max"), ElementsAre(0.0, -10.0));
  EXPECT_THAT(samples.at("denoised").at("y_max"), ElementsAre(10.9, 11.9));
}

TEST_F(ApiFiguresTest, RestAndGapsAreTold) {
  shown_.channels[0].sample_rate_hz = 100.0;
  (void)get("channels/imu_front/samples");
  for (const int n : {0, 1, 2, 102, 103}) send(n, 1.0, 1.0, 1.0);
  stream::NoiseReport at_rest;
  at_rest.at_rest = true;
  for (const int n : {1, 3}) {
    at_rest.last_stamp_ns = kStartNs + n * kPeriodNs;
    live_.tap.on_report("imu_front", at_rest);
  }
  const json samples = get("channels/imu_front/samples");
  const double first_s =
      static_cast<double>(kStartNs - std::stoll(samples.at("from_ns").get<std::string>())) / 1e9;
  ASSERT_EQ(samples.at("gaps").size(), 1U);
  EXPECT_NEAR(samples.at("gaps")[0][0].get<double>(), first_s + 0.02, 1e-9);
  EXPECT_NEAR(samples.at("gaps")[0][1].get<double>(), first_s + 1.02, 1e-9);
  ASSERT_EQ(samples.at("rest").size(), 1U);
  EXPECT_NEAR(samples.at("rest")[0][0].get<double>(), first_s + 0.01, 1e-9);
  EXPECT_NEAR(samples.at("rest")[0][1].get<double>(), first_s + 0.03, 1e-9);
}

/// The same wave, twice and three times as large on y and z, and a tenth denoised.
TEST_F(ApiFiguresTest, TheSpectrumIsThatOfItsAxis) {
  shown_.channels[0].sample_rate_hz = 100.0;
  (void)get("channels/imu_front/spectrum");
  for (int n = 0; n < 1024; ++n) {
    const double wave = 0.01 * std::sin(2.0 * n);
    send(n, wave, 2.0 * wave, 3.0 * wave);
  }
  const json axes = get("channels/imu_front/spectrum").at("axes");
  const auto largest = [&axes](std::size_t axis, const char* kind) {
    double most = 0.0;
    for (const json& value : axes[axis].at(kind)) most = std::max(most, value.get<double>());
    return most;
  };
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    const double scale = 1.0 + static_cast<double>(axis);
    EXPECT_NEAR(largest(axis, "raw"), scale * largest(0, "raw"), 1e-6 * largest(axis, "raw"))
        << "single precision";
    EXPECT_NEAR(largest(axis, "denoised"), 0.1 * largest(axis, "raw"), 1e-6 * largest(axis, "raw"));
  }
}

}  // namespace
}  // namespace gyrod::monitor::test
