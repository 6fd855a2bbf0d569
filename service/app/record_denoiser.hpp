/// A recording in memory, denoised by any scheme.
#pragma once

#include <array>
#include <vector>

#include "core/denoise/scheme.hpp"
#include "files/record.hpp"
#include "settings/settings.hpp"
#include "stream/sample.hpp"

namespace gyrod::app {

/// The record's angular rates by a scheme, rad/s: output n belongs to sample n. An axis that the record does not have stays empty.
/// @param whole_record false: windowed, through the engine, as the daemon and `gyrod denoise` do. true: the whole record at once as
/// the paper does, with core::whole_record_options() on top of the settings; axes in threads of their own
/// @param settings scheme and screening in it are not used where whole_record is true, and the scheme never
/// A record shorter than core::Denoiser::kMinSamples comes back as it is.
[[nodiscard]] std::array<std::vector<double>, stream::kAxes> denoise_record(
    const files::Record& record, const settings::Settings& settings, core::Scheme scheme, bool whole_record);

}  // namespace gyrod::app
