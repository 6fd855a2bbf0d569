#include "top/view.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "stream/health.hpp"

namespace gyrod::top {
namespace {

constexpr std::size_t kLongestSearch = 64;

struct Sequence {
  std::string_view bytes;
  Key key;
};

/// As xterm and its kin send them, with and without application mode.
constexpr std::array<Sequence, 14> kSequences = {{{"\x1b[A", Key::kUp},
                                                  {"\x1bOA", Key::kUp},
                                                  {"\x1b[B", Key::kDown},
                                                  {"\x1bOB", Key::kDown},
                                                  {"\x1b[5~", Key::kPageUp},
                                                  {"\x1b[6~", Key::kPageDown},
                                                  {"\x1b[H", Key::kHome},
                                                  {"\x1bOH", Key::kHome},
                                                  {"\x1b[1~", Key::kHome},
                                                  {"\x1b[F", Key::kEnd},
                                                  {"\x1bOF", Key::kEnd},
                                                  {"\x1b[4~", Key::kEnd},
                                                  {"\r", Key::kEnter},
                                                  {"\n", Key::kEnter}}};

/// Bytes of an escape sequence that we do not know: up to its last letter or '~'.
std::size_t unknown_sequence(std::string_view bytes) {
  if (bytes.size() < 2 || (bytes[1] != '[' && bytes[1] != 'O')) return 1;
  std::size_t end = 2;
  while (end < bytes.size() && (bytes[end] < '@' || bytes[end] > '~')) ++end;
  return std::min(end + 1, bytes.size());
}

std::string percent_encoded(std::string_view text) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~";
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string encoded;
  for (const char c : text) {
    if (kPlain.find(c) != std::string_view::npos) {
      encoded += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    encoded += {'%', kHex[byte >> 4U], kHex[byte & 0xFU]};
  }
  return encoded;
}

void next_sort(View& view) {
  const auto* const now = std::ranges::find(kSorts, view.sort);
  view.sort = now == std::end(kSorts) || std::next(now) == std::end(kSorts) ? kSorts[0] : *std::next(now);
}

void to_top(View& view) { view.first = view.chosen = 0; }

void type(View& view, KeyPress key) {
  switch (key.key) {
    case Key::kEnter:
      view.typing = false;
      return;
    case Key::kEscape:
      view.typing = false;
      view.search.clear();
      break;
    case Key::kBackspace:
      if (!view.search.empty()) view.search.pop_back();
      break;
    case Key::kCharacter:
      if (view.search.size() < kLongestSearch) view.search += key.character;
      break;
    default:
      return;
  }
  to_top(view);
}

/// @return false to quit
bool command(View& view, char character) {
  switch (character) {
    case 'q':
      return false;
    case '/':
      view.typing = true;
      break;
    case 's':
      next_sort(view);
      to_top(view);
      break;
    case 't':
      view.health = view.health.empty() ? troubled_states() : std::vector<std::string>{};
      to_top(view);
      break;
    case 'u':
      view.unit = view.unit == RateUnit::kDegPerS ? RateUnit::kRadPerS : RateUnit::kDegPerS;
      break;
    default:
      break;
  }
  return true;
}

void move(View& view, Key key, std::uint64_t matching, std::uint64_t rows) {
  const auto back = [&](std::uint64_t n) { view.chosen -= std::min(view.chosen, n); };
  switch (key) {
    case Key::kUp:
      return back(1);
    case Key::kPageUp:
      return back(rows);
    case Key::kDown:
      view.chosen += 1;
      return;
    case Key::kPageDown:
      view.chosen += rows;
      return;
    case Key::kHome:
      view.chosen = 0;
      return;
    case Key::kEnd:
      view.chosen = matching;
      return;
    case Key::kEscape:
      view.search.clear();
      return to_top(view);
    default:
      return;
  }
}

}  // namespace

std::vector<KeyPress> keys_of(std::string_view bytes) {
  std::vector<KeyPress> keys;
  while (!bytes.empty()) {
    const auto* const known = std::ranges::find_if(
        kSequences, [bytes](const Sequence& sequence) { return bytes.starts_with(sequence.bytes); });
    std::size_t used = 1;
    if (known != kSequences.end()) {
      keys.push_back({known->key});
      used = known->bytes.size();
    } else if (bytes.front() == '\x1b') {
      used = unknown_sequence(bytes);
      if (used == 1) keys.push_back({Key::kEscape});
    } else if (bytes.front() == '\x7f' || bytes.front() == '\b') {
      keys.push_back({Key::kBackspace});
    } else if (bytes.front() >= ' ' && bytes.front() <= '~') {
      keys.push_back({Key::kCharacter, bytes.front()});
    }
    bytes.remove_prefix(used);
  }
  return keys;
}

bool press(View& view, KeyPress key, std::uint64_t matching, std::uint64_t rows) {
  if (view.typing) {
    type(view, key);
  } else if (key.key == Key::kCharacter) {
    if (!command(view, key.character)) return false;
  } else {
    move(view, key.key, matching, rows);
  }
  keep_in_sight(view, matching, rows);
  return true;
}

void keep_in_sight(View& view, std::uint64_t matching, std::uint64_t rows) {
  view.chosen = std::min(view.chosen, matching == 0 ? 0 : matching - 1);
  view.first = std::min(view.first, view.chosen);
  if (rows > 0 && view.chosen >= view.first + rows) view.first = view.chosen - rows + 1;
}

std::vector<std::string> troubled_states() {
  std::vector<std::string> states;
  for (std::size_t n = stream::kHealthStates; n-- > 0;) {
    const std::string_view name = stream::name_of(static_cast<stream::Health>(n));
    if (is_troubled(name)) states.emplace_back(name);
  }
  return states;
}

std::string sensors_query(const View& view, std::uint64_t offset, std::uint64_t limit) {
  std::string query = "/api/v1/channels?sort=" + percent_encoded(view.sort) +
                      "&offset=" + std::to_string(offset) + "&limit=" + std::to_string(limit);
  if (!view.search.empty()) query += "&search=" + percent_encoded(view.search);
  std::string states;
  for (const std::string& state : view.health) states += (states.empty() ? "" : ",") + percent_encoded(state);
  if (!states.empty()) query += "&health=" + states;
  return query;
}

}  // namespace gyrod::top
