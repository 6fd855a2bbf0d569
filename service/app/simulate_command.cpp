#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "app/angle_units.hpp"
#include "app/command.hpp"
#include "app/errors.hpp"
#include "app/exit_code.hpp"
#include "app/flags.hpp"
#include "app/progress_bar.hpp"
#include "app/sample_sender.hpp"
#include "core/simulation/simulated_gyro.hpp"
#include "files/sample_writer.hpp"

namespace gyrod::app {
namespace {

constexpr double kSecondsPerHour = 3600.0;

/// Error terms in the units of data sheets; the defaults are those of core::GyroErrorOptions.
struct ErrorFlags {
  core::GyroErrorOptions defaults{};
  double angle_random_walk_deg_per_sqrt_h = defaults.white_noise_density / core::noise_density_of(1.0);
  double bias_instability_dph = defaults.bias_instability_radps / kRadPerDeg * kSecondsPerHour;
  double rate_random_walk_dph_per_sqrt_h =
      defaults.rate_random_walk / kRadPerDeg * kSecondsPerHour * std::sqrt(kSecondsPerHour);
  double bias_dps = 0.0;
  double step_dps = defaults.step_radps / kRadPerDeg;
  double range_dps = defaults.range_radps / kRadPerDeg;

  void add_to(CLI::App& command);
  [[nodiscard]] core::GyroErrorOptions options() const;
};

struct SimulateFlags {
  bool drive = false;
  double rate_hz = 100.0;
  std::uint64_t seed = 1;
  std::optional<double> seconds;
  std::optional<std::uint64_t> samples;
  double engine_tone_dps = 0.0;
  double engine_tone_hz = core::DriveOptions{}.engine_tone_hz;
  std::string output;
  files::RateUnit unit = files::RateUnit::kRadps;
  ErrorFlags errors;
  BusFlags bus;
  SendFlags send;
};

void ErrorFlags::add_to(CLI::App& command) {
  constexpr double kMost = 1e9;
  const auto add = [&command](const char* name, double& value, const char* unit, const std::string& what) {
    command.add_option(name, value, what)
        ->type_name(unit)
        ->check(in_range(0.0, kMost))
        ->group("Sensor errors");
  };
  add("--angle-random-walk", angle_random_walk_deg_per_sqrt_h, "DEG/SQRT(H)", "White noise [2.1]");
  add("--bias-instability", bias_instability_dph, "DEG/H", "Flicker noise, B of IEEE Std 952 [37]");
  add("--rate-random-walk", rate_random_walk_dph_per_sqrt_h, "DEG/H/SQRT(H)", "Random walk of the bias [62]");
  add("--step", step_dps, "DEG/S", "Step of the converter; 0 for none [0.05]");
  add("--range", range_dps, "DEG/S", "Largest rate it can tell; 0 for no limit [300]");
  command.add_option("--bias", bias_dps, "Constant bias [0]")
      ->type_name("DEG/S")
      ->check(in_range(-kMost, kMost))
      ->group("Sensor errors");
}

core::GyroErrorOptions ErrorFlags::options() const {
  return {.white_noise_density = core::noise_density_of(angle_random_walk_deg_per_sqrt_h),
          .bias_instability_radps = bias_instability_dph * kRadPerDeg / kSecondsPerHour,
          .rate_random_walk =
              rate_random_walk_dph_per_sqrt_h * kRadPerDeg / kSecondsPerHour / std::sqrt(kSecondsPerHour),
          .bias_radps = bias_dps * kRadPerDeg,
          .step_radps = step_dps * kRadPerDeg,
          .range_radps = range_dps * kRadPerDeg};
}

/// A tone that nobody would find in the samples is not what was asked for.
void check(const SimulateFlags& flags) {
  if (flags.engine_tone_dps == 0.0) return;
  if (!flags.drive) throw CLI::ValidationError("--engine-tone is for --motion drive");
  if (flags.engine_tone_hz < 0.5 * flags.rate_hz) return;
  throw CLI::ValidationError("--engine-tone-hz is " + fmt::format("{:g}", flags.engine_tone_hz) +
                             ": expected less than half of --rate, " +
                             fmt::format("{:g}", 0.5 * flags.rate_hz));
}

core::SimulatedGyroOptions gyro_options(const SimulateFlags& flags) {
  core::SimulatedGyroOptions options;
  options.sample_rate_hz = flags.rate_hz;
  options.seed = flags.seed;
  options.errors.fill(flags.errors.options());
  if (flags.drive) {
    options.drive = core::DriveOptions{};
    options.drive->engine_tone_radps = flags.engine_tone_dps * kRadPerDeg;
    options.drive->engine_tone_hz = flags.engine_tone_hz;
  }
  return options;
}

/// Samples to make; without a limit a file gets a minute of them, and the bus all there are.
std::uint64_t sample_count(const SimulateFlags& flags) {
  if (flags.samples) return *flags.samples;
  if (flags.seconds) return static_cast<std::uint64_t>(std::llround(*flags.seconds * flags.rate_hz));
  constexpr double kFileSeconds = 60.0;
  if (!flags.output.empty()) return static_cast<std::uint64_t>(kFileSeconds * flags.rate_hz);
  return std::numeric_limits<std::uint64_t>::max();
}

int simulate_to_file(const SimulateFlags& flags, Interrupt& interrupt) {
  core::SimulatedGyro gyro(gyro_options(flags));
  files::SampleWriter writer(flags.output, files::RowKind::kSimulated, flags.unit);
  ProgressBar progress("simulating");
  const std::uint64_t count = sample_count(flags);
  constexpr std::uint64_t kLookUpEvery = 4096;
  for (std::uint64_t n = 0; n < count; ++n) {
    const core::SimulatedSample sample = gyro.next();
    writer.write_simulated(flags.send.sensor, {sample.sequence, sample.stamp_ns, sample.measured_radps},
                           sample.truth_radps);
    if (n % kLookUpEvery != 0) continue;
    if (interrupt.requested()) return kInterrupted;
    progress.show(static_cast<double>(n) / static_cast<double>(count), n);
  }
  writer.close();
  std::fprintf(stderr, "%s: %llu samples of sensor '%s'\n", flags.output.c_str(),
               static_cast<unsigned long long>(count), flags.send.sensor.c_str());
  return kDone;
}

/// Gyros of the seeds N, N + 1, ... Each begins a little later than the one before, so that their messages are spread over the time
/// between two of one sensor, in steps of 1 ms.
std::vector<core::SimulatedGyro> spread_gyros(const SimulateFlags& flags,
                                              core::SimulatedGyroOptions options) {
  constexpr std::int64_t kStepNs = 1'000'000;
  const std::int64_t first_stamp_ns = options.first_stamp_ns;
  const auto message_ns =
      static_cast<std::int64_t>(static_cast<double>(flags.send.batch) * 1e9 / flags.rate_hz);
  const auto sensors = static_cast<std::int64_t>(flags.send.sensors);
  std::vector<core::SimulatedGyro> gyros;
  for (std::int64_t k = 0; k < sensors; ++k) {
    options.first_stamp_ns = first_stamp_ns + message_ns / kStepNs * k / sensors * kStepNs;
    gyros.emplace_back(options);
    ++options.seed;
  }
  return gyros;
}

int simulate_to_bus(const SimulateFlags& flags, Interrupt& interrupt) {
  core::SimulatedGyroOptions options = gyro_options(flags);
  options.first_stamp_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(
                               std::chrono::system_clock::now().time_since_epoch())
                               .count();
  const settings::Settings settings = flags.bus.load();
  std::vector<core::SimulatedGyro> gyros = spread_gyros(flags, options);
  SampleSender sender(settings.bus, flags.send, interrupt);
  const std::uint64_t count = sample_count(flags);
  bool sending = true;
  for (std::uint64_t n = 0; n < count && sending; ++n) {
    for (std::size_t k = 0; k < gyros.size() && sending; ++k) {
      const core::SimulatedSample sample = gyros[k].next();
      sending = sender.send({sample.sequence, sample.stamp_ns, sample.measured_radps}, k);
    }
  }
  sender.finish();
  const bool several = flags.send.sensors > 1;
  std::fprintf(stderr, "%llu samples of %s'%s%s' sent\n", static_cast<unsigned long long>(sender.sent()),
               several ? (std::to_string(flags.send.sensors) + " sensors ").c_str() : "sensor ",
               flags.send.sensor.c_str(), several ? "_..." : "");
  // Without a limit Ctrl-C is the ordinary end.
  return sender.sent() == count * flags.send.sensors || (!flags.samples && !flags.seconds) ? kDone
                                                                                           : kInterrupted;
}

void add_options(CLI::App& command, SimulateFlags& flags) {
  command
      .add_option_function<std::string>(
          "--motion", [&flags](const std::string& motion) { flags.drive = motion == "drive"; },
          "still, or drive: a car with turns, stops and vibration [still]")
      ->type_name("still|drive")
      ->check(one_of({"still", "drive"}));
  command.add_option("--seed", flags.seed, "Same seed and options: same samples on any machine [1]")
      ->type_name("N")
      ->check(whole_in_range(0, 1000000000000000));
  command.add_option("--rate", flags.rate_hz, "Sample rate [100]")
      ->type_name("HZ")
      ->check(in_range(1.0, 1e5));
  command.add_option("--seconds", flags.seconds, "Length [a file: 60; DDS: until Ctrl-C]")
      ->type_name("S")
      ->check(in_range(1e-3, 1e9));
  command.add_option("--samples", flags.samples, "Length in samples")
      ->type_name("N")
      ->check(whole_in_range(1, 1000000000000000))
      ->excludes("--seconds");
  command.add_option("--sensor", flags.send.sensor, "Id of the sensor, 1 to 64 characters, no spaces [sim]")
      ->type_name("NAME")
      ->check(sensor_id());
  command
      .add_option("--sensors", flags.send.sensors, "So many sensors, NAME_1, NAME_2, ...; on DDS only [1]")
      ->type_name("N")
      ->check(whole_in_range(1, 65536));
  command
      .add_option("-o,--output", flags.output,
                  "To this file, with the truth, and not to DDS; gzip if it ends in .gz")
      ->type_name("OUT.csv[.gz]")
      ->excludes("--sensors");
  add_unit(command, flags.unit);
  command.add_option("--engine-tone", flags.engine_tone_dps, "Amplitude of an engine tone while driving [0]")
      ->type_name("DEG/S")
      ->check(in_range(0.0, 1e3));
  command.add_option("--engine-tone-hz", flags.engine_tone_hz, "Its frequency [27]")
      ->type_name("HZ")
      ->check(in_range(1e-3, 1e5));
}

}  // namespace

void add_simulate(CLI::App& parser, Action& chosen) {
  CLI::App* command =
      parser.add_subcommand("simulate", "Be a MEMS gyro: on DDS, or in a file with the truth beside it");
  const auto flags = std::make_shared<SimulateFlags>();
  flags->send.sensor = "sim";
  add_options(*command, *flags);
  flags->send.add_to(*command);
  flags->errors.add_to(*command);
  flags->bus.add_to(*command);
  command->footer(
      "White noise, bias instability, rate random walk and a converter of finite step and range, on a\n"
      "sensor that lies still or drives. The defaults are those of an ADIS16405-class gyro.\n\n"
      "Examples:\n"
      "  gyrod simulate --motion drive                      # on DDS, in real time, until Ctrl-C\n"
      "  gyrod simulate --motion drive --seconds 600 -o drive.csv.gz\n"
      "  gyrod simulate --rate 1000 --batch 32 --speed max --samples 1000000\n"
      "  gyrod simulate --sensors 1000 --batch 10 --sensor imu     # imu_1 to imu_1000");
  command->callback([&chosen, flags] {
    check(*flags);
    chosen = [flags](Interrupt& interrupt) {
      return flags->output.empty() ? simulate_to_bus(*flags, interrupt) : simulate_to_file(*flags, interrupt);
    };
  });
}

}  // namespace gyrod::app
