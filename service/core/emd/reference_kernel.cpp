/// The plain kernel: what it computes is the definition of a sift, written for the reader and not for speed.
#include <algorithm>
#include <span>

#include "core/emd/boundary.hpp"
#include "core/emd/sift_kernel.hpp"

namespace gyrod::core {
namespace {

void find_extrema(SiftWorkspace& ws) noexcept {
  Extrema& extrema = ws.extrema;
  extrema.begin = Extrema::kMaxAdded;
  extrema.end = Extrema::kMaxAdded;
  bool has_direction = false;
  bool was_rising = false;
  std::size_t flat_from = 0;
  for (std::size_t i = 1; i < ws.size; ++i) {
    if (ws.signal[i] == ws.signal[i - 1]) {
      continue;
    }
    const bool is_rising = ws.signal[i] > ws.signal[i - 1];
    if (has_direction && is_rising != was_rising) {
      extrema.position2[extrema.end] = static_cast<std::int32_t>(flat_from + (i - 1));
      extrema.value[extrema.end] = ws.signal[i - 1];
      ++extrema.end;
    }
    has_direction = true;
    was_rising = is_rising;
    flat_from = i;
  }
}

/// An envelope: the knots of one kind, which are every second one, in the arrays of the workspace.
class Envelope {
 public:
  Envelope(SiftWorkspace& ws, std::size_t kind) noexcept
      : ws_(ws), kind_(kind), count_((ws.extrema.count() - kind + 1) / 2) {}

  /// Natural cubic spline by the Thomas algorithm. With h_i = t_(i+1) - t_i, s_i = (x_(i+1) - x_i) / h_i and
  /// sigma the sixth of the second derivative,
  ///   h_(i-1) sigma_(i-1) + 2 (h_(i-1) + h_i) sigma_i + h_i sigma_(i+1) = s_i - s_(i-1),
  /// and sigma = 0 at the first and last knot. [deBoor1978] chapter IV.
  void solve() noexcept {
    ratio(0) = 0.0;
    reduced(0) = 0.0;
    for (std::size_t i = 1; i + 1 < count_; ++i) {
      const double before = time(i) - time(i - 1);
      const double after = time(i + 1) - time(i);
      const double pivot = 2.0 * (before + after) - before * ratio(i - 1);
      ratio(i) = after / pivot;
      reduced(i) = (slope(i) - slope(i - 1) - before * reduced(i - 1)) / pivot;
    }
    sigma(count_ - 1) = 0.0;
    for (std::size_t i = count_ - 1; i > 0; --i) {
      sigma(i - 1) = reduced(i - 1) - ratio(i - 1) * sigma(i);
    }
  }

  /// Adds half of the envelope to `mean`.
  void add_half_to(std::span<double> mean) const noexcept {
    std::size_t i = 0;
    for (std::size_t sample = 0; sample < mean.size(); ++sample) {
      const auto at = static_cast<double>(sample);
      while (i + 2 < count_ && time(i + 1) <= at) {
        ++i;
      }
      const double width = time(i + 1) - time(i);
      const double u = at - time(i);
      const double linear = slope(i) - width * (2.0 * sigma(i) + sigma(i + 1));
      const double cubic = (sigma(i + 1) - sigma(i)) / width;
      mean[sample] += 0.5 * (value(i) + u * (linear + u * (3.0 * sigma(i) + u * cubic)));
    }
  }

 private:
  [[nodiscard]] std::size_t knot(std::size_t i) const noexcept { return 2 * i + kind_; }
  [[nodiscard]] double time(std::size_t i) const noexcept { return ws_.time[knot(i)]; }
  [[nodiscard]] double value(std::size_t i) const noexcept {
    return ws_.extrema.value[ws_.extrema.begin + knot(i)];
  }
  [[nodiscard]] double slope(std::size_t i) const noexcept {
    return (value(i + 1) - value(i)) / (time(i + 1) - time(i));
  }
  [[nodiscard]] double& sigma(std::size_t i) const noexcept { return ws_.sigma[knot(i)]; }
  [[nodiscard]] double& ratio(std::size_t i) const noexcept { return ws_.mean_value[knot(i)]; }
  [[nodiscard]] double& reduced(std::size_t i) const noexcept { return ws_.mean_sigma[knot(i)]; }

  SiftWorkspace& ws_;
  std::size_t kind_;
  std::size_t count_;
};

void sift(SiftWorkspace& ws) noexcept {
  add_boundary_knots(ws);
  for (std::size_t k = 0; k < ws.extrema.count(); ++k) {
    ws.time[k] = 0.5 * ws.extrema.position2[ws.extrema.begin + k];
  }
  const std::span<double> mean = std::span(ws.mean).first(ws.size);
  std::ranges::fill(mean, 0.0);
  for (const std::size_t kind : {0U, 1U}) {
    Envelope envelope(ws, kind);
    envelope.solve();
    envelope.add_half_to(mean);
  }
  for (std::size_t i = 0; i < ws.size; ++i) {
    ws.signal[i] -= ws.mean[i];
  }
  find_extrema(ws);
}

}  // namespace

const SiftKernel kReferenceKernel{find_extrema, sift};

}  // namespace gyrod::core
