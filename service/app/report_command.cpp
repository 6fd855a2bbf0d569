#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "app/command.hpp"
#include "app/exit_code.hpp"
#include "app/flags.hpp"
#include "app/progress_bar.hpp"
#include "app/report_axes.hpp"
#include "app/report_navigation.hpp"
#include "app/report_writer.hpp"
#include "app/version.hpp"
#include "files/record.hpp"
#include "report/stillness.hpp"
#include "report/summary.hpp"
#include "report/trace.hpp"

namespace gyrod::app {
namespace {

using report::Json;

struct ReportFlags {
  std::string input;
  std::string folder;
  std::optional<double> rate_hz;
  bool full = false;
  files::RecordOptions record;
};

/// @return null if it was interrupted
std::shared_ptr<const files::Record> load(ReportFlags flags, Interrupt& interrupt) {
  // Reading from a terminal or a pipe can wait for ever.
  if (flags.input == "-") interrupt.let_through();
  ProgressBar bar("reading");
  flags.record.sample_rate_hz = flags.rate_hz;
  flags.record.other_columns = true;
  flags.record.progress = [&bar, &interrupt](std::optional<double> fraction, std::uint64_t rows) {
    bar.show(fraction, rows);
    return !interrupt.requested();
  };
  try {
    auto record = std::make_shared<const files::Record>(files::load_record(flags.input, flags.record));
    if (flags.input == "-") interrupt.hold();
    return record;
  } catch (const files::Stopped&) {
    return nullptr;
  }
}

bool is_still(const files::Record& record) {
  return std::ranges::all_of(record.gyro_radps, [&record](const std::vector<double>& axis) {
    return report::stillness(axis, record.sample_rate_hz).still();
  });
}

Json record_json(const files::Record& record, bool still) {
  const files::Record::Counts& counts = record.counts;
  return Json{{"name", record.name},
              {"samples", record.size()},
              {"duration_s", static_cast<double>(record.size()) / record.sample_rate_hz},
              {"sample_rate_hz", record.sample_rate_hz},
              {"rate_given", record.rate_given},
              {"still", still},
              {"rows", counts.rows},
              {"broken_rows", counts.broken},
              {"refused", counts.refused},
              {"missing", counts.missing},
              {"bridged", counts.bridged},
              {"gaps", counts.gaps},
              {"left_out", counts.left_out}};
}

std::string trace_words() {
  return "Long series are drawn with up to " + std::to_string(report::kTracePoints) + " points (" +
         std::to_string(report::kRowPoints) +
         " where they stand in rows): the least and the greatest value of each equal stretch, so that no "
         "spike is lost. The files "
         "schemes_*.csv hold every sample.";
}

Json whole_report(const files::Record& record, bool still, ReportedAxes& axes) {
  Json sections = Json::object();
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    if (axes[axis]) sections[stream::kAxisNames[axis]] = std::move(axes[axis]->sections);
  }
  Json json{
      {"format", 1}, {"made_by", std::string("gyrod ") + version()}, {"record", record_json(record, still)}};
  json["summary_rows"] = report::summary_rows(sections, still);
  json["summary"] = report::summary_sentences(sections, still);
  json["cautions"] = report::cautions(json["record"]);
  json["traces"] = trace_words();
  json["axes"] = std::move(sections);
  return json;
}

int make_report(const ReportFlags& flags, Interrupt& interrupt) {
  const ReportWriter writer(flags.folder, flags.full);
  const auto record = load(flags, interrupt);
  std::optional<ReportedAxes> axes;
  const bool still = record && is_still(*record);
  if (record) {
    ProgressBar bar("analysing");
    axes = report_axes(record, still, writer, [&](double fraction) {
      bar.show(fraction, static_cast<std::uint64_t>(fraction * static_cast<double>(record->size())));
      return !interrupt.requested();
    });
  }
  if (!axes) {
    std::fprintf(stderr, "gyrod: interrupted, the report is not complete\n");
    return kInterrupted;
  }
  const ReportNavigation navigation = report_navigation(*record, *axes, still);
  Json json = whole_report(*record, still, *axes);
  json["navigation"] = navigation.section;
  writer.finish(json, navigation.result);
  for (const Json& caution : json["cautions"]) {
    std::fprintf(stderr, "%s\n", caution.get<std::string>().c_str());
  }
  std::fprintf(stderr, "%s/index.html: report on %zu samples\n", flags.folder.c_str(), record->size());
  return kDone;
}

}  // namespace

void add_report(CLI::App& parser, Action& chosen) {
  CLI::App* command =
      parser.add_subcommand("report", "Every figure and table of the paper, from a recording");
  const auto flags = std::make_shared<ReportFlags>();
  command->add_option("input", flags->input, "Recording: CSV, plain or gzip; - for standard input")
      ->type_name("IN.csv[.gz]")
      ->required();
  command->add_option("-o,--output", flags->folder, "Folder for the report; made if it is not there")
      ->type_name("DIR")
      ->required();
  command
      ->add_option("--rate", flags->rate_hz,
                   "Sample rate in Hz; it holds, whatever the stamps say [from the time column]")
      ->type_name("HZ")
      ->check(in_range(1e-3, 1e6));
  command->add_flag(
      "--full", flags->full,
      "Write IMFs and autocorrelations of every sample, not as drawn: some 300 MB an hour and axis");
  command->add_flag("--allow-missing-axes", flags->record.reader.allow_missing_axes,
                    "Take a file without one or two of the axes");
  command->add_flag("--skip-broken-rows", flags->record.reader.skip_broken_rows,
                    "Leave out and count rows that cannot be read, instead of ending with an error");
  command->footer(
      "DIR/index.html is one page that opens from disk and loads nothing: decomposition, screening, models,\n"
      "all schemes of the paper side by side, Allan deviation, and navigation where the recording has an\n"
      "accelerometer and a reference. report.json and CSV files beside it hold the numbers.\n"
      "Columns as for gyrod denoise; truth_x_UNIT, ... are the true rates, if known (gyrod simulate).\n\n"
      "Examples:\n"
      "  gyrod report still.csv.gz -o report\n"
      "  gyrod report samples_only.csv --rate 100 -o report --full");
  command->callback([&chosen, flags] {
    chosen = [flags](Interrupt& interrupt) { return make_report(*flags, interrupt); };
  });
}

}  // namespace gyrod::app
