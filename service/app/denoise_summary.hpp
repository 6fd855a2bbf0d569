/// What `gyrod denoise --summary` tells.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "stream/counters.hpp"
#include "stream/report.hpp"

namespace gyrod::app {

/// Mean and standard deviation, one value at a time (Welford 1962).
class RunningMoments {
 public:
  void add(double value) noexcept;
  [[nodiscard]] double mean() const noexcept { return mean_; }
  /// Of the values themselves (divided by n); 0 for fewer than two.
  [[nodiscard]] double standard_deviation() const noexcept;

 private:
  std::uint64_t count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;
};

/// Gathers figures over a recording, sample by sample and window by window.
class DenoiseSummary {
 public:
  void add(const std::array<double, stream::kAxes>& measured_radps,
           const std::array<double, stream::kAxes>& denoised_radps);
  void add(const stream::NoiseReport& report);

  struct Source {
    std::string input;
    std::string output;
    std::string method;
    std::string estimate;
    std::string scheme;
    bool whole_record = false;
    std::string screening;
    std::string models;
    std::uint64_t broken_rows = 0;
    std::string rate_note;         ///< RecordingFlags::rate_note()
    std::string calibration_note;  ///< other_rate_note()
    std::string band_note;         ///< settings::unused_band()
  };

  /// Where the noise of the last window comes from, and since when, in words.
  [[nodiscard]] std::string noise_words() const;

  /// What a user should know of it besides: what was lost, refused, assumed or did not fit; a line each.
  [[nodiscard]] std::vector<std::string> notes(const Source& source, const stream::Counts& counts) const;
  /// Hz, as of the last window; 0 before the first.
  [[nodiscard]] double sample_rate_hz() const noexcept { return sample_rate_hz_; }

  /// JSON, with the unit in every key that has one. Of a whole record it holds each axis's IMFs and models (of the longest stretch).
  [[nodiscard]] std::string json(const Source& source, const stream::Counts& counts) const;

 private:
  struct Axis {
    RunningMoments measured;
    RunningMoments denoised;
    RunningMoments noise_floor;
    RunningMoments output_noise;
    RunningMoments imfs;
    RunningMoments j;
    RunningMoments k;
    RunningMoments misfit;  ///< 1 in windows of which the model does not explain the input, else 0
    RunningMoments
        noise_ratio;  ///< stream::ModelFit::noise_ratio, in windows in which the noise is not as believed
    bool was_hidden = false;  ///< stream::ModelFit::hidden_noise, in any window
    bool is_hidden = false;   ///< in the last one
  };
  [[nodiscard]] std::string misfit_words() const;
  [[nodiscard]] nlohmann::ordered_json axes_json(bool whole_record) const;

  std::array<Axis, stream::kAxes> axes_;
  std::array<core::WindowReport, stream::kAxes> longest_;  ///< reports of the first of the longest windows
  double sample_rate_hz_ = 0.0;
  stream::NoiseSource noise_source_ = stream::NoiseSource::kNone;  ///< of the last window
  std::uint64_t noise_source_since_ = 0;  ///< newest sample of the first window in a row that has it
  std::uint64_t windows_at_rest_ = 0;
};

}  // namespace gyrod::app
