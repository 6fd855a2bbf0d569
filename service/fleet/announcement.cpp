#include "fleet/announcement.hpp"

#include <algorithm>

namespace gyrod::fleet {
namespace {

constexpr std::string_view kShard = "gyrod.shard=";
constexpr std::string_view kState = "gyrod.state=";
constexpr std::string_view kYields = "gyrod.yields=";

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

}  // namespace

std::string text_of(const Announcement& announcement) {
  std::string text = std::string(kShard) + text_of(announcement.shard) + ";" + std::string(kState) +
                     (announcement.active ? "active" : "joining") + ";" + std::string(kYields);
  for (const std::string& id : announcement.yields_to) text += id + ",";
  if (!announcement.yields_to.empty()) text.pop_back();
  return text + ";";
}

std::optional<Announcement> parse_announcement(std::string_view text) {
  std::optional<Shard> shard;
  Announcement read;
  while (!text.empty()) {
    const std::string_view entry = cut(text, ';');
    if (const auto value = value_of(entry, kShard)) {
      shard = parse_shard(*value);
      if (!shard) return std::nullopt;
    } else if (const auto state = value_of(entry, kState)) {
      read.active = *state == "active";
      if (!read.active && *state != "joining") return std::nullopt;
    } else if (auto ids = value_of(entry, kYields)) {
      while (!ids->empty() && read.yields_to.size() < kMostPeers) read.yields_to.emplace_back(cut(*ids, ','));
    }
  }
  if (!shard) return std::nullopt;
  read.shard = *shard;
  return read;
}

}  // namespace gyrod::fleet
