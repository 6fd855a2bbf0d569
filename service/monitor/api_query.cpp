#include "monitor/api_query.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace gyrod::monitor {
namespace {

/// The whole text as a number, or none.
template <class Number>
std::optional<Number> parsed(std::string_view text) {
  Number value{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = stop == text.data() + text.size();
  return error == std::errc{} && whole ? std::optional(value) : std::nullopt;
}

std::string joined(std::initializer_list<std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) text += (text.empty() ? "" : ", ") + std::string(word);
  return text;
}

template <class Number>
std::string range(std::string_view kind, Number least, Number most) {
  std::ostringstream text;
  text << kind << " from " << least << " to " << most;
  return text.str();
}

int hex_digit(char c) noexcept {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

ApiQuery::ApiQuery(const Request& request, std::initializer_list<std::string_view> known)
    : request_(request) {
  for (const auto& [key, value] : request.query) {
    if (std::ranges::find(known, key) == known.end()) {
      throw ApiError(400, "unknown query key " + in_quotes(key) + "; expected " +
                              (known.size() == 0 ? "none" : "one of " + joined(known)));
    }
    if (request.query.count(key) > 1)
      throw ApiError(400, "query key " + in_quotes(key) + " is given more than once; expected once");
  }
}

std::optional<std::string_view> ApiQuery::text(std::string_view key) const {
  const auto found = request_.query.find(std::string(key));
  return found == request_.query.end() ? std::nullopt : std::optional<std::string_view>(found->second);
}

std::uint64_t ApiQuery::whole(std::string_view key, std::uint64_t least, std::uint64_t most,
                              std::uint64_t otherwise) const {
  const auto given = text(key);
  if (!given) return otherwise;
  const auto value = parsed<std::uint64_t>(*given);
  if (!value || *value < least || *value > most) fail(key, *given, range("a whole number", least, most));
  return *value;
}

double ApiQuery::number(std::string_view key, double least, double most, double otherwise) const {
  const auto given = text(key);
  if (!given) return otherwise;
  const auto value = parsed<double>(*given);
  if (!value || !(*value >= least && *value <= most)) fail(key, *given, range("a number", least, most));
  return *value;
}

std::size_t ApiQuery::one_of(std::string_view key, std::initializer_list<std::string_view> words,
                             std::size_t otherwise) const {
  const auto given = text(key);
  if (!given) return otherwise;
  const auto* const found = std::ranges::find(words, *given);
  if (found == words.end()) fail(key, *given, "one of " + joined(words));
  return static_cast<std::size_t>(found - words.begin());
}

std::vector<std::string_view> ApiQuery::list(std::string_view key) const {
  std::vector<std::string_view> words;
  std::string_view rest = text(key).value_or("");
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    words.push_back(rest.substr(0, comma));
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
  }
  return words;
}

void ApiQuery::fail(std::string_view key, std::string_view value, std::string_view expected) {
  throw ApiError(
      400, "query key " + in_quotes(key) + " is " + in_quotes(value) + "; expected " + std::string(expected));
}

std::optional<std::string> percent_decoded(std::string_view text) {
  std::string decoded;
  decoded.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    if (text.size() - i < 3) return std::nullopt;
    const int high = hex_digit(text[i + 1]);
    const int low = hex_digit(text[i + 2]);
    if (high < 0 || low < 0) return std::nullopt;
    decoded += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return decoded;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMost = 80;
  std::string made = "\"";
  for (const char c : text.substr(0, kMost)) made += c >= ' ' && c <= '~' ? c : '?';
  return made + (text.size() > kMost ? "...\"" : "\"");
}

}  // namespace gyrod::monitor
