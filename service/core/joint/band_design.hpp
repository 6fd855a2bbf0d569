/// What a member has to know for answers within a signal band.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/joint/member_model.hpp"
#include "core/joint/signal_band.hpp"

namespace gyrod::core {

/// With f the low-pass that stands for the band (SignalBand) and s the signal, d[t] = sum_j f[j] s[t+j] is asked for, given z up to z[t + kMaxLag]. Of
/// samples beyond that the state tells
///   ahead x[t + kMaxLag],   ahead = sum_(n >= 1) f[kMaxLag + n] C' A^n.
/// The variance of the error is what remains if all of z is known, and what later innovations would tell,
///   integral f(w)^2 B(w) N(w) / (B(w) + N(w)) + S sum_(m > kMaxLag) gamma_m^2,   gamma_m = sum_j f[j] psi_(m-j),
/// with B and N the spectra of signal and of all else, psi_k = g_k of MemberModel for k >= 0 and C' A^-k K before.
/// and with less look-ahead S gamma_m^2 more for every sample. What answers leave unused of this is little: samples older than kMaxLag are taken with that
/// look-ahead (BandAnswers).
/// Sizes its workspace once; after that nothing allocates. Not thread-safe. Internal to core/joint.
/// Source: Anderson, Moore 1979, chapters 7 (smoothing by innovations) and 10 (the spectrum of a smoother's error).
class BandDesign {
 public:
  BandDesign();

  /// @param cycles as SignalBand::set()
  void set(double cycles) noexcept;
  [[nodiscard]] const SignalBand& band() const noexcept { return band_; }

  /// Fills `ahead` and `band_variance`; nothing where there is no limit.
  /// @param signal_covariance X C of the member's states
  /// @return false where these are not finite
  [[nodiscard]] bool describe(std::span<const double> signal_covariance, MemberModel& member) noexcept;

 private:
  /// Look-ahead beyond kMaxLag after which hardly anything is learned any more, samples, at least.
  static constexpr std::size_t kFar = SignalBand::kMaxReach;
  static constexpr std::size_t kFrequencies = 256;

  void look_ahead(MemberModel& member) const noexcept;
  void respond(std::span<const double> signal_covariance, const MemberModel& member) noexcept;
  [[nodiscard]] double left_by_all(const MemberModel& member) const noexcept;
  [[nodiscard]] double told_later(std::size_t m) const noexcept;
  [[nodiscard]] double left_by_later() const noexcept;

  /// Where f(w)^2 is not 0.
  struct Frequency {
    double cosine = 1.0;
    double sine = 0.0;
    double weight = 0.0;  ///< f(w)^2 dw / pi, what the integral over both signs takes
  };

  SignalBand band_;
  std::array<Frequency, kFrequencies> frequencies_{};
  std::vector<double> response_;  ///< psi_k from k = -reach on
};

}  // namespace gyrod::core
