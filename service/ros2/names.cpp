#include "ros2/names.hpp"

#include <algorithm>

namespace gyrod::ros2 {
namespace {

constexpr std::string_view kPrefix = "rt/";
constexpr std::string_view kRaw = "_raw";

bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }
bool is_letter(char c) noexcept { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// One of the names between the slashes.
bool is_name(std::string_view text) noexcept {
  const auto allowed = [](char c) { return is_letter(c) || is_digit(c) || c == '_'; };
  return !text.empty() && !is_digit(text.front()) && std::ranges::all_of(text, allowed) &&
         text.find("__") == std::string_view::npos;
}

}  // namespace

bool is_topic(std::string_view text) noexcept {
  if (!text.starts_with(kPrefix)) return false;
  text.remove_prefix(kPrefix.size());
  for (std::size_t slash = text.find('/'); slash != std::string_view::npos; slash = text.find('/')) {
    if (!is_name(text.substr(0, slash))) return false;
    text.remove_prefix(slash + 1);
  }
  return is_name(text);
}

bool is_topic_or_pattern(std::string_view text) {
  std::string topic(text);
  std::ranges::replace(topic, '*', 'a');
  return is_topic(topic) && text.find("**") == std::string_view::npos;
}

bool is_pattern(std::string_view text) noexcept { return text.find('*') != std::string_view::npos; }

/// Takes each '*' for as little as goes and gives the last one more where the rest does not fit: what an earlier one could take
/// instead, the last can, too, up to the next '/'.
bool matches(std::string_view pattern, std::string_view topic) noexcept {
  constexpr std::size_t kNone = std::string_view::npos;
  std::size_t star = kNone;   // the last '*' that was met
  std::size_t taken_end = 0;  // behind what it stands for
  std::size_t p = 0;
  std::size_t t = 0;
  const auto give_star_one_more = [&] {
    if (star == kNone || taken_end == topic.size() || topic[taken_end] == '/') return false;
    p = star + 1;
    t = ++taken_end;
    return true;
  };
  while (t < topic.size() || p < pattern.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p;
      taken_end = t;
      if (!give_star_one_more()) return false;
    } else if (p < pattern.size() && t < topic.size() && pattern[p] == topic[t]) {
      ++p;
      ++t;
    } else if (!give_star_one_more()) {
      return false;
    }
  }
  return true;
}

bool is_suffix(std::string_view text) {
  return is_topic("rt/a" + std::string(text)) && !text.empty() && !text.ends_with(kRaw);
}

Outputs outputs_of(std::string_view topic, const OutputRule& rule) {
  if (topic.ends_with(kRaw)) topic.remove_suffix(kRaw.size());
  return {std::string(topic) + rule.denoised_suffix, std::string(topic) + rule.realtime_suffix};
}

bool is_output(std::string_view topic, const OutputRule& rule) noexcept {
  return topic.ends_with(rule.denoised_suffix) || topic.ends_with(rule.realtime_suffix);
}

}  // namespace gyrod::ros2
