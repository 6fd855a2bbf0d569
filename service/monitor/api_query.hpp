/// What clients of the JSON API write into a query, taken strictly: an unknown key, a repeated one or a value that does not fit is an error
/// that names it and says what was expected.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "monitor/answer.hpp"

namespace gyrod::monitor {

/// A request that is not answered as asked.
class ApiError : public std::runtime_error {
 public:
  ApiError(int status, const std::string& words) : std::runtime_error(words), status_(status) {}
  [[nodiscard]] int status() const noexcept { return status_; }

 private:
  int status_;
};

/// The query of one request; refers to it. Every method throws ApiError 400.
class ApiQuery {
 public:
  /// @param known every key that the route knows
  ApiQuery(const Request& request, std::initializer_list<std::string_view> known);

  [[nodiscard]] std::optional<std::string_view> text(std::string_view key) const;
  [[nodiscard]] std::uint64_t whole(std::string_view key, std::uint64_t least, std::uint64_t most,
                                    std::uint64_t otherwise) const;
  [[nodiscard]] double number(std::string_view key, double least, double most, double otherwise) const;
  /// One of these words: which. @param otherwise where the key is not given
  [[nodiscard]] std::size_t one_of(std::string_view key, std::initializer_list<std::string_view> words,
                                   std::size_t otherwise) const;
  /// 0 or 1.
  [[nodiscard]] bool flag(std::string_view key) const { return one_of(key, {"0", "1"}, 0) == 1; }
  /// Words separated by commas; empty where the key is not given.
  [[nodiscard]] std::vector<std::string_view> list(std::string_view key) const;

  [[noreturn]] static void fail(std::string_view key, std::string_view value, std::string_view expected);

 private:
  const Request& request_;
};

/// Percent-decoded; '+' stays what it is. None for a '%' without two hexadecimal digits.
[[nodiscard]] std::optional<std::string> percent_decoded(std::string_view text);

/// For messages: quoted, shortened, other characters than printable ASCII replaced.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace gyrod::monitor
