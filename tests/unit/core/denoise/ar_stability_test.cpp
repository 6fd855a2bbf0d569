// Every model that is handed out is stable, whatever the series.
#include <array>
#include <complex>
#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "core/denoise/ar_model.hpp"
#include "support/signals.hpp"

namespace gyrod {
namespace {

using core::ArFitter;
using core::ArModel;
using core::ArStatus;
using namespace testing;

/// a_1..a_p of the polynomial with a pair of roots radius e^(+-i angle) for each entry.
std::vector<double> coefficients_of(const std::vector<std::complex<double>>& upper_roots) {
  std::vector<double> polynomial{1.0};
  for (const std::complex<double>& root : upper_roots) {
    const std::array<double, 3> factor{1.0, -2.0 * root.real(), std::norm(root)};
    std::vector<double> product(polynomial.size() + 2);
    for (std::size_t i = 0; i < polynomial.size(); ++i) {
      for (std::size_t j = 0; j < factor.size(); ++j) {
        product[i + j] += polynomial[i] * factor[j];
      }
    }
    polynomial = product;
  }
  std::vector<double> a(polynomial.begin() + 1, polynomial.end());
  return times(a, -1.0);
}

TEST(RootsWithin, TellsARadiusFromOneBelow) {
  std::mt19937_64 bits(1);
  std::uniform_real_distribution<double> uniform;
  for (int polynomial = 0; polynomial < 200; ++polynomial) {
    std::vector<std::complex<double>> roots;
    double largest = 0.0;
    for (int pair = 0; pair < 3; ++pair) {
      roots.push_back(std::polar(0.2 + uniform(bits), 3.0 * uniform(bits)));
      largest = std::max(largest, std::abs(roots.back()));
    }
    const std::vector<double> a = coefficients_of(roots);
    EXPECT_TRUE(core::roots_within(a, largest * 1.001));
    EXPECT_FALSE(core::roots_within(a, largest * 0.999));
  }
}

TEST(RootsWithin, OfOrderOneIsTheCoefficient) {
  EXPECT_TRUE(core::roots_within(std::array{-0.5}, 0.51));
  EXPECT_FALSE(core::roots_within(std::array{-0.5}, 0.5)) << "on the circle is not within";
  EXPECT_TRUE(core::roots_within({}, 1.0)) << "no roots";
}

TEST(RootsWithin, IsFalseForWhatIsNoNumber) {
  EXPECT_FALSE(core::roots_within(std::array{std::nan("")}, 1.0));
  EXPECT_FALSE(core::roots_within(std::array{1.0, std::nan("")}, 1.0));
}

/// Largest modulus of the roots, by Eigen's eigenvalues of the companion matrix.
double largest_root(std::span<const double> a) {
  const auto p = static_cast<Eigen::Index>(a.size());
  if (p == 0) {
    return 0.0;
  }
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(p, p);
  companion.row(0) = Eigen::Map<const Eigen::RowVectorXd>(a.data(), p);
  companion.bottomLeftCorner(p - 1, p - 1).setIdentity();
  return companion.eigenvalues().cwiseAbs().maxCoeff();
}

void expect_usable(const ArModel& model, const char* what) {
  EXPECT_TRUE(core::roots_within(model.coefficients(), ArModel::kMaxRootRadius)) << what;
  EXPECT_LT(largest_root(model.coefficients()), 1.0) << what;
  EXPECT_TRUE(is_finite(model.a)) << what;
  EXPECT_TRUE(std::isfinite(model.innovation_variance) && model.innovation_variance >= 0.0) << what;
}

TEST(ArStability, HoldsForRandomSeries) {
  std::mt19937_64 bits(2);
  ArFitter fitter(256, core::kMaxArOrder);
  for (unsigned seed = 1; seed <= 500; ++seed) {
    const std::size_t size = 8 + bits() % 249;
    const double share = std::pow(10.0, -static_cast<double>(bits() % 17));
    expect_usable(
        fitter.fit(sum(tone(size, 0.5 / static_cast<double>(1 + seed % 60)), white_noise(size, seed), share)),
        "tone in noise");
    expect_usable(fitter.fit(quantised(white_noise(size, seed), 2.0)), "quantised noise");
  }
}

TEST(ArStability, HoldsForHostileSeries) {
  constexpr std::size_t kSize = 128;
  ArFitter fitter(kSize, core::kMaxArOrder);
  Signal ramp(kSize);
  Signal growing(kSize);
  Signal alternating(kSize);
  for (std::size_t k = 0; k < kSize; ++k) {
    ramp[k] = static_cast<double>(k);
    growing[k] = std::pow(1.5, static_cast<double>(k));
    alternating[k] = k % 2 == 0 ? 1.0 : -1.0;
  }
  Signal step(kSize);
  std::fill_n(step.begin(), kSize / 2, 1.0);
  for (const double scale : {1.0, 1e-12, 1e-100, 1e100}) {
    expect_usable(fitter.fit(times(ramp, scale)), "ramp");
    expect_usable(fitter.fit(times(growing, scale)), "growing");
    expect_usable(fitter.fit(times(reversed(growing), scale)), "decaying");
    expect_usable(fitter.fit(times(alternating, scale)), "alternating");
    expect_usable(fitter.fit(times(step, scale)), "step");
    for (std::size_t place = 0; place < kSize; ++place) {
      Signal impulse(kSize);
      impulse[place] = scale;
      expect_usable(fitter.fit(impulse), "impulse");
    }
  }
  expect_usable(fitter.fit(Signal(kSize, 1e-320)), "denormal");
  expect_usable(fitter.fit(times(white_noise(kSize, 1), 1e-300)), "squares below the smallest double");
  expect_usable(fitter.fit(times(white_noise(kSize, 1), 1e300)), "squares beyond the largest double");
}

// x[k] = 1.5 x[k-1] exactly: the root 1.5 comes back at the largest radius allowed.
TEST(ArStability, PullsAnUnstableRootInToTheLimit) {
  Signal growing(60);
  for (std::size_t k = 0; k < growing.size(); ++k) {
    growing[k] = std::pow(1.5, static_cast<double>(k));
  }
  const ArModel model = ArFitter(60, 1).fit(growing);
  EXPECT_EQ(model.status, ArStatus::kDamped);
  EXPECT_NEAR(model.a[0], ArModel::kMaxRootRadius, 1e-8);
}

}  // namespace
}  // namespace gyrod
