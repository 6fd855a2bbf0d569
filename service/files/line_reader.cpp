#include "files/line_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <zlib.h>

#include "files/file_error.hpp"

namespace gyrod::files {
namespace {

constexpr std::size_t kChunk = std::size_t{256} << 10U;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Opens `path` for reading; sets `size` where it is an ordinary file.
int open_for_reading(const std::string& path, std::uint64_t& size) {
  const int descriptor = path == "-" ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw FileError(path + ": cannot be read: " + std::generic_category().message(errno));
  struct stat status {};
  if (::fstat(descriptor, &status) == 0 && S_ISDIR(status.st_mode)) {
    ::close(descriptor);
    throw FileError(path + ": is a directory, expected a file");
  }
  if (S_ISREG(status.st_mode)) size = static_cast<std::uint64_t>(status.st_size);
  return descriptor;
}

}  // namespace

void LineReader::Close::operator()(gzFile_s* file) const noexcept { gzclose_r(file); }

LineReader::LineReader(const std::string& path)
    : name_(path == "-" ? "standard input" : path), buffer_(kChunk) {
  const int descriptor = open_for_reading(path, size_bytes_);
  file_.reset(gzdopen(descriptor, "rb"));
  if (!file_) {
    ::close(descriptor);
    throw FileError(name_ + ": cannot be read: out of memory");
  }
  gzbuffer(file_.get(), kChunk);
}

bool LineReader::next(std::string_view& line) {
  std::size_t searched = 0;
  const char* end = nullptr;
  for (;;) {
    const char* begin = buffer_.data() + begin_ + searched;
    end = static_cast<const char*>(std::memchr(begin, '\n', end_ - begin_ - searched));
    if (end != nullptr) break;
    searched = end_ - begin_;
    if (refill()) continue;
    if (searched == 0) return false;
    end = buffer_.data() + end_;  // the last line needs no end
    break;
  }
  line = {buffer_.data() + begin_, static_cast<std::size_t>(end - buffer_.data()) - begin_};
  begin_ = std::min(begin_ + line.size() + 1, end_);
  ++line_number_;
  if (line_number_ == 1 && line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
  if (line.ends_with('\r')) line.remove_suffix(1);
  return true;
}

/// Reads more behind the unread part, which moves to the front. @return false at the end of the file
bool LineReader::refill() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  if (end_ == buffer_.size()) {
    if (end_ >= kLongestLine) {
      throw FileError(name_ + ":" + std::to_string(line_number_ + 1) + ": line is longer than " +
                      std::to_string(kLongestLine) + " bytes, expected a text file");
    }
    buffer_.resize(2 * buffer_.size());
  }
  const int count = gzread(file_.get(), buffer_.data() + end_, static_cast<unsigned>(buffer_.size() - end_));
  if (count > 0) {
    end_ += static_cast<std::size_t>(count);
    return true;
  }
  int status = Z_OK;
  const char* reason = gzerror(file_.get(), &status);
  if (status == Z_OK || status == Z_STREAM_END) return false;
  if (status == Z_BUF_ERROR)
    throw FileError(name_ + ": gzip file is cut off after line " + std::to_string(line_number_));
  if (status == Z_ERRNO) throw FileError(name_ + ": read error: " + std::generic_category().message(errno));
  throw FileError(name_ + ": gzip file is damaged after line " + std::to_string(line_number_) + ": " +
                  reason);
}

std::optional<double> LineReader::progress() const noexcept {
  if (size_bytes_ == 0) return std::nullopt;
  const auto offset = static_cast<double>(gzoffset(file_.get()));
  return std::clamp(offset / static_cast<double>(size_bytes_), 0.0, 1.0);
}

}  // namespace gyrod::files
