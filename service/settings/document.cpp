#include "settings/document.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace gyrod::settings {
namespace {

using nlohmann::json;

/// The configuration itself is three levels deep.
constexpr std::size_t kMaxDepth = 16;
constexpr std::size_t kMaxValueChars = 80;
constexpr std::size_t kMaxPrintableChars = 240;

/// "line 3, column 7" of the byte number `position`, counted from 1.
std::string place(std::string_view text, std::size_t position) {
  const std::string_view before = text.substr(0, position == 0 ? 0 : position - 1);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t line_start = before.find_last_of('\n');
  const std::size_t column = before.size() - (line_start == std::string_view::npos ? 0 : line_start + 1) + 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

/// The library's words without its own name and position:
/// "[json.exception.parse_error.101] parse error at line 1, column 2: WORDS" or
/// "[json.exception.out_of_range.406] WORDS".
std::string words_of(std::string_view what) {
  if (const auto bracket = what.find("] "); bracket != std::string_view::npos)
    what.remove_prefix(bracket + 2);
  if (what.starts_with("parse error at ")) {
    if (const auto colon = what.find(": "); colon != std::string_view::npos) what.remove_prefix(colon + 2);
  }
  return printable(what);
}

/// "syntax error while parsing WHAT - unexpected THIS; expected THAT" to THAT.
std::string expectation_in(const std::string& words) {
  constexpr std::string_view kLead = "; expected ";
  const auto lead = words.rfind(kLead);
  return lead == std::string::npos ? "" : words.substr(lead + kLead.size());
}

/// Builds the value as the parser reports its parts.
class DocumentBuilder final : public json::json_sax_t {
 public:
  DocumentBuilder(std::string_view text, Document& document) : text_(text), document_(document) {}

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(json::number_integer_t value) override { return add(value); }
  bool number_unsigned(json::number_unsigned_t value) override { return add(value); }
  bool number_float(json::number_float_t value, const std::string& /*token*/) override { return add(value); }
  bool string(std::string& value) override { return add(std::move(value)); }
  bool binary(json::binary_t& /*value*/) override { return false; }
  bool start_object(std::size_t /*elements*/) override { return open(json::object()); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t /*elements*/) override { return open(json::array()); }
  bool end_array() override { return close(); }

  bool key(std::string& name) override {
    levels_.back().key = std::move(name);
    if (levels_.back().value->contains(levels_.back().key)) report_repeated();
    document_.position.try_emplace(shown_path(), document_.position.size());
    return true;
  }

  bool parse_error(std::size_t position, const std::string& /*token*/,
                   const json::exception& error) override {
    const std::string words = words_of(error.what());
    document_.issues.push_back({.key = "",
                                .value = "",
                                .expected = expectation_in(words),
                                .message = place(text_, position) + ": " + words});
    return false;
  }

 private:
  struct Level {
    json* value;
    std::string key;
    std::string prefix;  ///< shown path of the container and a dot, empty at the top
  };

  /// Puts a value where the parser is; the pointer stays valid until the level above it gets its next value.
  json* put(json value) {
    if (levels_.empty()) return &(document_.root = std::move(value));
    Level& level = levels_.back();
    if (level.value->is_array()) return &level.value->emplace_back(std::move(value));
    return &((*level.value)[level.key] = std::move(value));
  }

  bool add(json value) {
    put(std::move(value));
    return true;
  }

  bool open(json container) {
    if (levels_.size() == kMaxDepth) {
      const std::string limit = std::to_string(kMaxDepth) + " levels";
      document_.issues.push_back({.key = shown_path(),
                                  .value = "",
                                  .expected = "at most " + limit,
                                  .message = "nested deeper than " + limit});
      return false;
    }
    std::string prefix = levels_.empty() ? "" : shown_path() + ".";
    levels_.push_back({.value = put(std::move(container)), .key = "", .prefix = std::move(prefix)});
    return true;
  }

  bool close() {
    levels_.pop_back();
    return true;
  }

  void report_repeated() {
    const std::string name = shown_path();
    document_.issues.push_back({.key = name,
                                .value = "",
                                .expected = "each key once",
                                .message = name + " is given more than once; expected each key once"});
  }

  /// Dotted path of where the parser is, of bounded length whatever the keys.
  [[nodiscard]] std::string shown_path() const {
    const Level& level = levels_.back();
    return printable(level.prefix + (level.value->is_array() ? "[]" : level.key));
  }

  std::string_view text_;
  Document& document_;
  std::vector<Level> levels_;
};

}  // namespace

Document parse_document(std::string_view text) {
  Document document;
  DocumentBuilder builder(text, document);
  constexpr bool kWholeText = true;
  constexpr bool kComments = true;
  document.parsed =
      json::sax_parse(text.begin(), text.end(), &builder, json::input_format_t::json, kWholeText, kComments);
  return document;
}

std::string shortened(const json& value) {
  std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
  if (text.size() > kMaxValueChars) text = text.substr(0, kMaxValueChars) + "...";
  return text;
}

std::string printable(std::string_view text) {
  std::string out(text);
  if (text.size() > kMaxPrintableChars) {
    constexpr std::size_t kHalf = kMaxPrintableChars / 2;
    out = std::string(text.substr(0, kHalf)) + " ... " + std::string(text.substr(text.size() - kHalf));
  }
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return out;
}

}  // namespace gyrod::settings
