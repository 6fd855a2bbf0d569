/// Up to which sample each sensor has been published: kept across a restart, also one by kill -9.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stream/sample.hpp"

namespace gyrod::app {

/// A small file in memory that the process shares with the system (mmap): to note a sample is to write two numbers, and they stay when
/// the process is killed. After a power failure older numbers may be found, or none; then samples are published twice, none is lost.
/// Any thread. Allocates for a new sensor only.
class PublishedFile {
 public:
  /// Takes one line for the log.
  using Warn = std::function<void(const std::string&)>;

  /// Reads what the file holds and goes on with it. A damaged file, or one for another number of sensors, is begun anew; the former with
  /// a warning. @param path empty: nothing is kept. @param sensors that find room
  /// @throws Unavailable where it cannot be written, has no room on its device, or is another process's
  PublishedFile(std::string path, std::size_t sensors, const Warn& warn);
  ~PublishedFile();
  PublishedFile(const PublishedFile&) = delete;
  PublishedFile& operator=(const PublishedFile&) = delete;

  /// The newest sample of the sensor that was published before this start. Answers once: what comes back later has been seen since.
  [[nodiscard]] std::optional<stream::PublishedMark> take_before(std::string_view sensor);

  /// The sample has been published. Where all places are taken by sensors of this run it is not kept.
  void note(std::string_view sensor, const stream::DenoisedSample& newest) noexcept;

  /// The sensor has ended: its next samples are new ones.
  void forget(std::string_view sensor) noexcept;

  /// Sensors that were published before this start.
  [[nodiscard]] std::size_t remembered() const noexcept { return remembered_; }

 private:
  struct Slot;
  struct Header;

  void open(std::size_t bytes);
  [[nodiscard]] bool read();
  void begin_anew() noexcept;
  [[nodiscard]] Slot* slot_for(std::string_view sensor) noexcept;
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  std::size_t sensors_;
  int descriptor_ = -1;
  void* memory_ = nullptr;
  std::size_t bytes_ = 0;
  std::size_t remembered_ = 0;
  std::mutex mutex_;
  std::map<std::string, stream::PublishedMark, std::less<>> before_;
  std::map<std::string, Slot*, std::less<>> slots_;  ///< of sensors of this run
  std::vector<Slot*> free_;                          ///< empty ones last, to be taken first
};

}  // namespace gyrod::app
