/// A recording through the daemon's engine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/denoise_summary.hpp"
#include "app/noise_sources.hpp"
#include "app/row_handler.hpp"
#include "files/recording_reader.hpp"
#include "settings/settings.hpp"
#include "stream/engine.hpp"

namespace gyrod::app {

/// Which of a method's estimates of a sample is wanted.
enum class EstimateKind : std::uint8_t {
  kDenoised,  ///< with the look-ahead that is configured
  kRealtime,  ///< from this sample and those before it; model methods only
};

struct OfflineChoice {
  EstimateKind estimate = EstimateKind::kDenoised;
  /// Id of the sensor that it is a recording of: finds its calibration and what was learned of it.
  std::string sensor = "recording";
};

/// Runs the rows of one sensor through an engine without workers. Its clock stands still, so that overload
/// does not exist here and the result depends on the rows alone: it is what the daemon publishes for them,
/// bit for bit. Memory: the rows between the newest and the oldest one not released (lag + hop, and refused
/// rows among them). One thread at a time.
class OfflineDenoiser final : private stream::Sink {
 public:
  /// @param handler, summary have to outlive the denoiser
  /// @pre the settings' method makes the estimate
  /// @throws settings::NoiseFileError for a calibration, files::FileError for a noise state file that cannot be used
  OfflineDenoiser(const settings::Settings& settings, RowHandler& handler, DenoiseSummary& summary,
                  OfflineChoice choice = {});

  /// Takes the next row; its text is moved out. Hands on the rows that this makes ready; what the handler
  /// throws leaves here.
  void push(files::RecordingRow& row);
  /// The recording has ended: hands on the rest.
  void finish();

  [[nodiscard]] stream::Counts counts() const { return engine_.snapshot().totals; }
  /// Of the sensor's noise, for as long as the denoiser lives; nullptr where there is none.
  [[nodiscard]] const settings::NoiseCalibration* calibration() const {
    return noise_.calibration_of(choice_.sensor);
  }

 private:
  struct WaitingRow {
    std::string text;
    std::array<double, stream::kAxes> measured_radps{};
    bool accepted = true;
  };

  void on_samples(std::string_view sensor, std::span<const stream::DenoisedSample> samples) noexcept override;
  void on_realtime(std::string_view sensor,
                   std::span<const stream::DenoisedSample> samples) noexcept override;
  void on_report(std::string_view sensor, const stream::NoiseReport& report) noexcept override;
  void on_end(std::string_view sensor) noexcept override;
  void hand_on();
  void hand_on_refused();

  RowHandler& handler_;
  DenoiseSummary& summary_;
  OfflineChoice choice_;
  std::deque<WaitingRow> waiting_;
  std::vector<stream::DenoisedSample> released_;  ///< by the engine, not handed on yet
  NoiseSources noise_;
  stream::Engine engine_;
};

}  // namespace gyrod::app
