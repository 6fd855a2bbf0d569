#include "bus/qos_match.hpp"

#include <algorithm>
#include <cstdio>

namespace gyrod::bus {
namespace {

using Words = std::vector<std::string_view>;

/// A policy's value that can be ordered, and in words.
struct Ranked {
  std::int64_t rank = 0;
  std::string words;
};

std::string word_for(const Words& names, std::size_t value) {
  return value < names.size() ? std::string(names[value]) : std::to_string(value);
}

std::string seconds(dds_duration_t duration) {
  if (duration == DDS_INFINITY) return "none";
  char text[32];
  std::snprintf(text, sizeof text, "%g s", static_cast<double>(duration) * 1e-9);
  return text;
}

Ranked reliability(const dds_qos_t* qos) {
  dds_reliability_kind_t kind = DDS_RELIABILITY_BEST_EFFORT;
  (void)dds_qget_reliability(qos, &kind, nullptr);
  return {kind, kind == DDS_RELIABILITY_RELIABLE ? "reliable" : "best effort"};
}

Ranked durability(const dds_qos_t* qos) {
  dds_durability_kind_t kind = DDS_DURABILITY_VOLATILE;
  (void)dds_qget_durability(qos, &kind);
  return {kind, word_for({"volatile", "transient local", "transient", "persistent"}, kind)};
}

Ranked destination_order(const dds_qos_t* qos) {
  dds_destination_order_kind_t kind = DDS_DESTINATIONORDER_BY_RECEPTION_TIMESTAMP;
  (void)dds_qget_destination_order(qos, &kind);
  return {kind, word_for({"by reception", "by source"}, kind)};
}

Ranked ownership(const dds_qos_t* qos) {
  dds_ownership_kind_t kind = DDS_OWNERSHIP_SHARED;
  (void)dds_qget_ownership(qos, &kind);
  return {kind, word_for({"shared", "exclusive"}, kind)};
}

Ranked presentation(const dds_qos_t* qos) {
  dds_presentation_access_scope_kind_t scope = DDS_PRESENTATION_INSTANCE;
  (void)dds_qget_presentation(qos, &scope, nullptr, nullptr);
  return {scope, word_for({"by instance", "by topic", "by group"}, scope)};
}

/// Times rank by what they promise: the shorter, the more.
Ranked deadline(const dds_qos_t* qos) {
  dds_duration_t time = DDS_INFINITY;
  (void)dds_qget_deadline(qos, &time);
  return {-time, seconds(time)};
}

Ranked latency_budget(const dds_qos_t* qos) {
  dds_duration_t time = 0;
  (void)dds_qget_latency_budget(qos, &time);
  return {-time, seconds(time)};
}

struct Life {
  Ranked kind;
  Ranked lease;
  [[nodiscard]] std::string words() const {
    return lease.words == "none" ? kind.words : kind.words + " within " + lease.words;
  }
};

Life life_of(const dds_qos_t* qos) {
  dds_liveliness_kind_t kind = DDS_LIVELINESS_AUTOMATIC;
  dds_duration_t lease = DDS_INFINITY;
  (void)dds_qget_liveliness(qos, &kind, &lease);
  return {{kind, word_for({"automatic", "manual by participant", "manual by topic"}, kind)},
          {-lease, seconds(lease)}};
}

const char* name_of_representation(dds_data_representation_id_t id) noexcept {
  if (id == DDS_DATA_REPRESENTATION_XCDR2) return "XCDR2";
  return id == DDS_DATA_REPRESENTATION_XCDR1 ? "XCDR1" : "another";
}

Words representations(const dds_qos_t* qos) {
  std::uint32_t count = 0;
  dds_data_representation_id_t* ids = nullptr;
  Words names;
  if (dds_qget_data_representation(qos, &count, &ids)) {
    for (std::uint32_t i = 0; i < count; ++i) names.emplace_back(name_of_representation(ids[i]));
    dds_free(ids);
  }
  if (names.empty()) names.emplace_back("XCDR1");
  return names;
}

std::string joined(const Words& words) {
  std::string text;
  for (const std::string_view word : words) text += (text.empty() ? "" : " or ") + std::string(word);
  return text;
}

/// '*' stands for any characters, '?' for one. Goes back to the last '*' only, which is enough and takes bounded time.
bool fits(std::string_view pattern, std::string_view name) {
  std::size_t at = 0;
  std::size_t star = std::string_view::npos;
  std::size_t retry = 0;
  for (std::size_t i = 0; i < name.size();) {
    if (at < pattern.size() && pattern[at] == '*') {
      star = at++;
      retry = i;
    } else if (at < pattern.size() && (pattern[at] == '?' || pattern[at] == name[i])) {
      ++at;
      ++i;
    } else if (star != std::string_view::npos) {
      at = star + 1;
      i = ++retry;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', at) == std::string_view::npos;
}

bool is_pattern(std::string_view name) { return name.find_first_of("*?") != std::string_view::npos; }

bool meet(const std::string& left, const std::string& right) {
  if (left == right) return true;
  if (is_pattern(left) && is_pattern(right)) return false;
  return is_pattern(left) ? fits(left, right) : is_pattern(right) && fits(right, left);
}

}  // namespace

std::vector<Difference> differences(const dds_qos_t* offered, const dds_qos_t* asked) {
  std::vector<Difference> found;
  const auto at_least = [&](Policy policy, const Ranked& offer, const Ranked& request) {
    if (offer.rank < request.rank) found.push_back({policy, offer.words, request.words});
  };
  at_least(Policy::kReliability, reliability(offered), reliability(asked));
  at_least(Policy::kDurability, durability(offered), durability(asked));
  at_least(Policy::kDeadline, deadline(offered), deadline(asked));
  at_least(Policy::kLatencyBudget, latency_budget(offered), latency_budget(asked));
  at_least(Policy::kDestinationOrder, destination_order(offered), destination_order(asked));
  at_least(Policy::kPresentation, presentation(offered), presentation(asked));
  const Life life = life_of(offered);
  const Life wanted = life_of(asked);
  if (life.kind.rank < wanted.kind.rank || life.lease.rank < wanted.lease.rank)
    found.push_back({Policy::kLiveliness, life.words(), wanted.words()});
  if (ownership(offered).rank != ownership(asked).rank)
    found.push_back({Policy::kOwnership, ownership(offered).words, ownership(asked).words});
  // A writer sends in the first of its representations.
  const Words sent = representations(offered);
  const Words read = representations(asked);
  if (std::ranges::find(read, sent.front()) == read.end())
    found.push_back({Policy::kDataRepresentation, std::string(sent.front()), joined(read)});
  return found;
}

bool share_partition(const dds_qos_t* writer, const dds_qos_t* reader) {
  const auto with_default = [](std::vector<std::string> names) {
    if (names.empty()) names.emplace_back();
    return names;
  };
  const std::vector<std::string> left = with_default(partitions_of(writer));
  const std::vector<std::string> right = with_default(partitions_of(reader));
  return std::ranges::any_of(left, [&right](const std::string& name) {
    return std::ranges::any_of(right, [&name](const std::string& other) { return meet(name, other); });
  });
}

std::vector<std::string> partitions_of(const dds_qos_t* qos) {
  std::uint32_t count = 0;
  char** names = nullptr;
  std::vector<std::string> partitions;
  if (!dds_qget_partition(qos, &count, &names)) return partitions;
  for (std::uint32_t i = 0; i < count; ++i) {
    partitions.emplace_back(names[i]);
    dds_free(names[i]);
  }
  dds_free(static_cast<void*>(names));
  return partitions;
}

}  // namespace gyrod::bus
