#include "app/report_axes.hpp"

#include <atomic>
#include <chrono>
#include <future>
#include <string>
#include <utility>

#include "app/abandonable.hpp"
#include "core/denoise/record_analysis.hpp"
#include "files/rate_unit.hpp"
#include "report/axis_report.hpp"

namespace gyrod::app {
namespace {

/// Steps of one axis: analysis, sections, series. Shares of the time, measured on 1 h at 100 Hz.
constexpr std::array<double, 3> kShares = {0.75, 0.15, 0.10};

/// The true rate of an axis in rad/s, NaN where it is not known; empty where the file has no such column.
std::vector<double> truth_of(const files::Record& record, std::size_t axis) {
  for (const std::string unit : {"radps", "mradps", "dps", "mdps", "dph"}) {
    const auto found = record.others.find("truth_" + std::string(stream::kAxisNames[axis]) + "_" + unit);
    if (found == record.others.end()) continue;
    std::vector<double> truth = found->second;
    for (double& value : truth) value = files::to_radps(value, *files::rate_unit_of(unit));
    return truth;
  }
  return {};
}

/// One axis while it is worked on, by whoever still wants it.
struct AxisInHand {
  std::string name;
  double sample_rate_hz = 0.0;
  bool still = false;
  std::vector<double> truth;
  core::RecordAnalysis analysis;

  [[nodiscard]] report::AxisInput input() const { return {name, sample_rate_hz, still, truth, analysis}; }
};

/// Work that several threads take from, axis by axis.
class AxisWork {
 public:
  AxisWork(const std::shared_ptr<const files::Record>& record, bool still, const ReportWriter& writer)
      : record_(record), still_(still), writer_(writer) {}

  void work() {
    for (std::size_t axis = next_++; axis < stream::kAxes && !stopped_; axis = next_++) {
      if (record_->gyro_radps[axis].empty()) {
        add(1.0);
      } else {
        done_[axis] = report_on(axis);
      }
    }
  }

  void stop() noexcept { stopped_ = true; }
  [[nodiscard]] double fraction() const noexcept { return fraction_ / static_cast<double>(stream::kAxes); }
  [[nodiscard]] ReportedAxes take() { return std::move(done_); }

 private:
  [[nodiscard]] std::optional<ReportedAxis> report_on(std::size_t axis) {
    const auto wanted = [this] { return !stopped_; };
    auto analysis = while_wanted(
        wanted, [record = record_, axis] { return core::analyse_record(record->gyro_radps[axis]); });
    if (!analysis) return std::nullopt;
    add(kShares[0]);
    const auto in_hand =
        std::make_shared<AxisInHand>(AxisInHand{stream::kAxisNames[axis], record_->sample_rate_hz, still_,
                                                truth_of(*record_, axis), std::move(*analysis)});
    auto sections = while_wanted(wanted, [in_hand] { return report::axis_report(in_hand->input()); });
    if (!sections) return std::nullopt;
    add(kShares[1]);
    if (!writer_.write_series(in_hand->input(), wanted)) return std::nullopt;
    add(kShares[2]);
    return ReportedAxis{std::move(*sections), std::move(in_hand->analysis.outputs)};
  }
  void add(double share) noexcept { fraction_.fetch_add(share); }

  std::shared_ptr<const files::Record> record_;
  bool still_;
  const ReportWriter& writer_;
  ReportedAxes done_;
  std::atomic<std::size_t> next_{0};
  std::atomic<double> fraction_{0.0};
  std::atomic<bool> stopped_{false};
};

}  // namespace

std::optional<ReportedAxes> report_axes(const std::shared_ptr<const files::Record>& record, bool still,
                                        const ReportWriter& writer, const std::function<bool(double)>& look) {
  constexpr std::chrono::milliseconds kLookEvery{100};
  AxisWork axes(record, still, writer);
  std::array<std::future<void>, 2> threads;
  for (auto& thread : threads) thread = std::async(std::launch::async, [&axes] { axes.work(); });
  bool wanted = true;
  for (auto& thread : threads) {
    while (thread.wait_for(kLookEvery) != std::future_status::ready) {
      if (look(axes.fraction())) continue;
      wanted = false;
      axes.stop();
    }
  }
  for (auto& thread : threads) thread.get();
  if (!wanted) return std::nullopt;
  return axes.take();
}

}  // namespace gyrod::app
