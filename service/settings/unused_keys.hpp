/// Finds what a configuration asks for in vain.
#pragma once

#include <string>
#include <vector>

#include "settings/settings.hpp"

namespace gyrod::settings {

/// A daemon with these settings has no use for these keys, though they are set to something else than their default: they belong to
/// the other denoise.method, or name a signal band that holds all there is. One line each: the key, its value, and why. Not an error: the
/// offline commands of a method use them whatever the daemon's is.
[[nodiscard]] std::vector<std::string> unused_keys(const Settings& settings);

/// Why denoise.max_signal_hz leaves nothing out of samples at this rate; empty where it does, where it is 0, and where the rate is 0.
[[nodiscard]] std::string unused_band(double max_signal_hz, double sample_rate_hz);

}  // namespace gyrod::settings
