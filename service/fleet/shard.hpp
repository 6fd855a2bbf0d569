/// Which of several daemons a sensor belongs to. Text in, numbers out; no network.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gyrod::fleet {

/// Shard `index` of `count`: the sensors for which shard_of(sensor, count) == index. 1 <= index <= count <= kMaxShards.
struct Shard {
  std::uint32_t index = 1;
  std::uint32_t count = 1;

  friend bool operator==(const Shard&, const Shard&) = default;
};

/// The cost of a look at one sensor grows with the count: 30 ns at 2 shards, 140 ns at 64.
inline constexpr std::uint32_t kMaxShards = 64;

/// "2/3" is the second of three. @return nothing for any other text
[[nodiscard]] std::optional<Shard> parse_shard(std::string_view text) noexcept;
[[nodiscard]] std::string text_of(const Shard& shard);

/// The shard of a sensor by highest random weight. All arithmetic is on unsigned 64-bit integers, so that it is the same on any
/// machine and in any language:
///   key      = FNV-1a of the id's bytes: k = 14695981039346656037; for each byte: k = (k xor byte) * 1099511628211
///   weight_j = mix(key + j * 0x9E3779B97F4A7C15), j = 1..count
///   mix(z):    z = (z xor z >> 30) * 0xBF58476D1CE4E5B9; z = (z xor z >> 27) * 0x94D049BB133111EB; z xor z >> 31
///   shard    = the j of the largest weight, the smallest j of several.
/// As weight_j does not depend on the count, a sensor is in shard j of n + 1 only if it was in shard j of n, or j = n + 1: one more
/// daemon takes 1 / (n + 1) of the sensors, and no other sensor moves.
/// Sources: Thaler, Ravishankar 1998 (highest random weight); Fowler, Noll, Vo (FNV-1a); Steele, Lea, Flood 2014 (mix).
/// @pre 1 <= count <= kMaxShards. @return 1..count
[[nodiscard]] std::uint32_t shard_of(std::string_view sensor, std::uint32_t count) noexcept;

[[nodiscard]] bool holds(const Shard& shard, std::string_view sensor) noexcept;

/// Whether a sensor can be in both: the same shard of the same count; or, of different counts, the same index, or an index that the
/// smaller count does not have. Follows from what shard_of() says of one more daemon.
[[nodiscard]] bool overlap(const Shard& a, const Shard& b) noexcept;

}  // namespace gyrod::fleet
