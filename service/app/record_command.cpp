#include <chrono>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>

#include "app/command.hpp"
#include "app/errors.hpp"
#include "app/exit_code.hpp"
#include "app/flags.hpp"
#include "app/options.hpp"
#include "app/progress_bar.hpp"
#include "app/recording_log.hpp"
#include "bus/recorder.hpp"
#include "files/sample_writer.hpp"

namespace gyrod::app {
namespace {

struct RecordFlags {
  std::string topic;
  std::string output;
  std::string sensor;
  std::optional<double> seconds;
  std::optional<std::uint64_t> samples;
  bool until_end = false;
  double wait_s = 10.0;
  files::RateUnit unit = files::RateUnit::kRadps;
  BusFlags bus;
};

/// Writes rows until there are enough, and keeps account of them.
class RowsFromBus final : public bus::RecordHandler {
 public:
  RowsFromBus(const RecordFlags& flags, files::RowKind kind)
      : kind_(kind),
        only_(flags.sensor),
        limit_(flags.samples.value_or(std::numeric_limits<std::uint64_t>::max())),
        writer_(flags.output, kind, flags.unit) {}

  void on_samples(std::string_view sensor, std::span<const stream::DenoisedSample> samples) override {
    if (!only_.empty() && sensor != only_) return;
    for (const stream::DenoisedSample& sample : samples) {
      if (full()) return;
      write(sensor, sample);
      log_.add(sensor, sample.sequence);
    }
  }
  void on_end(std::string_view sensor) override { log_.end(sensor); }

  [[nodiscard]] bool full() const noexcept { return writer_.rows() >= limit_; }
  [[nodiscard]] std::uint64_t rows() const noexcept { return writer_.rows(); }
  [[nodiscard]] const RecordingLog& log() const noexcept { return log_; }
  void close() { writer_.close(); }

 private:
  void write(std::string_view sensor, const stream::DenoisedSample& sample) {
    if (kind_ == files::RowKind::kDenoised) {
      writer_.write_denoised(sensor, sample);
    } else {
      writer_.write_measured(sensor, {sample.sequence, sample.stamp_ns, sample.rate_radps});
    }
  }

