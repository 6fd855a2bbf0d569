/// The file that keeps what was learned of the sensors' noise across restarts.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "settings/noise_state.hpp"

namespace gyrod::app {

/// Trouble with it never ends the daemon: it costs what was learned, no more. One thread at a time.
class NoiseStateFile {
 public:
  /// Takes one line for the log.
  using Warn = std::function<void(const std::string&)>;

  /// A larger file is not read: a sensor has about 1 KiB.
  static constexpr std::size_t kMostMebibytes = 128;

  /// @param path empty: nothing is read or written
  NoiseStateFile(std::string path, Warn warn);

  /// What the file holds. Nothing where there is no file, and, with a warning that names file, place and what was expected, where it is
  /// damaged (compressed text that is cut off, too) or of another version: then it is put aside under its name and ".damaged" (over one from before), so that saving
  /// does not destroy it. A file that cannot be read is warned about and stays;
  /// so is a folder that is not there.
  [[nodiscard]] settings::NoiseStates load();

  /// Replaces the file in one step: who reads it, after a power failure too, finds the old or the new one in full. Sensors that another
  /// daemon has put there meanwhile, or learned more of than this one since it last read or wrote the file, stay as they are there: shards may
  /// share a file. Waits a second at most while another one saves in the folder.
  /// Trouble is warned about once, until a save has worked again. @return whether it worked; true if there is nothing to do
  bool save(const settings::NoiseStates& states);

  /// Times it could not be saved. Any thread.
  [[nodiscard]] std::uint64_t errors() const noexcept { return errors_.load(std::memory_order_relaxed); }

 private:
  void require_folder();
  void put_aside(const std::string& reason);
  [[nodiscard]] settings::NoiseStates merged(const settings::NoiseStates& states) const;

  std::string path_;
  Warn warn_;
  settings::NoiseStates known_;  ///< of this daemon, when the file was last read or written
  bool in_trouble_ = false;
  std::atomic<std::uint64_t> errors_{0};
};

}  // namespace gyrod::app
