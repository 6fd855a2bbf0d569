#include "files/record.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "core/signal/interpolation.hpp"
#include "files/csv_row.hpp"
#include "files/file_error.hpp"
#include "files/number_text.hpp"
#include "stream/sample_gate.hpp"

namespace gyrod::files {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kSecondsPerNs = 1e-9;
constexpr std::uint64_t kLookUpEvery = 4096;  // rows: a few milliseconds

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

/// The columns of a file that are neither rate, time nor number, where they are wanted.
class OtherColumns {
 public:
  OtherColumns(const RecordingHeader& header, bool wanted) : separator_(header.separator) {
    if (!wanted) return;
    std::vector<std::string_view> names;
    static_cast<void>(split_row(header.text, header.separator, names));
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (i == header.sequence || i == header.time || std::ranges::count(header.gyro, i) > 0) continue;
      columns_.push_back({i, lower_case(bare(names[i]))});
    }
  }

  [[nodiscard]] std::size_t size() const noexcept { return columns_.size(); }

  void parse(std::string_view row, std::vector<double>& values) {
    if (columns_.empty()) return;
    static_cast<void>(split_row(row, separator_, cells_));
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      values[i] = parse_rate(bare(cells_[columns_[i].index])).value_or(kNaN);
    }
  }

  /// Leaves out columns without a number; of columns with one name the first stays.
  [[nodiscard]] std::map<std::string, std::vector<double>, std::less<>> named(
      std::vector<std::vector<double>> values) const {
    std::map<std::string, std::vector<double>, std::less<>> all;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (std::ranges::all_of(values[i], [](double value) { return std::isnan(value); })) continue;
      all.try_emplace(columns_[i].name, std::move(values[i]));
    }
    return all;
  }

 private:
  struct Column {
    std::size_t index;
    std::string name;
  };
  char separator_;
  std::vector<Column> columns_;
  std::vector<std::string_view> cells_;
};

/// Good samples without a long gap between them, bridged ones included.
struct Stretch {
  std::vector<std::int64_t> stamp_ns;
  std::array<std::vector<double>, stream::kAxes> rate_radps;
  std::vector<std::vector<double>> others;
  std::vector<std::uint8_t> made_up;  ///< by bridging; as far as the last one
  std::uint64_t bridged = 0;
  std::uint64_t missing = 0;

  explicit Stretch(std::size_t other_columns) : others(other_columns) {}

  [[nodiscard]] std::uint64_t measured() const noexcept { return stamp_ns.size() - bridged; }

  void append(const stream::Sample& sample, const std::vector<double>& other_values) {
    stamp_ns.push_back(sample.stamp_ns);
    for (std::size_t i = 0; i < stream::kAxes; ++i) rate_radps[i].push_back(sample.rate_radps[i]);
    for (std::size_t i = 0; i < others.size(); ++i) others[i].push_back(other_values[i]);
  }

  /// Fills `count` positions before `next`, on straight lines.
  void bridge_to(const stream::Sample& next, std::uint64_t count) {
    const std::vector<double> nothing(others.size(), kNaN);
    const auto last_stamp = static_cast<double>(stamp_ns.back());
    std::array<double, stream::kAxes> last{};
    for (std::size_t i = 0; i < stream::kAxes; ++i) last[i] = rate_radps[i].back();
    for (std::uint64_t step = 0; step < count; ++step) {
      const auto between = [&](double from, double to) { return core::bridge(from, to, step, count); };
      stream::Sample sample;
      sample.stamp_ns = std::llround(between(last_stamp, static_cast<double>(next.stamp_ns)));
      for (std::size_t i = 0; i < stream::kAxes; ++i)
        sample.rate_radps[i] = between(last[i], next.rate_radps[i]);
      made_up.resize(stamp_ns.size());
      made_up.push_back(1);
      append(sample, nothing);
    }
    bridged += count;
  }
};

class Loader {
 public:
  Loader(RecordingReader& reader, const RecordOptions& options)
      : reader_(reader),
        options_(options),
        gate_({.sample_rate_hz = reader.stamps_made_up() ? options.sample_rate_hz.value_or(0.0) : 0.0,
               .max_rate_radps = options.max_rate_radps,
               .max_bridged_samples = options.max_bridged_samples}),
        columns_(reader.header(), options.other_columns),
        values_(columns_.size()),
        now_(columns_.size()),
        best_(columns_.size()) {}

