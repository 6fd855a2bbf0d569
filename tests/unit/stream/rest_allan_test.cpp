#include "stream/rest_allan.hpp"

#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace gyrod::stream {
namespace {

constexpr std::size_t kBlock = 100;

/// Different in every sample, and larger by far in the blocks that are not at rest.
std::array<double, kAxes> rate_at(std::size_t n) {
  const double x = std::sin(static_cast<double>(n * n % 1009));
  return {0.01 * x, 0.02 * x, 0.03 * x};
}

/// Sums over stretches of samples [first, last).
AllanCurves sums_of(std::initializer_list<std::pair<std::size_t, std::size_t>> stretches) {
  std::array<core::OnlineAllan, kAxes> axes{};
  for (const auto& [first, last] : stretches) {
    for (std::size_t n = first; n < last; ++n) {
      for (std::size_t a = 0; a < kAxes; ++a) axes[a].step(rate_at(n)[a]);
    }
    for (auto& axis : axes) axis.interrupt();
  }
  return {axes[0].sums(), axes[1].sums(), axes[2].sums()};
}

/// Blocks of samples from number `block` on, each at rest or not as the letter says: r or m.
void run(RestAllan& allan, const std::string& blocks, std::size_t block = 0) {
  for (const char kind : blocks) {
    for (std::size_t n = 0; n < kBlock; ++n) allan.step(rate_at(block * kBlock + n));
    allan.end_block(kind == 'r');
    ++block;
  }
}

TEST(RestAllan, TakesABlockOnceItAndTheNextWereAtRest) {
  RestAllan allan;
  run(allan, "mr");
  EXPECT_EQ(allan.curves(), AllanCurves{})
      << "the samples of the first block at rest came before anybody knew";
  run(allan, "r", 2);
  EXPECT_EQ(allan.curves(), AllanCurves{}) << "block 2 waits for 3";
  run(allan, "r", 3);
  EXPECT_EQ(allan.curves(), sums_of({{200, 300}}));
  run(allan, "rr", 4);
  EXPECT_EQ(allan.curves(), sums_of({{200, 500}})) << "one stretch";
}

TEST(RestAllan, TakesBackWhatRanIntoMotion) {
  RestAllan allan;
  run(allan, "mrrrrrmmrrrr");
  // 2 to 4: 5 was at rest, but not what came after it. Then 9 and 10, for 11 was, too.
  EXPECT_EQ(allan.curves(), sums_of({{200, 500}, {900, 1100}}));
}

TEST(RestAllan, AGapEndsTheStretchAtTheLastSureBlock) {
  RestAllan allan;
  run(allan, "mrrrr");
  for (std::size_t n = 500; n < 550; ++n) allan.step(rate_at(n));
  allan.interrupt();
  run(allan, "mrrrr", 6);
  EXPECT_EQ(allan.curves(), sums_of({{200, 400}, {800, 1000}}));
}

TEST(RestAllan, GoesOnFromAnEarlierRun) {
  RestAllan first;
  run(first, "mrrrrm");
  RestAllan second;
  second.restore(first.curves());
  run(second, "mrrrrm", 10);
  const AllanCurves expected = sums_of({{200, 400}, {1200, 1400}});
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    EXPECT_EQ(second.curves()[axis].terms, expected[axis].terms);
    // What the first run handed on was rounded to the last place.
    for (std::size_t j = 0; j < core::kAllanOctaves; ++j)
      EXPECT_DOUBLE_EQ(second.curves()[axis].squares[j], expected[axis].squares[j]);
  }
  second.clear();
  EXPECT_EQ(second.curves(), AllanCurves{});
}

}  // namespace
}  // namespace gyrod::stream
