/// A recording denoised as a whole, as the paper does.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/denoise_summary.hpp"
#include "app/row_handler.hpp"
#include "core/denoise/denoiser.hpp"
#include "files/recording_reader.hpp"
#include "settings/settings.hpp"
#include "stream/counters.hpp"
#include "stream/sample_gate.hpp"

namespace gyrod::app {

/// Keeps all rows in memory, and denoises each stretch without a long gap as one window. Samples are judged, and short gaps bridged, as
/// the daemon does. A stretch of fewer than core::Denoiser::kMinSamples samples stays as it is. One thread at a time; the axes are
/// computed in threads of their own.
class BatchDenoiser {
 public:
  /// @param options what is done with each stretch
  /// @param handler, summary have to outlive the denoiser
  /// @param wanted asked many times a second while finish() works; false ends that
  BatchDenoiser(const settings::Settings& settings, const core::DenoiserOptions& options, RowHandler& handler,
                DenoiseSummary& summary, std::function<bool()> wanted);

  /// Takes the next row; its text is moved out.
  void push(files::RecordingRow& row);
  /// The recording has ended: denoises it and hands on all rows, unless it is no longer wanted.
  void finish();

  [[nodiscard]] const stream::Counts& counts() const noexcept { return counts_; }

 private:
  using Rates = std::array<double, stream::kAxes>;
  struct Row {
    std::string text;
    std::size_t position = 0;  ///< of its sample in its stretch
    std::size_t stretch = 0;   ///< index, or kRefused
  };
  /// Good samples and bridged ones, rad/s; after denoise() with what became of them.
  struct Stretch {
    std::array<std::vector<double>, stream::kAxes> measured;
    std::array<std::vector<double>, stream::kAxes> denoised;
    /// Noise left in `denoised`, standard deviation, rad/s; 0 if unknown.
    Rates output_noise{};

    [[nodiscard]] std::size_t size() const noexcept { return measured[0].size(); }
  };
  static constexpr std::size_t kRefused = ~std::size_t{0};

  void append(const stream::Sample& sample, std::uint64_t bridge);
  /// @return false if it is no longer wanted
  [[nodiscard]] bool denoise(Stretch& stretch);
  void hand_on(Row& row);

  core::DenoiserOptions options_;
  RowHandler& handler_;
  DenoiseSummary& summary_;
  std::function<bool()> wanted_;
  stream::SampleGate gate_;
  std::vector<Row> rows_;
  std::vector<Stretch> stretches_;
  stream::Counts counts_;
};

/// Denoises x, y and z as one window each, in threads of their own. An empty axis stays empty; one of fewer than
/// core::Denoiser::kMinSamples samples comes back as it is, its report empty.
/// @param reports receives the figures
[[nodiscard]] std::array<std::vector<double>, stream::kAxes> denoise_whole(
    const std::array<std::vector<double>, stream::kAxes>& rate_radps, const core::DenoiserOptions& options,
    std::array<core::WindowReport, stream::kAxes>& reports);

}  // namespace gyrod::app
