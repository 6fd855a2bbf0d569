/// What a user of `gyrod top` has chosen to see, and how keys change it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "top/words.hpp"

namespace gyrod::top {

/// The API's words for an order of sensors.
inline constexpr std::string_view kSorts[] = {"health", "sensor", "noise_in", "reduction", "rate"};

struct View {
  std::string sort = "health";
  std::vector<std::string> health;  ///< states to show; empty: all
  std::string search;               ///< part of a sensor's name; empty: all
  RateUnit unit = RateUnit::kDegPerS;
  std::uint64_t first = 0;   ///< of the sensors that match, the first on the screen
  std::uint64_t chosen = 0;  ///< the one that is shown in full
  bool typing = false;       ///< a search is being typed
};

enum class Key { kUp, kDown, kPageUp, kPageDown, kHome, kEnd, kEnter, kEscape, kBackspace, kCharacter };

struct KeyPress {
  Key key = Key::kCharacter;
  char character = '\0';  ///< of kCharacter: printable ASCII
};

/// Keys in the bytes that a terminal sends; what is none of ours is left out.
[[nodiscard]] std::vector<KeyPress> keys_of(std::string_view bytes);

/// Does what the key says. @param matching sensors that match; @param rows of them on a screen. @return false to quit
[[nodiscard]] bool press(View& view, KeyPress key, std::uint64_t matching, std::uint64_t rows);

/// Keeps the chosen sensor among those that match, and on the screen.
void keep_in_sight(View& view, std::uint64_t matching, std::uint64_t rows);

/// All states that somebody should look at, worst first.
[[nodiscard]] std::vector<std::string> troubled_states();

/// Path and query of the API for what the view shows.
[[nodiscard]] std::string sensors_query(const View& view, std::uint64_t offset, std::uint64_t limit);

}  // namespace gyrod::top
