/// Takes typed values out of a JSON object and says what is wrong with the first that does not fit.
#pragma once

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace gyrod::settings {

/// A noise calibration or noise state that is not what it should be. what() names file, key, value and what was expected.
class NoiseFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One object of a document, seen through the messages it would make. Refers to the document, which has to live on.
class JsonFields {
 public:
  /// @param file   for messages
  /// @param prefix dotted path of the object and a dot, empty at the root
  /// @throws NoiseFileError if the value is no object
  JsonFields(std::string file, const nlohmann::json& object, std::string prefix = "");

  [[nodiscard]] bool has(std::string_view key) const;
  [[nodiscard]] const nlohmann::json& object() const noexcept { return object_; }
  /// @throws NoiseFileError if a key is none of these
  void allow(std::initializer_list<std::string_view> known) const;

  // Each throws NoiseFileError if the key is missing or its value does not fit.
  [[nodiscard]] JsonFields fields(std::string_view key) const;
  [[nodiscard]] double number(std::string_view key) const;
  [[nodiscard]] double positive(std::string_view key) const;
  [[nodiscard]] double not_negative(std::string_view key) const;
  [[nodiscard]] std::vector<double> numbers(std::string_view key, std::size_t most) const;
  [[nodiscard]] std::vector<JsonFields> list(std::string_view key, std::size_t most) const;
  [[nodiscard]] std::string text(std::string_view key) const;

  /// "FILE: KEY is VALUE; expected EXPECTED", "FILE: KEY is missing; ..."
  [[noreturn]] void fail(std::string_view key, std::string_view expected) const;

 private:
  [[nodiscard]] const nlohmann::json* find(std::string_view key) const;

  std::string file_;
  const nlohmann::json& object_;
  std::string prefix_;
};

/// Versions of a document that can be read; they write the newest.
struct Versions {
  int oldest;
  int newest;
};

/// Parses a document whose root is an object with `version_key`: one of `versions`.
/// @param file for messages
/// @throws NoiseFileError for a syntax error, a repeated key, another root, another version
[[nodiscard]] nlohmann::json parse_versioned(const std::string& file, std::string_view text,
                                             const std::string& version_key, Versions versions);

}  // namespace gyrod::settings
