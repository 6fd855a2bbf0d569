#include "app/denoise_summary.hpp"

#include <cmath>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "app/analysis_json.hpp"
#include "app/version.hpp"

namespace gyrod::app {
namespace {

/// What became of the samples.
nlohmann::ordered_json samples_json(const stream::Counts& counts) {
  nlohmann::ordered_json rejected = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < stream::kRejectReasons; ++i) {
    rejected[std::string(stream::name_of(static_cast<stream::RejectReason>(i)))] = counts.rejected[i];
  }
  return {{"received", counts.received},
          {"denoised", counts.published - counts.passed_through},
          {"passed_through", counts.passed_through},
          {"warming_up", counts.warming_up},
          {"realtime", counts.realtime},
          {"rejected", rejected},
          {"missing", counts.missing},
          {"bridged", counts.bridged}};
}

}  // namespace

void RunningMoments::add(double value) noexcept {
  ++count_;
  const double change = value - mean_;
  mean_ += change / static_cast<double>(count_);
  squares_ += change * (value - mean_);
}

double RunningMoments::standard_deviation() const noexcept {
  return count_ < 2 ? 0.0 : std::sqrt(squares_ / static_cast<double>(count_));
}

void DenoiseSummary::add(const std::array<double, stream::kAxes>& measured_radps,
                         const std::array<double, stream::kAxes>& denoised_radps) {
  for (std::size_t i = 0; i < stream::kAxes; ++i) {
    axes_[i].measured.add(measured_radps[i]);
    axes_[i].denoised.add(denoised_radps[i]);
  }
}

void DenoiseSummary::add(const stream::NoiseReport& report) {
  sample_rate_hz_ = report.sample_rate_hz;
  if (report.noise_source != noise_source_) noise_source_since_ = report.last_sequence;
  noise_source_ = report.noise_source;
  windows_at_rest_ += report.at_rest.value_or(false) ? 1U : 0U;
  if (report.axis[0].window_samples > longest_[0].window_samples) longest_ = report.axis;
  for (std::size_t i = 0; i < stream::kAxes; ++i) {
    const core::WindowReport& window = report.axis[i];
    axes_[i].noise_floor.add(window.noise_floor);
    axes_[i].output_noise.add(window.output_noise);
    axes_[i].imfs.add(static_cast<double>(window.imf_count));
    axes_[i].j.add(static_cast<double>(window.j));
    axes_[i].k.add(static_cast<double>(window.k));
    if (!report.model_fit) continue;
    const stream::ModelFit& fit = (*report.model_fit)[i];
    axes_[i].misfit.add(fit.misfit ? 1.0 : 0.0);
    if (fit.wrong_noise) axes_[i].noise_ratio.add(fit.noise_ratio);
    axes_[i].was_hidden = axes_[i].was_hidden || fit.hidden_noise;
    axes_[i].is_hidden = fit.hidden_noise;
  }
}

std::string DenoiseSummary::noise_words() const {
  if (noise_source_ == stream::NoiseSource::kNone) return "noise by the record itself";
  const std::string source = "noise source " + std::string(stream::name_of(noise_source_));
  if (noise_source_ == stream::NoiseSource::kImf1) return source + " (judged by the signal itself)";
  return source + " from sample " + std::to_string(noise_source_since_) + " on";
}

/// Of axes that are flagged in a hundredth of the windows or more. Empty where none is.
std::string DenoiseSummary::misfit_words() const {
  constexpr double kFlagged = 0.01;
  std::string words;
  bool wrong_noise = false;
  bool is_hidden = false;
  bool was_hidden = false;
  for (std::size_t i = 0; i < stream::kAxes; ++i) {
    const Axis& axis = axes_[i];
    if (axis.misfit.mean() < kFlagged) continue;
    words += fmt::format("{}{} in {:.0f} % of the windows", words.empty() ? "" : ", ", stream::kAxisNames[i],
                         100.0 * axis.misfit.mean());
    is_hidden = is_hidden || axis.is_hidden;
    was_hidden = was_hidden || axis.was_hidden;
    if (!(axis.noise_ratio.mean() > 0.0)) continue;
    wrong_noise = true;
    words += fmt::format(" (noise of {:.2g} times the deviation that is believed)", axis.noise_ratio.mean());
  }
  if (words.empty()) return words;
  const std::string_view advice =
      is_hidden
          ? "nothing is known of the noise, and a low-pass of the sensor's own hides it: calibrate the sensor"
      : was_hidden ? "a low-pass of the sensor's own hid the noise until it was learned: calibrate the sensor"
      : wrong_noise ? "calibrate the sensor again"
                    : "do not trust the deviations that are published there";
  return fmt::format("the model does not fit: {}; {}", words, advice);
}

