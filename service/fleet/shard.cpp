#include "fleet/shard.hpp"

#include <cassert>
#include <utility>

namespace gyrod::fleet {
namespace {

std::uint64_t key_of(std::string_view sensor) noexcept {
  std::uint64_t key = 14695981039346656037ULL;
  for (const char c : sensor) key = (key ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return key;
}

std::uint64_t mix(std::uint64_t z) noexcept {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

/// Digits only, and none too many.
std::optional<std::uint32_t> parse_count(std::string_view text) noexcept {
  std::uint32_t number = 0;
  for (const char c : text) {
    if (c < '0' || c > '9' || number > kMaxShards) return std::nullopt;
    number = 10 * number + static_cast<std::uint32_t>(c - '0');
  }
  if (text.empty() || text.front() == '0') return std::nullopt;
  return number <= kMaxShards ? std::optional(number) : std::nullopt;
}

}  // namespace

std::optional<Shard> parse_shard(std::string_view text) noexcept {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto index = parse_count(text.substr(0, slash));
  const auto count = parse_count(text.substr(slash + 1));
  if (!index || !count || *index > *count) return std::nullopt;
  return Shard{*index, *count};
}

std::string text_of(const Shard& shard) {
  return std::to_string(shard.index) + "/" + std::to_string(shard.count);
}

std::uint32_t shard_of(std::string_view sensor, std::uint32_t count) noexcept {
  assert(count >= 1 && count <= kMaxShards);
  const std::uint64_t key = key_of(sensor);
  std::uint32_t best = 1;
  std::uint64_t most = 0;
  for (std::uint32_t j = 1; j <= count; ++j) {
    const std::uint64_t weight = mix(key + j * 0x9E3779B97F4A7C15ULL);
    if (weight <= most) continue;
    most = weight;
    best = j;
  }
  return best;
}

bool holds(const Shard& shard, std::string_view sensor) noexcept {
  return shard.count == 1 || shard_of(sensor, shard.count) == shard.index;
}

bool overlap(const Shard& a, const Shard& b) noexcept {
  const auto& [small, large] = a.count <= b.count ? std::pair(a, b) : std::pair(b, a);
  return small.index == large.index || large.index > small.count;
}

}  // namespace gyrod::fleet
