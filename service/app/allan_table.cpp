#include "app/allan_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "app/allan_units.hpp"

namespace gyrod::app {
namespace {

using core::Coefficient;

constexpr const char* kNotObservable = "not observable";

std::string with_error(const Coefficient& coefficient, double factor) {
  if (!coefficient.observable) return kNotObservable;
  return fmt::format("{:.3e} +- {:.0e}", factor * coefficient.value, factor * coefficient.standard_error);
}

std::string number(const Coefficient& coefficient, double factor) {
  return coefficient.observable ? fmt::format("{:.3e}", factor * coefficient.value) : "-";
}

std::string record_lines(const AllanAnalysis& analysis) {
  const double seconds = static_cast<double>(analysis.samples) / analysis.sample_rate_hz;
  std::string text =
      fmt::format("{}: {} samples, {:.6g} Hz {}, {:.6g} s\n", analysis.input, analysis.samples,
                  analysis.sample_rate_hz, analysis.rate_given ? "(--rate)" : "(by its stamps)", seconds);
  const auto note = [&](std::uint64_t number, const char* what) {
    if (number > 0) text += fmt::format("  {} {}\n", number, what);
  };
  note(analysis.rows.broken, "broken rows left out");
  note(analysis.rows.refused, "samples refused: not finite, out of range, duplicate or out of order");
  note(analysis.rows.bridged, "missing or refused samples bridged by straight lines");
  note(analysis.rows.gaps, "gaps too long to bridge: the longest stretch without one is analysed");
  note(analysis.rows.left_out, "good samples left out with the other stretches");
  for (const std::string& line : analysis.notes) text += "  " + line + "\n";
  return text;
}

std::string per_sample_line(const AllanChannel& channel, double sample_rate_hz) {
  const bool gyro = channel.sensor == SensorKind::kGyro;
  const char* unit = gyro ? "rad/s" : "m/s^2";
  const DeviationUnit degrees = deviation_unit(channel.sensor, files::RateUnit::kDps);
  const auto figure = [&](const Coefficient& coefficient, double value) {
    if (!coefficient.observable) return std::string(kNotObservable);
    std::string text = fmt::format("{:.3e} {}", value, unit);
    if (gyro) text += fmt::format(" = {:.3e} {}", value / degrees.si, degrees.title);
    return text;
  };
  const Coefficient& white = channel.fit[core::NoiseTerm::kAngleRandomWalk];
  const Coefficient& walk = channel.fit[core::NoiseTerm::kRateRandomWalk];
  return fmt::format("  per sample at {:.6g} Hz (discrete time), standard deviations:\n", sample_rate_hz) +
         "    white noise N sqrt(rate)        " +
         figure(white, core::white_noise_per_sample(white.value, sample_rate_hz)) +
         "\n    random walk step K / sqrt(rate) " +
         figure(walk, core::random_walk_step_per_sample(walk.value, sample_rate_hz)) + "\n";
}

std::string coefficient_lines(const AllanChannel& channel, double sample_rate_hz) {
  std::string text =
      fmt::format("\n{}\n  {:<23} {:<20} {:<16} {:<20} {:<13} {:>10} {:>10}\n", channel.name(), "coefficient",
                  "least squares", "SI unit", "least squares", "unit", "slopes", "polynomial");
  for (const CoefficientUnit& unit : coefficient_units(channel.sensor)) {
    const double factor = in_sheet_unit(channel.sensor, unit.term, 1.0);
    text += fmt::format(
        "  {} {:<21} {:<20} {:<16} {:<20} {:<13} {:>10} {:>10}\n", unit.letter, unit.title,
        with_error(channel.fit[unit.term], 1.0), unit.si, with_error(channel.fit[unit.term], factor),
        unit.sheet, number(channel.slopes[unit.term], factor), number(channel.polynomial[unit.term], factor));
  }
  return text + per_sample_line(channel, sample_rate_hz);
}

/// Places of the points nearest to 1, 10, 100, ... clusters' worth of the decades of seconds, and of the last.
std::vector<std::size_t> decades_of(const std::vector<core::AllanPoint>& points) {
  std::vector<std::size_t> places;
  constexpr double kNear = 0.06;  // decades: half the distance of two points
  for (int decade = -6; decade <= 9; ++decade) {
    const auto distance = [decade](const core::AllanPoint& point) {
      return std::abs(std::log10(point.tau_s) - decade);
    };
    const auto nearest = std::ranges::min_element(points, {}, distance);
    if (nearest != points.end() && distance(*nearest) < kNear) {
      places.push_back(static_cast<std::size_t>(nearest - points.begin()));
    }
  }
  if (!points.empty() && (places.empty() || places.back() + 1 != points.size()))
    places.push_back(points.size() - 1);
  return places;
}

std::string deviation_lines(const AllanAnalysis& analysis, SensorKind sensor, files::RateUnit rate_unit) {
  std::vector<const AllanChannel*> shown;
  for (const AllanChannel& channel : analysis.channels) {
    if (channel.sensor == sensor) shown.push_back(&channel);
  }
  if (shown.empty()) return "";
  const DeviationUnit unit = deviation_unit(sensor, rate_unit);
  std::string text = fmt::format("\nAllan deviation in {}, with {:.4g} % confidence bounds\n  {:>10}",
                                 unit.title, 100.0 * analysis.options.confidence, "tau s");
  for (const AllanChannel* channel : shown) text += fmt::format("  {:<33}", channel->name());
  text = text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
  for (const std::size_t place : decades_of(shown.front()->points)) {
    text += fmt::format("  {:10.4g}", shown.front()->points[place].tau_s);
    for (const AllanChannel* channel : shown) {
      const core::AllanPoint& point = channel->points[place];
      text += fmt::format("  {:.3e} [{:.3e}, {:.3e}]", point.deviation / unit.si, point.lower / unit.si,
                          point.upper / unit.si);
    }
    text += "\n";
  }
  return text;
}

bool is_anything_observable(const AllanAnalysis& analysis) {
  return std::ranges::any_of(analysis.channels, [](const AllanChannel& channel) {
    return std::ranges::any_of(channel.fit.terms, &Coefficient::observable);
  });
}

std::string explanation(const AllanAnalysis& analysis) {
  std::string text =
      "\nLeast squares, +- its standard error, is the fit to use. Not observable: the record does not show\n"
      "the term; a longer one may. Slopes and polynomial, in the unit to their left, are for comparison\n"
      "(-: not there by this method); the polynomial is the usual fit of papers, and its negative values\n"
      "mean nothing. Definitions: docs/allan.md.\n";
  if (!is_anything_observable(analysis)) {
    text += "The record is too short, or does not change at all: there is no coefficient to show.\n";
  }
  return text;
}

}  // namespace

std::string allan_table(const AllanAnalysis& analysis, files::RateUnit unit) {
  std::string text = record_lines(analysis);
  for (const AllanChannel& channel : analysis.channels) {
    text += coefficient_lines(channel, analysis.sample_rate_hz);
  }
  text += deviation_lines(analysis, SensorKind::kGyro, unit);
  text += deviation_lines(analysis, SensorKind::kAccelerometer, unit);
  return text + explanation(analysis);
}

}  // namespace gyrod::app
