/// Numbers as they stand in recordings: decimal text to values and back, independent of the locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gyrod::files {

/// An angular rate: the nearest double. Empty text is NaN; nan and inf in any case are taken.
/// @return nothing for other text, or for a number beyond a double's range
[[nodiscard]] std::optional<double> parse_rate(std::string_view text) noexcept;

/// A stamp given in units of 10^exponent ns, as whole ns: exact, since the decimal point is moved in the text
/// itself. Digits below 1 ns are rounded, half away from zero. Takes a sign and an exponent ("1.5e9").
/// @param exponent 0..9
/// @return nothing for text that is no finite decimal number, or beyond 64 bits
[[nodiscard]] std::optional<std::int64_t> parse_stamp_ns(std::string_view text, int exponent) noexcept;

/// A sequence number. "12.0" is taken, as tools write whole numbers that once passed through a floating-point
/// column.
/// @return nothing for other text
[[nodiscard]] std::optional<std::uint64_t> parse_sequence(std::string_view text) noexcept;

/// Appends the shortest decimal text that reads back to the same double; "nan", "inf" and "-inf" for what is
/// not finite.
void append_number(std::string& text, double value);
void append_number(std::string& text, std::int64_t value);
void append_number(std::string& text, std::uint64_t value);

}  // namespace gyrod::files
