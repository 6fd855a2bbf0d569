#include "app/noise_state_file.hpp"

#include <chrono>
#include <fcntl.h>
#include <filesystem>
#include <sys/file.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

#include "files/file_error.hpp"
#include "files/output_file.hpp"
#include "settings/text_file.hpp"

namespace gyrod::app {
namespace {

namespace fs = std::filesystem;

/// Another daemon's save takes milliseconds; who holds the folder for longer than this has been stopped.
constexpr int kLockTries = 50;
constexpr auto kBetweenTries = std::chrono::milliseconds(20);

/// One daemon at a time in a folder, from here to the end of the scope; where the folder cannot be opened or nobody lets go of it, no lock.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& file)
      : descriptor_(::open(file.has_parent_path() ? file.parent_path().c_str() : ".",
                           O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    for (int left = kLockTries; descriptor_ >= 0 && left > 0; --left) {
      if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
      std::this_thread::sleep_for(kBetweenTries);
    }
  }
  ~FolderLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace

NoiseStateFile::NoiseStateFile(std::string path, Warn warn)
    : path_(std::move(path)), warn_(std::move(warn)) {}

settings::NoiseStates NoiseStateFile::load() {
  if (path_.empty()) return {};
  const settings::TextFile read = settings::read_text_file(path_, kMostMebibytes);
  if (read.missing) {
    require_folder();
    return {};
  }
  if (read.damaged) {
    put_aside(path_ + ": " + read.trouble);
    return {};
  }
  if (!read.trouble.empty()) {
    warn_(path_ + ": " + read.trouble + "; noise is learned anew");
    return {};
  }
  try {
    known_ = settings::parse_noise_state(path_, read.text);
    return known_;
  } catch (const settings::NoiseFileError& error) {
    put_aside(error.what());
    return {};
  }
}

/// So that a misspelt path is known at the start, and not when an hour's learning is to be kept.
void NoiseStateFile::require_folder() {
  const fs::path folder = fs::path(path_).parent_path();
  std::error_code error;
  if (folder.empty() || fs::is_directory(folder, error)) return;
  in_trouble_ = true;
  warn_("noise.state_file is " + path_ + ", and " + folder.string() +
        " is no folder; learned noise is not kept across a restart");
}

void NoiseStateFile::put_aside(const std::string& reason) {
  const std::string aside = path_ + ".damaged";
  std::error_code error;
  fs::rename(path_, aside, error);
  warn_(reason + "; noise is learned anew, " +
        (error ? "the file could not be put aside: " + error.message() : "the file is kept as " + aside));
}

/// What the file holds by now, with what has changed here since it was last read or written. What cannot be read any more is replaced.
settings::NoiseStates NoiseStateFile::merged(const settings::NoiseStates& states) const {
  settings::NoiseStates all = states;
  try {
    const settings::TextFile read = settings::read_text_file(path_, kMostMebibytes);
    if (!read.trouble.empty()) return all;
    for (auto& [sensor, there] : settings::parse_noise_state(path_, read.text)) {
      const auto known = known_.find(sensor);
      const auto here = states.find(sensor);
      const bool changed_here =
          here != states.end() && (known == known_.end() || here->second != known->second);
      if (!changed_here) all[sensor] = there;
    }
  } catch (const settings::NoiseFileError&) {
    return states;
  }
  return all;
}

bool NoiseStateFile::save(const settings::NoiseStates& states) {
  if (path_.empty()) return true;
  try {
    const FolderLock lock(path_);
    files::OutputFile file(path_);
    file.write(settings::noise_state_text(merged(states)));
    file.close();
    known_ = states;
    in_trouble_ = false;
  } catch (const files::FileError& error) {
    errors_.fetch_add(1, std::memory_order_relaxed);
    if (!std::exchange(in_trouble_, true))
      warn_(std::string(error.what()) + "; learned noise is not kept across a restart");
  }
  return !in_trouble_;
}

}  // namespace gyrod::app
