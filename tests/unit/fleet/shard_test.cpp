#include "fleet/shard.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace gyrod::fleet {
namespace {

std::vector<std::string> names(std::size_t count) {
  std::vector<std::string> ids;
  for (std::size_t k = 0; k < count; ++k) ids.push_back("imu_" + std::to_string(k));
  return ids;
}

// Expected: the Python program of docs/fleet.md.
TEST(Shard, OfASensorIsTheSameInAnyLanguage) {
  constexpr std::array<std::uint32_t, 6> kCounts = {1, 2, 3, 5, 16, 64};
  struct Row {
    const char* sensor;
    std::array<std::uint32_t, 6> shards;
  };
  for (const Row& row : std::initializer_list<Row>{
           {"imu_front", {1, 1, 3, 3, 13, 38}},
           {"imu_rear", {1, 1, 3, 3, 9, 54}},
           {"rt/car/imu/data_raw", {1, 2, 2, 2, 12, 12}},
           {"a", {1, 2, 2, 2, 2, 2}},
           {"sim", {1, 2, 2, 2, 6, 49}},
       }) {
    for (std::size_t k = 0; k < kCounts.size(); ++k)
      EXPECT_EQ(shard_of(row.sensor, kCounts[k]), row.shards[k]) << row.sensor << " of " << kCounts[k];
  }
}

TEST(Shard, OneMoreTakesItsShareAndNoOtherSensorMoves) {
  const auto ids = names(2000);
  for (std::uint32_t count = 1; count < 20; ++count) {
    double moved = 0.0;
    for (const std::string& id : ids) {
      const std::uint32_t before = shard_of(id, count);
      const std::uint32_t after = shard_of(id, count + 1);
      if (after == before) continue;
      ASSERT_EQ(after, count + 1) << id;
      ++moved;
    }
    // A binomial share; five of its standard deviations.
    const double share = 1.0 / (count + 1);
    const double deviation = std::sqrt(share * (1.0 - share) * static_cast<double>(ids.size()));
    EXPECT_NEAR(moved, share * static_cast<double>(ids.size()), 5.0 * deviation) << count;
  }
}

TEST(Shard, NamesThatDifferInADigitAreSpreadEvenly) {
  constexpr std::uint32_t kCount = 7;
  constexpr std::size_t kSensors = 7000;
  std::array<double, kCount + 1> of{};
  for (const std::string& id : names(kSensors)) ++of[shard_of(id, kCount)];
  constexpr double kExpected = 1000.0;
  double chi_squared = 0.0;
  for (std::uint32_t j = 1; j <= kCount; ++j)
    chi_squared += (of[j] - kExpected) * (of[j] - kExpected) / kExpected;
  // 99.9 % point of chi-squared with 6 degrees of freedom (table).
  EXPECT_LT(chi_squared, 22.46);
}

TEST(Shard, TextIsIndexAndCountAndNothingElse) {
  EXPECT_EQ(parse_shard("1/1"), (Shard{1, 1}));
  EXPECT_EQ(parse_shard("64/64"), (Shard{64, 64}));
  EXPECT_EQ(text_of({2, 3}), "2/3");
  for (const char* text : {"", "/", "1", "1/", "/2", "0/2", "3/2", "1/65", "-1/2", "+1/2", "1/2/3", " 1/2",
                           "1/2 ", "01/2", "1/0x2", "1.0/2", "4294967297/4294967298"}) {
    EXPECT_EQ(parse_shard(text), std::nullopt) << text;
  }
}

TEST(Shard, TwoOverlapExactlyWhereASensorIsInBoth) {
  const auto ids = names(3000);
  for (std::uint32_t n = 1; n <= 5; ++n) {
    for (std::uint32_t m = 1; m <= 5; ++m) {
      std::array<std::array<bool, 6>, 6> common{};
      for (const std::string& id : ids) common[shard_of(id, n)][shard_of(id, m)] = true;
      for (std::uint32_t i = 1; i <= n; ++i) {
        for (std::uint32_t j = 1; j <= m; ++j)
          EXPECT_EQ(overlap({i, n}, {j, m}), common[i][j]) << i << '/' << n << ' ' << j << '/' << m;
      }
    }
  }
}

}  // namespace
}  // namespace gyrod::fleet
