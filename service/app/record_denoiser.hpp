/// A recording in memory, denoised by any scheme or by the two-speed estimator.
#pragma once

#include <array>
#include <vector>

#include "app/offline_denoiser.hpp"
#include "core/denoise/scheme.hpp"
#include "files/record.hpp"
#include "settings/settings.hpp"
#include "stream/sample.hpp"

namespace gyrod::app {

/// The record's angular rates by a scheme of method paper, rad/s: output n belongs to sample n. An axis that the record does not have stays empty.
/// @param whole_record false: windowed, through the engine, as the daemon and `gyrod denoise` do. true: the whole record at once as
/// the paper does, with core::whole_record_options() on top of the settings; axes in threads of their own
/// @param settings scheme and screening in it are not used where whole_record is true; method and scheme never
/// A record shorter than core::Denoiser::kMinSamples comes back as it is.
[[nodiscard]] std::array<std::vector<double>, stream::kAxes> denoise_record(
    const files::Record& record, const settings::Settings& settings, core::Scheme scheme, bool whole_record);

/// The same by method joint, through the engine.
/// @pre the settings' lag is at most stream::kMaxModelLagSamples
[[nodiscard]] std::array<std::vector<double>, stream::kAxes> estimate_record(
    const files::Record& record, const settings::Settings& settings, EstimateKind estimate);

}  // namespace gyrod::app
