#include "core/allan/point_correlation.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace gyrod::core {
namespace {

using std::numbers::pi;

double spectrum(const std::array<double, kNoiseTerms>& squares, double frequency_hz, double interval_s) {
  const auto square = [&squares](NoiseTerm term) { return squares[static_cast<std::size_t>(term)]; };
  const double omega = 2.0 * pi * frequency_hz;
  const double sine = std::sin(0.5 * omega * interval_s);
  return square(NoiseTerm::kAngleRandomWalk) + square(NoiseTerm::kBiasInstability) / omega +
         square(NoiseTerm::kRateRandomWalk) / (omega * omega) +
         square(NoiseTerm::kRateRamp) / (omega * omega * omega) +
         square(NoiseTerm::kQuantization) * 4.0 * sine * sine / interval_s;
}

double transfer(double frequency_hz, double cluster_samples, double interval_s) {
  const double sine = std::sin(pi * frequency_hz * cluster_samples * interval_s);
  const double average = sine * sine / (cluster_samples * std::sin(pi * frequency_hz * interval_s));
  return 2.0 * average * average;
}

}  // namespace

Eigen::MatrixXd point_correlation(std::span<const AllanPoint> points,
                                  const std::array<double, kNoiseTerms>& squares) {
  assert(!points.empty());
  constexpr double kStepsPerOctave = 64.0;
  const double interval_s = points[0].tau_s / static_cast<double>(points[0].cluster_samples);
  const double record_s = interval_s * static_cast<double>(points[0].terms + 2 * points[0].cluster_samples);
  const double octaves = std::log2(record_s / interval_s);
  const auto steps = static_cast<Eigen::Index>(std::ceil(octaves * kStepsPerOctave)) + 1;
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd shares(count, steps);
  for (Eigen::Index k = 0; k < steps; ++k) {
    const double frequency = 0.5 / record_s * std::exp2(static_cast<double>(k) / kStepsPerOctave);
    const double weight = spectrum(squares, frequency, interval_s) * std::sqrt(frequency);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto m = static_cast<double>(points[static_cast<std::size_t>(i)].cluster_samples);
      shares(i, k) = weight * transfer(frequency, m, interval_s);
    }
  }
  shares.rowwise().normalize();
  return shares * shares.transpose();
}

}  // namespace gyrod::core
