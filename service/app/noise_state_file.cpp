#include "app/noise_state_file.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include "files/file_error.hpp"
#include "files/output_file.hpp"
#include "settings/text_file.hpp"

namespace gyrod::app {
namespace {

namespace fs = std::filesystem;

}  // namespace

NoiseStateFile::NoiseStateFile(std::string path, Warn warn)
    : path_(std::move(path)), warn_(std::move(warn)) {}

settings::NoiseStates NoiseStateFile::load() {
  if (path_.empty()) return {};
  const settings::TextFile read = settings::read_text_file(path_, kMostMebibytes);
  if (read.missing) return {};
  if (!read.trouble.empty()) {
    warn_(path_ + ": " + read.trouble + "; noise is learned anew");
    return {};
  }
  try {
    return settings::parse_noise_state(path_, read.text);
  } catch (const settings::NoiseFileError& error) {
    put_aside(error.what());
    return {};
  }
}

void NoiseStateFile::put_aside(const std::string& reason) {
  const std::string aside = path_ + ".damaged";
  std::error_code error;
  fs::rename(path_, aside, error);
  warn_(reason + "; noise is learned anew, " +
        (error ? "the file could not be put aside: " + error.message() : "the file is kept as " + aside));
}

bool NoiseStateFile::save(const settings::NoiseStates& states) {
  if (path_.empty()) return true;
  try {
    files::OutputFile file(path_);
    file.write(settings::noise_state_text(states));
    file.close();
    in_trouble_ = false;
  } catch (const files::FileError& error) {
    errors_.fetch_add(1, std::memory_order_relaxed);
    if (!std::exchange(in_trouble_, true))
      warn_(std::string(error.what()) + "; learned noise is not kept across a restart");
  }
  return !in_trouble_;
}

}  // namespace gyrod::app
