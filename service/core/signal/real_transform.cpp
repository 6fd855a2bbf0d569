#include "core/signal/real_transform.hpp"

#include <cassert>
#include <vector>

#include <Eigen/Core>
#include <unsupported/Eigen/FFT>

#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

/// The library's own transform, whose plans can be made beforehand.
struct PortableFft : Eigen::internal::kissfft_impl<double> {
  /// Plans for real sequences of this length: two of complex ones of half of it, and the roots that put even and odd samples together.
  void make_plans(int length) {
    const int half = length / 2;
    for (const bool inverse : {false, true}) {
      std::vector<Complex>& roots = get_plan(half, inverse).m_twiddles;
      for (int k = 0; k < half; ++k) roots[static_cast<std::size_t>(k)] = root(inverse ? k : -k, half);
    }
    const Complex* made = real_twiddles(half / 2);
    std::vector<Complex>& roots = m_realTwiddles[half / 2];
    assert(made == roots.data());
    static_cast<void>(made);
    for (int k = 1; k <= half / 2; ++k)
      roots[static_cast<std::size_t>(k) - 1] = root(-2 * k - half, 2 * length);
  }

 private:
  /// e^(2 pi i k / n)
  static Complex root(int k, int n) noexcept {
    const SineCosine at = portable_sine_cosine(static_cast<double>(k) / static_cast<double>(n));
    return {at.cosine, at.sine};
  }
};

}  // namespace

class RealTransform::Impl {
 public:
  explicit Impl(std::size_t length) : length_(length) {
    assert(length >= 4 && length % 4 == 0);
    fft_.SetFlag(Eigen::FFT<double, PortableFft>::HalfSpectrum);
    fft_.impl().make_plans(static_cast<int>(length));
    // The library's own work space comes with first use: here, so that later calls allocate nothing.
    std::vector<double> x(length);
    std::vector<std::complex<double>> spectrum(length / 2 + 1);
    forward(x, spectrum);
    inverse(spectrum, x);
  }

  [[nodiscard]] std::size_t length() const noexcept { return length_; }

  void forward(std::span<const double> x, std::span<std::complex<double>> spectrum) noexcept {
    fft_.fwd(spectrum.data(), x.data(), static_cast<Eigen::Index>(length_));
  }
  void inverse(std::span<const std::complex<double>> spectrum, std::span<double> x) noexcept {
    fft_.inv(x.data(), spectrum.data(), static_cast<Eigen::Index>(length_));
  }

 private:
  std::size_t length_;
  Eigen::FFT<double, PortableFft> fft_;
};

RealTransform::RealTransform(std::size_t length) : impl_(std::make_unique<Impl>(length)) {}
RealTransform::~RealTransform() = default;
RealTransform::RealTransform(RealTransform&&) noexcept = default;
RealTransform& RealTransform::operator=(RealTransform&&) noexcept = default;

std::size_t RealTransform::length() const noexcept { return impl_->length(); }

void RealTransform::forward(std::span<const double> x, std::span<std::complex<double>> spectrum) noexcept {
  assert(x.size() == length() && spectrum.size() == bins());
  impl_->forward(x, spectrum);
}

void RealTransform::inverse(std::span<const std::complex<double>> spectrum, std::span<double> x) noexcept {
  assert(x.size() == length() && spectrum.size() == bins());
  impl_->inverse(spectrum, x);
}

}  // namespace gyrod::core
