#include "core/emd/emd.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/emd/sift_kernel.hpp"

namespace gyrod::core {
namespace {

/// Positions are counted in half samples in 32 bits.
constexpr std::size_t kMaxSamples = std::size_t{1} << 29U;

/// Largest exponent of the scale: it and its inverse are normal numbers, and denormal input becomes normal.
constexpr int kMaxExponent = 1000;

/// An IMF may exceed the input's peak by this factor. Ordinary ones stay below 2.
constexpr double kMaxGrowth = 0x1p20;

template <typename T>
void require_range(const char* name, T value, T low, T high) {
  if (!(value >= low && value <= high)) {
    throw std::invalid_argument("EMD: " + std::string(name) + " is " + std::to_string(value) + ", expected " +
                                std::to_string(low) + " to " + std::to_string(high));
  }
}

const EmdOptions& checked(const EmdOptions& options) {
  require_range("sifts", options.sifts, 1, 100);
  require_range("max_imfs", options.max_imfs, 1, 32);
  require_range("min_extrema", options.min_extrema, 3, 16);
  require_range("min_relative_amplitude", options.min_relative_amplitude, 0.0, 1.0);
  return options;
}

std::size_t checked(std::size_t max_samples) {
  require_range("max_samples", max_samples, std::size_t{1}, kMaxSamples);
  return max_samples;
}

}  // namespace

/// The remainder is kept in the input's unit. Sifting works on a copy scaled by a power of two to a peak near
/// one: it is exact, and neither squares nor quotients of huge or tiny inputs leave the range of double.
class Emd::Impl {
 public:
  Impl(std::size_t max_samples, const EmdOptions& options, EmdKernel kernel)
      : options_(checked(options)),
        kernel_(sift_kernel(kernel)),
        ws_(checked(max_samples), options.boundary),
        remainder_(max_samples) {}

  void start(std::span<const double> signal) noexcept {
    assert(!signal.empty() && signal.size() <= remainder_.size());
    ws_.size = signal.size();
    imfs_ = 0;
    std::ranges::copy(signal, remainder_.begin());
    const auto [low, high] = std::ranges::minmax(signal);
    const double peak = std::max(std::abs(low), std::abs(high));
    const int exponent = peak > 0.0 ? std::clamp(std::ilogb(peak), -kMaxExponent, kMaxExponent) : 0;
    scale_ = std::ldexp(1.0, -exponent);
    unscale_ = std::ldexp(1.0, exponent);
    amplitude_ = high * scale_ - low * scale_;
    limit_ = std::min(kMaxGrowth * (peak * scale_), std::numeric_limits<double>::max() * scale_);
  }

  [[nodiscard]] bool next_imf(std::span<double> imf) noexcept {
    assert(imf.size() == ws_.size);
    if (imfs_ == options_.max_imfs || !has_imf()) {
      return false;
    }
    for (int sift = 0; sift < options_.sifts && ws_.extrema.count() >= kFewestExtrema; ++sift) {
      kernel_.sift(ws_);
    }
    if (!is_within_limit()) {
      return false;
    }
    for (std::size_t i = 0; i < imf.size(); ++i) {
      imf[i] = ws_.signal[i] * unscale_;
      remainder_[i] -= imf[i];
    }
    ++imfs_;
    return true;
  }

  [[nodiscard]] std::span<const double> residue() const noexcept {
    return std::span(remainder_).first(ws_.size);
  }
  [[nodiscard]] const EmdOptions& options() const noexcept { return options_; }

 private:
  /// Fewest extrema that two envelopes can be drawn through.
  static constexpr std::size_t kFewestExtrema = 3;

  /// Loads the remainder into the workspace and looks whether it holds another IMF.
  bool has_imf() noexcept {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t i = 0; i < ws_.size; ++i) {
      const double value = remainder_[i] * scale_;
      ws_.signal[i] = value;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    if (high - low < options_.min_relative_amplitude * amplitude_) {
      return false;
    }
    kernel_.find_extrema(ws_);
    return ws_.extrema.count() >= static_cast<std::size_t>(options_.min_extrema);
  }

  /// Whether the proto-IMF and what it leaves are representable, and of a size that the input accounts for.
  /// Written so that NaN fails.
  [[nodiscard]] bool is_within_limit() const noexcept {
    bool within = true;
    for (std::size_t i = 0; i < ws_.size; ++i) {
      const double value = ws_.signal[i];
      const double rest = remainder_[i] * scale_ - value;
      within &= std::abs(value) <= limit_ && std::abs(rest) <= limit_;
    }
    return within;
  }

  EmdOptions options_;
  const SiftKernel& kernel_;
  SiftWorkspace ws_;
  Buffer<double> remainder_;
  int imfs_ = 0;
  double scale_ = 1.0;      ///< input to workspace
  double unscale_ = 1.0;    ///< workspace to input
  double amplitude_ = 0.0;  ///< peak to peak of the input, scaled
  double limit_ = 0.0;      ///< largest magnitude of an IMF, scaled
};

Emd::Emd(std::size_t max_samples, EmdOptions options, EmdKernel kernel)
    : impl_(std::make_unique<Impl>(max_samples, options, kernel)) {}
Emd::~Emd() = default;
Emd::Emd(Emd&&) noexcept = default;
Emd& Emd::operator=(Emd&&) noexcept = default;

void Emd::start(std::span<const double> signal) noexcept { impl_->start(signal); }
bool Emd::next_imf(std::span<double> imf) noexcept { return impl_->next_imf(imf); }
std::span<const double> Emd::residue() const noexcept { return impl_->residue(); }
const EmdOptions& Emd::options() const noexcept { return impl_->options(); }

}  // namespace gyrod::core
