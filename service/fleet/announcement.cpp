#include "fleet/announcement.hpp"

#include <algorithm>
#include <charconv>

namespace gyrod::fleet {
namespace {

constexpr std::string_view kShard = "gyrod.shard=";
constexpr std::string_view kState = "gyrod.state=";
constexpr std::string_view kYields = "gyrod.yields=";
constexpr std::string_view kGreets = "gyrod.greets=";
constexpr std::string_view kAwaits = "gyrod.awaits=";
constexpr std::string_view kHanded = "gyrod.handed=";

/// What stands before the next separator; `text` then begins behind it.
std::string_view cut(std::string_view& text, char separator) {
  const std::size_t end = std::min(text.find(separator), text.size());
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return part;
}

/// What stands behind the key, if it is this key.
std::optional<std::string_view> value_of(std::string_view entry, std::string_view key) {
  if (!entry.starts_with(key)) return std::nullopt;
  return entry.substr(key.size());
}

std::string list_of(std::string_view key, const std::vector<std::string>& ids) {
  std::string text(key);
  for (const std::string& id : ids) text += id + ",";
  if (!ids.empty()) text.pop_back();
  return text + ";";
}

std::vector<std::string> ids_in(std::string_view list) {
  std::vector<std::string> ids;
  while (!list.empty() && ids.size() < kMostPeers) ids.emplace_back(cut(list, ','));
  return ids;
}

}  // namespace

std::string text_of(const Announcement& announcement) {
  return std::string(kShard) + text_of(announcement.shard) + ";" + std::string(kState) +
         (announcement.active ? "active" : "joining") + ";" + list_of(kYields, announcement.yields_to) +
         list_of(kGreets, announcement.greets) + list_of(kAwaits, announcement.awaits) +
         (announcement.handed ? text_of_leaving(*announcement.handed) : "");
}

std::string text_of_leaving(std::uint64_t handed) {
  return std::string(kHanded) + std::to_string(handed) + ";";
}

std::optional<std::uint64_t> parse_handed(std::string_view text) {
  while (!text.empty()) {
    const auto value = value_of(cut(text, ';'), kHanded);
    if (!value) continue;
    std::uint64_t handed = 0;
    const auto [end, error] = std::from_chars(value->begin(), value->end(), handed);
    if (error != std::errc{} || end != value->end()) return std::nullopt;
    return handed;
  }
  return std::nullopt;
}

std::optional<Announcement> parse_announcement(std::string_view text) {
  std::optional<Shard> shard;
  Announcement read;
  read.handed = parse_handed(text);
  while (!text.empty()) {
    const std::string_view entry = cut(text, ';');
    if (const auto value = value_of(entry, kShard)) {
      shard = parse_shard(*value);
      if (!shard) return std::nullopt;
    } else if (const auto state = value_of(entry, kState)) {
      read.active = *state == "active";
      if (!read.active && *state != "joining") return std::nullopt;
    } else if (const auto yields = value_of(entry, kYields)) {
      read.yields_to = ids_in(*yields);
    } else if (const auto greets = value_of(entry, kGreets)) {
      read.greets = ids_in(*greets);
    } else if (const auto awaits = value_of(entry, kAwaits)) {
      read.awaits = ids_in(*awaits);
    }
  }
  if (!shard) return std::nullopt;
  read.shard = *shard;
  return read;
}

}  // namespace gyrod::fleet
