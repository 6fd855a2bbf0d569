#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

#include "app/command.hpp"
#include "app/exit_code.hpp"
#include "app/flags.hpp"
#include "app/progress_bar.hpp"
#include "app/sample_sender.hpp"
#include "files/recording_reader.hpp"

namespace gyrod::app {
namespace {

struct ReplayFlags {
  std::string input;
  BusFlags bus;
  RecordingFlags recording;
  SendFlags send;
};

/// @return false if it was interrupted
bool send_rows(files::RecordingReader& reader, SampleSender& sender) {
  ProgressBar progress("replaying");
  files::RecordingRow row;
  while (reader.next(row)) {
    if (!sender.send(row.sample)) return false;
    progress.show(reader.progress(), sender.sent());
  }
  return true;
}

int replay(const ReplayFlags& flags, Interrupt& interrupt) {
  const settings::Settings settings = flags.bus.load();
  if (flags.input == "-") interrupt.let_through();  // reading from a pipe can wait for ever
  files::RecordingReader reader(flags.input, flags.recording.options);
  SampleSender sender(settings.bus, flags.send, interrupt);
  const auto begin = std::chrono::steady_clock::now();
  const bool all = send_rows(reader, sender);
  sender.finish();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::fprintf(stderr, "%s: %llu samples of sensor '%s' sent in %.1f s\n", flags.input.c_str(),
               static_cast<unsigned long long>(sender.sent()), flags.send.sensor.c_str(), seconds);
  const std::string note = flags.recording.rate_note(reader);
  if (!note.empty()) std::fprintf(stderr, "  %s\n", note.c_str());
  if (reader.broken_rows() > 0) {
    std::fprintf(stderr, "  %llu broken rows left out\n",
                 static_cast<unsigned long long>(reader.broken_rows()));
  }
  return all ? kDone : kInterrupted;
}

}  // namespace

void add_replay(CLI::App& parser, Action& chosen) {
  CLI::App* command =
      parser.add_subcommand("replay", "Send a recording to DDS, as its sensor would have done");
  const auto flags = std::make_shared<ReplayFlags>();
  command->add_option("input", flags->input, "Recording: CSV, plain or gzip; - for standard input")
      ->type_name("IN.csv[.gz]")
      ->required();
  command
      ->add_option("--sensor", flags->send.sensor,
                   "Id of the sensor on the bus, 1 to 64 characters, no spaces")
      ->type_name("NAME")
      ->check(sensor_id())
      ->required();
  flags->send.add_to(*command);
  flags->recording.add_to(*command);
  flags->bus.add_to(*command);
  command->footer(
      "Waits for a reader, sends every row with its own number and stamp, slows down where readers ask\n"
      "for it, and tells at the end that the sensor has ended. Columns are those of gyrod denoise.\n"
      "Pauses of more than 10 s in the recording are cut to 10 s.\n\n"
      "Example: the same bits live and offline\n"
      "  gyrod run &\n"
      "  gyrod record --topic gyro/denoised -o live.csv --until-end &\n"
      "  gyrod replay drive.csv --sensor imu1 --speed max\n"
      "  gyrod denoise drive.csv -o offline.csv");
  command->callback(
      [&chosen, flags] { chosen = [flags](Interrupt& interrupt) { return replay(*flags, interrupt); }; });
}

}  // namespace gyrod::app