std::vector<std::string> DenoiseSummary::notes(const Source& source, const stream::Counts& counts) const {
  std::vector<std::string> notes;
  const auto note = [&notes](std::uint64_t count, const std::string& what) {
    if (count > 0) notes.push_back(std::to_string(count) + " " + what);
  };
  note(counts.passed_through, "samples kept as they were: too few in a row to denoise");
  for (std::size_t i = 0; i < stream::kRejectReasons; ++i) {
    note(counts.rejected[i], "samples refused and kept as they were: " +
                                 std::string(name_of(static_cast<stream::RejectReason>(i))));
  }
  note(counts.missing, "samples missing from the input");
  note(source.broken_rows, "broken rows left out");
  if (!source.rate_note.empty()) notes.push_back(source.rate_note);
  if (!source.band_note.empty()) notes.push_back(source.band_note);
  if (!source.calibration_note.empty())
    notes.push_back("the calibration of its noise " + source.calibration_note);
  if (const std::string misfit = misfit_words(); !misfit.empty()) notes.push_back(misfit);
  return notes;
}

nlohmann::ordered_json DenoiseSummary::axes_json(bool whole_record) const {
  nlohmann::ordered_json axes = nlohmann::ordered_json::object();
  constexpr std::array<const char*, stream::kAxes> kNames = {"x", "y", "z"};
  for (std::size_t i = 0; i < stream::kAxes; ++i) {
    const Axis& axis = axes_[i];
    axes[kNames[i]] = {{"mean_in_radps", axis.measured.mean()},
                       {"mean_out_radps", axis.denoised.mean()},
                       {"std_in_radps", axis.measured.standard_deviation()},
                       {"std_out_radps", axis.denoised.standard_deviation()},
                       {"noise_floor_radps", axis.noise_floor.mean()},
                       {"output_noise_radps", axis.output_noise.mean()},
                       {"mean_imfs", axis.imfs.mean()},
                       {"mean_j", axis.j.mean()},
                       {"mean_k", axis.k.mean()},
                       {"misfit_share", axis.misfit.mean()},
                       {"noise_ratio", axis.noise_ratio.mean() > 0.0 ? axis.noise_ratio.mean() : 1.0}};
    if (!whole_record) continue;
    axes[kNames[i]]["direct_model"] = model_json(longest_[i].direct_model);
    axes[kNames[i]]["imfs"] = imfs_json(longest_[i]);
  }
  return axes;
}

std::string DenoiseSummary::json(const Source& source, const stream::Counts& counts) const {
  const auto of_paper = [&source](const std::string& text) {
    return source.method == "paper" ? nlohmann::ordered_json(text) : nlohmann::ordered_json();
  };
  const nlohmann::ordered_json summary = {{"gyrod_version", version()},
                                          {"input", source.input},
                                          {"output", source.output},
                                          {"method", source.method},
                                          {"estimate", source.estimate},
                                          {"scheme", of_paper(source.scheme)},
                                          {"mode", source.whole_record ? "batch" : "windowed"},
                                          {"screening", of_paper(source.screening)},
                                          {"models", of_paper(source.models)},
                                          {"sample_rate_hz", sample_rate_hz_},
                                          {"samples", samples_json(counts)},
                                          {"broken_rows", source.broken_rows},
                                          {"gaps", counts.gaps},
                                          {"restarts", counts.restarts},
                                          {"windows", counts.windows},
                                          {"model_misfits", counts.misfits},
                                          {"noise",
                                           {{"source", stream::name_of(noise_source_)},
                                            {"since_sample", noise_source_since_},
                                            {"windows_at_rest", windows_at_rest_}}},
                                          {"axes", axes_json(source.whole_record)}};
  return summary.dump(2) + "\n";
}

}  // namespace gyrod::app
