#include "bus/repeat_filter.hpp"

namespace gyrod::bus {

std::optional<std::string> RepeatFilter::pass(std::string_view message, Clock::time_point now) {
  // Makes room: of what has been quiet for two rounds the last repeats are not told any more.
  std::erase_if(texts_, [&](const auto& entry) {
    return entry.first != message && now - entry.second.last_passed >= 2 * kEvery;
  });
  if (!texts_.contains(message) && texts_.size() >= kMostTexts) message = "(more different messages)";
  const auto [entry, is_new] = texts_.try_emplace(std::string(message), Text{now});
  Text& text = entry->second;
  if (!is_new && now - text.last_passed < kEvery) {
    ++text.held_back;
    return std::nullopt;
  }
  std::string line(message);
  if (text.held_back > 0) line += " (" + std::to_string(text.held_back) + " times more since)";
  text = {now, 0};
  return line;
}

}  // namespace gyrod::bus