  void read_all() {
    RecordingRow row;
    while (reader_.next(row)) {
      take(row);
      const bool look = options_.progress && reader_.rows() % kLookUpEvery == 0;
      if (look && !options_.progress(reader_.progress(), reader_.rows())) throw Stopped{};
    }
    end_stretch();
  }

  [[nodiscard]] Record record(const std::string& name) {
    if (best_.stamp_ns.empty()) {
      throw FileError(name + ": none of its " + std::to_string(reader_.rows()) +
                      " samples is good: not finite, out of range, or stamps that do not go on");
    }
    Record record;
    record.name = name;
    record.header = reader_.header();
    record.first_stamp_s = kSecondsPerNs * static_cast<double>(best_.stamp_ns.front());
    record.counts = counts();
    record.time_s.reserve(best_.stamp_ns.size());
    for (const std::int64_t stamp : best_.stamp_ns) {
      record.time_s.push_back(kSecondsPerNs * static_cast<double>(stamp - best_.stamp_ns.front()));
    }
    for (std::size_t i = 0; i < stream::kAxes; ++i) {
      if (record.header.gyro[i]) record.gyro_radps[i] = std::move(best_.rate_radps[i]);
    }
    if (best_.bridged > 0) {
      best_.made_up.resize(record.size());
      record.bridged = std::move(best_.made_up);
    }
    record.others = columns_.named(std::move(best_.others));
    set_rate(record);
    return record;
  }

 private:
  void take(const RecordingRow& row) {
    const stream::Verdict verdict = gate_.judge(row.sample);
    if (verdict.kind == stream::Verdict::Kind::kRefuse) {
      ++refused_;
      return;
    }
    if (verdict.kind != stream::Verdict::Kind::kAccept) end_stretch();
    if (verdict.kind == stream::Verdict::Kind::kAccept && !now_.stamp_ns.empty()) {
      now_.missing += verdict.missing;
      now_.bridge_to(row.sample, verdict.bridge);
    }
    columns_.parse(row.text, values_);
    now_.append(row.sample, values_);
  }

  void end_stretch() {
    if (now_.stamp_ns.empty()) return;
    ++stretches_;
    measured_ += now_.measured();
    if (now_.stamp_ns.size() > best_.stamp_ns.size()) std::swap(now_, best_);
    now_ = Stretch(values_.size());
  }

  [[nodiscard]] Record::Counts counts() const noexcept {
    return {.rows = reader_.rows(),
            .broken = reader_.broken_rows(),
            .refused = refused_,
            .missing = best_.missing,
            .bridged = best_.bridged,
            .gaps = stretches_ - 1,
            .left_out = measured_ - best_.measured()};
  }

  void set_rate(Record& record) const {
    record.rate_given = options_.sample_rate_hz.has_value();
    if (record.rate_given) {
      record.sample_rate_hz = *options_.sample_rate_hz;
    } else if (record.size() > 1) {  // the gate lets only growing stamps through
      record.sample_rate_hz = static_cast<double>(record.size() - 1) / record.time_s.back();
    } else {
      throw FileError(record.name + ": only 1 of its " + std::to_string(record.counts.rows) +
                      " samples is good; expected at least 2, or a sample rate (--rate)");
    }
  }

  RecordingReader& reader_;
  const RecordOptions& options_;
  stream::SampleGate gate_;
  OtherColumns columns_;
  std::vector<double> values_;  ///< of the other columns, in the row in hand
  Stretch now_;
  Stretch best_;
  std::uint64_t refused_ = 0;
  std::uint64_t measured_ = 0;
  std::uint64_t stretches_ = 0;
};

}  // namespace

Record load_record(const std::string& path, const RecordOptions& options) {
  RecordOptions used = options;
  used.reader.nominal_rate_hz = options.sample_rate_hz.value_or(
      options.assumed_rate_hz.value_or(options.reader.nominal_rate_hz));  // of stamps that are made up
  RecordingReader reader(path, used.reader);
  const std::string name = path == "-" ? "standard input" : path;
  const bool assumed = reader.stamps_made_up() && !options.sample_rate_hz && options.assumed_rate_hz;
  if (assumed) used.sample_rate_hz = options.assumed_rate_hz;
  if (reader.stamps_made_up() && !used.sample_rate_hz) {
    throw FileError(name +
                    ": has no time column, and no sample rate is given; expected a column such as "
                    "timestamp_s or stamp_ns, or the rate in Hz (--rate)");
  }
  Loader loader(reader, used);
  loader.read_all();
  Record record = loader.record(name);
  record.rate_assumed = assumed;
  if (assumed) record.rate_given = false;
  return record;
}

}  // namespace gyrod::files
