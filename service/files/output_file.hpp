/// A file that is there in full or not at all.
#pragma once

#include <memory>
#include <string>
#include <string_view>

struct gzFile_s;  // zlib's, which stays out of our headers

namespace gyrod::files {

/// Writes to a new file beside the target (its name and ".PID.part") and gives it the target's name on
/// close(): whoever reads the target sees the old file or the whole new one. Without close(), by an exception
/// say, the old one stays and the new one is removed. A name that ends in ".gz" is compressed. "-" is
/// standard output; that and what is no regular file (a pipe, a device) are written to directly. One thread
/// at a time.
class OutputFile {
 public:
  /// @throws FileError, before any work is done, if the target cannot be written: its folder is missing or
  /// not writable, it is
  ///         a directory, it is there and write-protected
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// @throws FileError if the device is full or fails
  void write(std::string_view text);

  /// Brings all of it to the device and the file to its name. Nothing may be written after.
  /// @throws FileError if that fails; the target is then as it was
  void close();

 private:
  struct Close {
    void operator()(gzFile_s* file) const noexcept;
  };

  [[nodiscard]] int open_target(const std::string& path);
  void discard() noexcept;
  [[noreturn]] void fail(int error_number) const;

  std::string name_;       ///< for messages
  std::string target_;     ///< final name; empty when written to directly
  std::string temporary_;  ///< name until close(); empty when there is none (any more)
  int descriptor_ =
      -1;  ///< the file, open until close() has brought it to the device; zlib holds a duplicate
  std::unique_ptr<gzFile_s, Close> file_;
};

}  // namespace gyrod::files