  files::RowKind kind_;
  std::string only_;
  std::uint64_t limit_;
  files::SampleWriter writer_;
  RecordingLog log_;
};

/// Waits for a writer, so that whoever starts a sensor after this line misses nothing of it.
void await_writer(const RecordFlags& flags, const bus::Recorder& recorder, Interrupt& interrupt) {
  constexpr std::chrono::milliseconds kLook{20};
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::duration<double>(flags.wait_s);
  while (recorder.matched_writers() == 0 && !interrupt.wait_for(kLook)) {
    if (std::chrono::steady_clock::now() < give_up) continue;
    std::fprintf(stderr, "no writer of topic '%s' yet, still waiting\n", flags.topic.c_str());
    return;
  }
  std::fprintf(stderr, "listening to topic '%s'\n", flags.topic.c_str());
}

void take_rows(const RecordFlags& flags, bus::Recorder& recorder, RowsFromBus& rows, Interrupt& interrupt) {
  constexpr std::chrono::milliseconds kLook{100};
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  ProgressBar progress("recording");
  while (!rows.full() && !interrupt.requested()) {
    const bus::Recorder::Poll polled = recorder.poll(kLook, rows);
    if (polled == bus::Recorder::Poll::kEnded) return;
    if (flags.until_end && rows.log().all_ended()) return;
    if (flags.seconds && std::chrono::duration<double>(Clock::now() - begin).count() >= *flags.seconds)
      return;
    progress.show(std::nullopt, rows.rows());
  }
}

/// @return whether anything is missing
bool tell_losses(const RecordingLog& log) {
  bool missing = false;
  for (const auto& [sensor, account] : log.sensors()) {
    if (account.missing > 0) {
      std::fprintf(stderr,
                   "  sensor '%s': %llu samples missing in %llu gaps of the sequence, the first after %llu\n",
                   sensor.c_str(), static_cast<unsigned long long>(account.missing),
                   static_cast<unsigned long long>(account.gaps),
                   static_cast<unsigned long long>(account.first_gap_after));
      missing = true;
    }
    if (account.restarts > 0) {
      std::fprintf(stderr, "  sensor '%s': the sequence began anew %llu times\n", sensor.c_str(),
                   static_cast<unsigned long long>(account.restarts));
    }
  }
  return missing;
}

files::RowKind row_kind(const bus::Recorder& recorder) {
  return recorder.type_name().find("Denoised") != std::string_view::npos ? files::RowKind::kDenoised
                                                                         : files::RowKind::kMeasured;
}

int record(const RecordFlags& flags, Interrupt& interrupt) {
  const settings::Settings settings = flags.bus.load();
  const bus::Domain domain(settings.bus.domain, settings.bus.network, settings.bus.security.folder);
  const auto wait = std::chrono::milliseconds(static_cast<std::int64_t>(flags.wait_s * 1e3));
  interrupt.let_through();  // looking for the topic; nothing has been written yet
  bus::Recorder recorder(domain, bus_options(settings.bus), flags.topic, wait);
  interrupt.hold();
  RowsFromBus rows(flags, row_kind(recorder));
  await_writer(flags, recorder, interrupt);
  take_rows(flags, recorder, rows, interrupt);
  rows.close();
  std::fprintf(stderr, "%s: %llu samples of %zu sensors from topic '%s'\n", flags.output.c_str(),
               static_cast<unsigned long long>(rows.rows()), rows.log().sensors().size(),
               flags.topic.c_str());
  if (tell_losses(rows.log())) return kIncomplete;
  if (rows.rows() == 0 || (flags.samples && !rows.full()))
    throw Incomplete("fewer samples came than were asked for");
  return kDone;
}

void add_options(CLI::App& command, RecordFlags& flags) {
  command
      .add_option("--topic", flags.topic,
                  "Topic of raw or denoised samples, single or batch, e.g. gyro/denoised")
      ->type_name("TOPIC")
      ->required();
  command.add_option("-o,--output", flags.output, "Recording; gzip if it ends in .gz; - for standard output")
      ->type_name("OUT.csv[.gz]")
      ->required();
  command.add_option("--sensor", flags.sensor, "Only this sensor [all]")
      ->type_name("NAME")
      ->check(sensor_id());
  command.add_option("--seconds", flags.seconds, "End after this time")
      ->type_name("S")
      ->check(in_range(1e-3, 1e9));
  command.add_option("--samples", flags.samples, "End after so many samples, all sensors together")
      ->type_name("N")
      ->check(whole_in_range(1, 1000000000000000));
  command.add_flag("--until-end", flags.until_end, "End when every sensor that sent has ended");
  add_unit(command, flags.unit);
  command
      .add_option("--wait", flags.wait_s,
                  "Seconds to wait for a writer of a topic that is not in the configuration [10]")
      ->type_name("S")
      ->check(in_range(0.0, 86400.0));
}

}  // namespace

void add_record(CLI::App& parser, Action& chosen) {
  CLI::App* command = parser.add_subcommand("record", "Write a topic of samples to a file");
  const auto flags = std::make_shared<RecordFlags>();
  add_options(*command, *flags);
  flags->bus.add_to(*command);
  command->footer(
      "Numbers are written so that they read back to the same bits. Ends with --seconds, --samples or\n"
      "--until-end, when the last writer has gone, or on Ctrl-C; the file is complete either way.\n"
      "Samples missing by sequence number are told at the end, and make exit code 6, as does a\n"
      "recording with fewer samples than asked for.\n\n"
      "Examples:\n"
      "  gyrod record --topic gyro/denoised -o denoised.csv --seconds 60\n"
      "  gyrod record --topic gyro/raw --sensor imu1 -o raw.csv.gz --samples 100000");
  command->callback(
      [&chosen, flags] { chosen = [flags](Interrupt& interrupt) { return record(*flags, interrupt); }; });
}

}  // namespace gyrod::app
