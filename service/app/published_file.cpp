#include "app/published_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <new>
#include <span>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "app/errors.hpp"
#include "stream/registry.hpp"

namespace gyrod::app {
namespace {

constexpr std::size_t kIdBytes = 72;  // 64 characters, and zeros to the end
constexpr std::uint64_t kMagic =
    0x31627570'64727967;  // "gyrdpub1" on a little-endian machine; no other reads the file

}  // namespace

struct PublishedFile::Header {
  std::uint64_t magic;
  std::uint64_t sensors;
};

struct PublishedFile::Slot {
  char sensor[kIdBytes];
  std::uint64_t sequence;
  std::int64_t stamp_ns;

  [[nodiscard]] std::string_view id() const noexcept {
    return {sensor, static_cast<std::size_t>(std::find(sensor, sensor + kIdBytes, '\0') - sensor)};
  }
};

PublishedFile::PublishedFile(std::string path, std::size_t sensors, const Warn& warn)
    : path_(std::move(path)), sensors_(sensors) {
  if (path_.empty()) return;
  open(sizeof(Header) + sensors * sizeof(Slot));
  if (!read()) {
    const bool is_new = static_cast<const Header*>(memory_)->magic == 0;
    if (!is_new) warn(path_ + " is damaged, or for another number of sensors; begun anew");
    begin_anew();
  }
  remembered_ = before_.size();
}

PublishedFile::~PublishedFile() {
  if (memory_ != nullptr) munmap(memory_, bytes_);
  if (descriptor_ >= 0) close(descriptor_);
}

void PublishedFile::fail(const std::string& what) const {
  const std::string reason = std::generic_category().message(errno);
  if (descriptor_ >= 0) close(descriptor_);
  throw Unavailable("restart.published_file " + path_ + ": " + what + ": " + reason);
}

void PublishedFile::open(std::size_t bytes) {
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0) fail("cannot be opened for writing");
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) fail("expected a file of this daemon alone");
  struct stat status {};
  if (fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) fail("expected a regular file");
  if (ftruncate(descriptor_, static_cast<off_t>(bytes)) != 0) fail("cannot be sized");
  // A full device is told of now, not by a signal in the middle of the work.
  errno = posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes));
  if (errno != 0) fail("no room for " + std::to_string(bytes) + " bytes");
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0);
  if (memory == MAP_FAILED) fail("cannot be mapped");
  memory_ = memory;
  bytes_ = bytes;
}

/// @return false if the file is new, damaged or of another size
bool PublishedFile::read() {
  const auto* header = static_cast<const Header*>(memory_);
  if (header->magic != kMagic || header->sensors != sensors_) return false;
  const std::span<Slot> slots(reinterpret_cast<Slot*>(static_cast<char*>(memory_) + sizeof(Header)),
                              sensors_);
  for (Slot& slot : slots) {
    if (slot.id().empty()) continue;
    if (!stream::is_valid_sensor_id(slot.id())) return false;
    before_.emplace(slot.id(), stream::PublishedMark{slot.sequence, slot.stamp_ns});
    free_.push_back(&slot);  // given away last
  }
  for (Slot& slot : slots) {
    if (slot.id().empty()) free_.push_back(&slot);
  }
  return true;
}

void PublishedFile::begin_anew() noexcept {
  before_.clear();
  free_.clear();
  std::memset(memory_, 0, bytes_);
  *static_cast<Header*>(memory_) = {kMagic, sensors_};
  const std::span<Slot> slots(reinterpret_cast<Slot*>(static_cast<char*>(memory_) + sizeof(Header)),
                              sensors_);
  for (Slot& slot : slots) free_.push_back(&slot);
}

std::optional<stream::PublishedMark> PublishedFile::take_before(std::string_view sensor) {
  const std::lock_guard lock(mutex_);
  const auto found = before_.find(sensor);
  if (found == before_.end()) return std::nullopt;
  const stream::PublishedMark mark = found->second;
  before_.erase(found);
  return mark;
}

void PublishedFile::note(std::string_view sensor, const stream::DenoisedSample& newest) noexcept {
  if (memory_ == nullptr) return;
  const std::lock_guard lock(mutex_);
  Slot* slot = slot_for(sensor);
  if (slot == nullptr) return;
  // Killed between the two, the stamp is the older one: at worst samples are published twice.
  slot->sequence = newest.sequence;
  slot->stamp_ns = newest.stamp_ns;
}

/// The sensor's place; one that is free, else that of a sensor that has not been seen since the start. None where there is none.
PublishedFile::Slot* PublishedFile::slot_for(std::string_view sensor) noexcept {
  if (const auto found = slots_.find(sensor); found != slots_.end()) return found->second;
  const auto own = std::ranges::find_if(free_, [sensor](const Slot* slot) { return slot->id() == sensor; });
  const auto taken = own != free_.end() || free_.empty() ? own : free_.end() - 1;
  if (taken == free_.end()) return nullptr;
  Slot* slot = *taken;
  try {
    slots_.emplace(sensor, slot);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
  free_.erase(taken);
  *slot = {};
  std::ranges::copy(sensor, slot->sensor);
  return slot;
}

void PublishedFile::forget(std::string_view sensor) noexcept {
  if (memory_ == nullptr) return;
  const std::lock_guard lock(mutex_);
  const auto found = slots_.find(sensor);
  if (found == slots_.end()) return;
  *found->second = {};
  free_.push_back(found->second);
  slots_.erase(found);
}

}  // namespace gyrod::app
