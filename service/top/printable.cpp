#include "top/printable.hpp"

#include <algorithm>

namespace gyrod::top {

std::string printable(std::string_view text, std::size_t most) {
  constexpr char kFirst = ' ';
  constexpr char kLast = '~';
  std::string clean(text.substr(0, most));
  std::ranges::replace_if(
      clean, [](char c) { return c < kFirst || c > kLast; }, '?');
  return clean;
}

}  // namespace gyrod::top
