/// Writes samples that come from the bus or the simulator as a new recording, which RecordingReader reads
/// back.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "files/output_file.hpp"
#include "files/rate_unit.hpp"
#include "stream/sample.hpp"

namespace gyrod::files {

/// What a row holds. U stands for the unit's spelling.
enum class RowKind {
  /// sensor, sequence, stamp_ns, gyro_{x,y,z}_U
  kMeasured,
  /// the same, then gyro_std_{x,y,z}_U, flags, noise_source, noise_floor_{x,y,z}_U, model_epoch
  kDenoised,
  /// that of kMeasured, then truth_{x,y,z}_U
  kSimulated,
};

/// Every number is the shortest decimal that reads back to the same double, so with the unit radps no bit is
/// lost. `flags` is the sum of SampleFlag bits; `noise_source` the number of the NoiseSource. One thread at a
/// time.
class SampleWriter {
 public:
  /// @throws FileError as OutputFile does
  SampleWriter(const std::string& path, RowKind kind, RateUnit unit);

  /// @pre made with the row kind of the name; all throw FileError as OutputFile::write() does
  void write_measured(std::string_view sensor, const stream::Sample& sample);
  void write_denoised(std::string_view sensor, const stream::DenoisedSample& sample);
  void write_simulated(std::string_view sensor, const stream::Sample& sample,
                       const std::array<double, stream::kAxes>& truth_radps);

  /// See OutputFile::close().
  void close() { file_.close(); }

  [[nodiscard]] std::uint64_t rows() const noexcept { return rows_; }

 private:
  void begin_row(std::string_view sensor, std::uint64_t sequence, std::int64_t stamp_ns,
                 const std::array<double, stream::kAxes>& rate_radps);
  void append_rates(const std::array<double, stream::kAxes>& rate_radps);
  void end_row();

  OutputFile file_;
  [[maybe_unused]] RowKind kind_;  ///< for the assertions
  RateUnit unit_;
  std::string line_;
  std::uint64_t rows_ = 0;
};

}  // namespace gyrod::files
