#include "core/denoise/arma_model.hpp"

#include <algorithm>
#include <cassert>

namespace gyrod::core {

ModelFamily ArmaModel::family() const noexcept {
  if (status == ArStatus::kConstant || status == ArStatus::kTooShort) return ModelFamily::kNone;
  if (p == 0 && q == 0) return ModelFamily::kWhite;
  if (q == 0) return ModelFamily::kAr;
  return p == 0 ? ModelFamily::kMa : ModelFamily::kArma;
}

std::string_view name_of(ModelFamily family) noexcept {
  constexpr std::array<std::string_view, 5> kNames = {"none", "white", "AR", "MA", "ARMA"};
  return kNames[static_cast<std::size_t>(family)];
}

bool invertible_within(std::span<const double> b, double radius) noexcept {
  assert(b.size() <= kMaxMaOrder);
  std::array<double, kMaxMaOrder> opposite{};
  std::ranges::transform(b, opposite.begin(), [](double value) { return -value; });
  return roots_within({opposite.data(), b.size()}, radius);
}

void innovations(const ArmaModel& model, std::span<const double> x, std::span<double> w) noexcept {
  assert(w.size() == x.size() && (w.data() != x.data() || model.p + model.q == 0));
  for (std::size_t k = 0; k < x.size(); ++k) {
    double value = x[k];
    for (std::size_t i = 1; i <= std::min(model.p, k); ++i) value -= model.a[i - 1] * x[k - i];
    for (std::size_t i = 1; i <= std::min(model.q, k); ++i) value -= model.b[i - 1] * w[k - i];
    w[k] = value;
  }
}

}  // namespace gyrod::core
