#include "settings/text_file.hpp"

#include <cerrno>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <system_error>

namespace gyrod::settings {

namespace fs = std::filesystem;

TextFile read_text_file(const fs::path& file, std::size_t most_mebibytes) {
  const auto refused = [](std::string trouble) {
    return TextFile{.text = "", .trouble = std::move(trouble)};
  };
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found)
    return {.text = "", .trouble = "no such file", .missing = true};
  if (error) return refused("cannot be read: " + error.message());
  if (fs::is_directory(status)) return refused("is a directory, not a file");
  if (!fs::is_regular_file(status)) return refused("is not a regular file");
  const std::uintmax_t most = std::uintmax_t{most_mebibytes} << 20U;
  if (fs::file_size(file, error) > most)
    return refused("is larger than " + std::to_string(most_mebibytes) + " MiB");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return refused("cannot be read: " + std::generic_category().message(errno));
  return {.text = std::string(std::istreambuf_iterator<char>(stream), {}), .trouble = ""};
}

}  // namespace gyrod::settings
