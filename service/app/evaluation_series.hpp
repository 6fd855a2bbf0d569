/// The series that the rows of an evaluation are made of.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gyrod::app {

/// Puts straight lines in place of what is lost between two values that are known, where that is no longer than this.
void bridge_gaps(std::vector<double>& values, std::size_t most);

/// NaN between two numbers becomes a straight line; NaN at an end the nearest number. @pre there is a number
[[nodiscard]] std::vector<double> with_gaps_bridged(std::vector<double> values);

/// The truth, its gaps bridged, and noise. @pre equally long, the noise finite
[[nodiscard]] std::vector<double> composite(std::vector<double> truth, const std::vector<double>& noise);

[[nodiscard]] std::vector<double> without_mean(std::vector<double> values);

[[nodiscard]] std::vector<double> scaled(std::vector<double> values, double scale);

/// A stretch of a recording, from its beginning again where it ends.
[[nodiscard]] std::vector<double> stretch(std::span<const double> all, std::size_t start,
                                          std::size_t samples);

/// What stretch() does not take: before it and behind it.
[[nodiscard]] std::vector<std::span<const double>> spare(std::span<const double> all, std::size_t start,
                                                         std::size_t samples);

}  // namespace gyrod::app
