/// Reads text line by line, plain or gzip, in constant memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

struct gzFile_s;  // zlib's, which stays out of our headers

namespace gyrod::files {

/// Whether a file is gzip is told by its first two bytes, not by its name. One thread at a time.
class LineReader {
 public:
  /// A longer line is an error: such a file is no text.
  static constexpr std::size_t kLongestLine = std::size_t{1} << 20U;

  /// @param path file, or "-" for standard input
  /// @throws FileError if it does not exist, is a directory or may not be read
  explicit LineReader(const std::string& path);

  /// The next line without its end (LF or CR LF), valid until the next call. A byte order mark (UTF-8) is
  /// left out.
  /// @return false at the end
  /// @throws FileError for a damaged or cut-off gzip file, a read error, a line longer than kLongestLine
  [[nodiscard]] bool next(std::string_view& line);

  /// Number of the line last given out, from 1.
  [[nodiscard]] std::uint64_t line_number() const noexcept { return line_number_; }
  /// For messages: the path, or "standard input".
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// Part of the (compressed) file that has been read, 0..1; nothing where the size is not known.
  [[nodiscard]] std::optional<double> progress() const noexcept;

 private:
  struct Close {
    void operator()(gzFile_s* file) const noexcept;
  };

  [[nodiscard]] bool refill();

  std::string name_;
  std::uint64_t size_bytes_ = 0;  ///< 0: not known
  std::unique_ptr<gzFile_s, Close> file_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;  ///< unread part of the buffer
  std::size_t end_ = 0;
  std::uint64_t line_number_ = 0;
};

}  // namespace gyrod::files
