#include "settings/text_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <zlib.h>

namespace gyrod::settings {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kChunkBytes = 64U << 10U;

struct CloseGzip {
  void operator()(gzFile_s* file) const noexcept { gzclose_r(file); }
};

/// zlib gives what is not compressed as it is. @return nothing where the text is longer than `most`
/// @throws std::system_error, or std::runtime_error for compressed text that is damaged or cut off
std::optional<std::string> read_all(const fs::path& file, std::uintmax_t most) {
  errno = 0;
  const std::unique_ptr<gzFile_s, CloseGzip> stream(gzopen(file.c_str(), "rbe"));
  if (!stream) throw std::system_error(errno, std::generic_category());
  std::string text;
  for (;;) {
    const std::size_t before = text.size();
    text.resize(before + kChunkBytes);
    const int count = gzread(stream.get(), text.data() + before, kChunkBytes);
    text.resize(before + static_cast<std::size_t>(std::max(count, 0)));
    if (text.size() > most) return std::nullopt;
    if (count > 0) continue;
    int reason = Z_OK;
    const char* words = gzerror(stream.get(), &reason);
    if (reason == Z_ERRNO) throw std::system_error(errno, std::generic_category());
    if (reason != Z_OK && reason != Z_STREAM_END) throw std::runtime_error(std::string("gzip: ") + words);
    return text;
  }
}

}  // namespace

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
  const std::string too_large = "is larger than " + std::to_string(most_mebibytes) + " MiB";
  const std::uintmax_t most = std::uintmax_t{most_mebibytes} << 20U;
  if (fs::file_size(file, error) > most) return refused(too_large);
  try {
    auto text = read_all(file, most);
    return text ? TextFile{.text = *std::move(text), .trouble = ""} : refused(too_large);
  } catch (const std::system_error& failure) {
    return refused("cannot be read: " + failure.code().message());
  } catch (const std::runtime_error& failure) {
    return {.text = "", .trouble = "cannot be read: " + std::string(failure.what()), .damaged = true};
  }
}

}  // namespace gyrod::settings
