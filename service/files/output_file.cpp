#include "files/output_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <zlib.h>

#include "files/file_error.hpp"

namespace gyrod::files {
namespace {

namespace fs = std::filesystem;

/// Level 3 of zlib's 1..9: on recordings nearly as small as the default 6, in less than half the time.
constexpr const char* kCompressed = "wb3";
/// zlib passes the text through as it is.
constexpr const char* kPlain = "wbT";
constexpr unsigned kBufferBytes = 256U << 10U;

/// The new name is in the folder, which a power failure could still take back. As far as the folder may be opened and knows of it.
void sync_folder_of(const fs::path& file) noexcept {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

void OutputFile::Close::operator()(gzFile_s* file) const noexcept { gzclose_w(file); }

OutputFile::OutputFile(const std::string& path) : name_(path == "-" ? "standard output" : path) {
  descriptor_ = open_target(path);
  if (descriptor_ < 0) fail(errno);
  file_.reset(gzdopen(::dup(descriptor_), path.ends_with(".gz") ? kCompressed : kPlain));
  if (!file_) {
    discard();
    fail(ENOMEM);
  }
  gzbuffer(file_.get(), kBufferBytes);
}

OutputFile::~OutputFile() { discard(); }

/// @return a descriptor, or -1 with errno set
int OutputFile::open_target(const std::string& path) {
  if (path == "-") return ::dup(STDOUT_FILENO);
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  if (fs::exists(status)) {
    // A rename would go through whatever the file's own protection says.
    if (::access(path.c_str(), W_OK) != 0) return -1;
    if (!fs::is_regular_file(status)) return ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  }
  // Through a link the file it names is replaced, not the link.
  const fs::path resolved = fs::is_symlink(path, none) ? fs::weakly_canonical(path, none) : fs::path(path);
  target_ = resolved.empty() ? path : resolved.string();
  std::string temporary = target_ + "." + std::to_string(::getpid()) + ".part";
  ::unlink(temporary.c_str());  // left by a killed process of the same number
  constexpr mode_t kReadWriteLessUmask = 0666;
  const int descriptor =
      ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kReadWriteLessUmask);
  if (descriptor >= 0) temporary_ = std::move(temporary);
  return descriptor;
}

void OutputFile::write(std::string_view text) {
  if (text.empty()) return;
  if (gzwrite(file_.get(), text.data(), static_cast<unsigned>(text.size())) <= 0) fail(errno);
}

void OutputFile::close() {
  if (gzclose_w(file_.release()) != Z_OK) {
    const int reason = errno;
    discard();
    fail(reason);
  }
  if (!temporary_.empty()) {
    if (::fsync(descriptor_) != 0 || ::rename(temporary_.c_str(), target_.c_str()) != 0) {
      const int reason = errno;
      discard();
      fail(reason);
    }
    temporary_.clear();
    sync_folder_of(target_);
  }
  discard();
}

/// Gives back what is held; removes the unfinished file.
void OutputFile::discard() noexcept {
  file_.reset();
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
}

void OutputFile::fail(int error_number) const {
  throw FileError(name_ + ": cannot be written: " + std::generic_category().message(error_number));
}

}  // namespace gyrod::files
