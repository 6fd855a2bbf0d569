/// Whether a writer and a reader match, and if not, why. Internal to bus/: includes Cyclone's headers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <dds/dds.h>

namespace gyrod::bus {

/// What a writer and a reader of one topic may disagree on.
enum class Policy : std::uint8_t {
  kType,
  kReliability,
  kDurability,
  kDeadline,
  kLiveliness,
  kOwnership,
  kLatencyBudget,
  kDestinationOrder,
  kPresentation,
  kDataRepresentation,
};
inline constexpr std::size_t kPolicies = 10;
/// DDS's words for them, as in metrics.
inline constexpr std::array<std::string_view, kPolicies> kPolicyNames = {
    "type",      "reliability",    "durability",        "deadline",     "liveliness",
    "ownership", "latency_budget", "destination_order", "presentation", "data_representation"};

/// One policy on which they disagree, with the values of both in words.
struct Difference {
  Policy policy;
  std::string offered;  ///< by the writer
  std::string asked;    ///< by the reader
};

/// The policies by which a reader that asks for this does not match a writer that offers that (DDS 1.4, 2.2.3: request and offer). Type and
/// partitions are not looked at.
[[nodiscard]] std::vector<Difference> differences(const dds_qos_t* offered, const dds_qos_t* asked);

/// Whether they share a part of the domain. Two names with wildcards do not meet.
[[nodiscard]] bool share_partition(const dds_qos_t* writer, const dds_qos_t* reader);

/// The partitions of a writer or reader; none where it names none.
[[nodiscard]] std::vector<std::string> partitions_of(const dds_qos_t* qos);

}  // namespace gyrod::bus
