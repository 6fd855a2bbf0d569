#include "app/targets.hpp"

#include <cstddef>
#include <filesystem>
#include <system_error>

#include <CLI/CLI.hpp>

namespace gyrod::app {
namespace {

namespace fs = std::filesystem;

bool is_one_file(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  if (a == b) return true;
  std::error_code none;
  return fs::is_regular_file(a, none) && fs::equivalent(a, b, none);
}

void require_other(const NamedFile& output, const NamedFile& other) {
  if (!is_one_file(output.path, other.path)) return;
  throw CLI::ValidationError(output.option, "is the same file as " + other.option + ", " + other.path);
}

}  // namespace

void require_apart(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) require_other(outputs[i], outputs[k]);
    for (const NamedFile& input : inputs) {
      if (input.path != "-") require_other(outputs[i], input);
    }
  }
}

}  // namespace gyrod::app
