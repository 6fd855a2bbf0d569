#include "files/number_text.hpp"

#include <array>
#include <charconv>
#include <limits>
#include <system_error>

namespace gyrod::files {
namespace {

bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }

/// std::from_chars takes no leading plus.
std::string_view without_plus(std::string_view text) noexcept {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return plus ? text.substr(1) : text;
}

/// The whole of `text` as a number, or nothing.
template <class Number>
std::optional<Number> parse_all(std::string_view text) noexcept {
  Number value{};
  const std::string_view digits = without_plus(text);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

/// Length of the digits at the front of `text`.
std::size_t count_digits(std::string_view text) noexcept {
  std::size_t count = 0;
  while (count < text.size() && is_digit(text[count])) ++count;
  return count;
}

/// Takes the digits off the front of `text`.
std::string_view take_digits(std::string_view& text) noexcept {
  const std::string_view digits = text.substr(0, count_digits(text));
  text.remove_prefix(digits.size());
  return digits;
}

/// A decimal number without its sign: 0.whole fraction * 10^point, where the point may lie beyond the digits
/// on either side.
struct Decimal {
  std::string_view whole;
  std::string_view fraction;
  std::int64_t point = 0;

  [[nodiscard]] std::int64_t digits() const noexcept {
    return static_cast<std::int64_t>(whole.size() + fraction.size());
  }
  /// Digit number i, 0 before the first and after the last.
  [[nodiscard]] unsigned digit(std::int64_t i) const noexcept {
    if (i < 0 || i >= digits()) return 0;
    const auto index = static_cast<std::size_t>(i);
    return static_cast<unsigned>((index < whole.size() ? whole[index] : fraction[index - whole.size()]) -
                                 '0');
  }
};

std::optional<Decimal> read_decimal(std::string_view text) noexcept {
  Decimal number;
  number.whole = take_digits(text);
  if (!text.empty() && text.front() == '.') {
    text.remove_prefix(1);
    number.fraction = take_digits(text);
  }
  if (number.digits() == 0) return std::nullopt;
  number.point = static_cast<std::int64_t>(number.whole.size());
  if (text.empty()) return number;
  if (text.front() != 'e' && text.front() != 'E') return std::nullopt;
  const auto exponent = parse_all<std::int32_t>(text.substr(1));
  if (!exponent) return std::nullopt;
  number.point += *exponent;
  return number;
}

/// The number rounded to a whole one, half up.
std::optional<std::uint64_t> round_to_whole(const Decimal& number) noexcept {
  constexpr std::uint64_t kLargest = std::numeric_limits<std::int64_t>::max();
  std::uint64_t value = 0;
  for (std::int64_t i = 0; i < number.point; ++i) {
    if (value == 0 && i >= number.digits()) return 0;  // only zeros: "0e300"
    if (value > (kLargest - number.digit(i)) / 10) return std::nullopt;
    value = value * 10 + number.digit(i);
  }
  const std::uint64_t half_up = number.digit(number.point) >= 5 ? 1 : 0;
  if (value > kLargest - half_up) return std::nullopt;
  return value + half_up;
}

template <class Number>
void append_text_of(std::string& text, Number value) {
  std::array<char, 32> buffer{};  // the longest double takes 24
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  text.append(buffer.data(), end);
}

}  // namespace

std::optional<double> parse_rate(std::string_view text) noexcept {
  if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
  return parse_all<double>(text);
}

std::optional<std::int64_t> parse_stamp_ns(std::string_view text, int exponent) noexcept {
  const bool negative = !text.empty() && text.front() == '-';
  auto number = read_decimal(negative ? text.substr(1) : without_plus(text));
  if (!number) return std::nullopt;
  number->point += exponent;
  const auto magnitude = round_to_whole(*number);
  if (!magnitude) return std::nullopt;
  const auto value = static_cast<std::int64_t>(*magnitude);
  return negative ? -value : value;
}

std::optional<std::uint64_t> parse_sequence(std::string_view text) noexcept {
  const std::size_t point = text.find('.');
  if (point == std::string_view::npos) return parse_all<std::uint64_t>(text);
  if (text.find_first_not_of('0', point + 1) != std::string_view::npos) return std::nullopt;
  return parse_all<std::uint64_t>(text.substr(0, point));
}

void append_number(std::string& text, double value) { append_text_of(text, value); }
void append_number(std::string& text, std::int64_t value) { append_text_of(text, value); }
void append_number(std::string& text, std::uint64_t value) { append_text_of(text, value); }

}  // namespace gyrod::files
