/// Messages lent by a reader. Internal to bus/.
#pragma once

#include <array>
#include <cstddef>

#include <dds/dds.h>

namespace gyrod::bus {

/// Messages taken at once; more only delay what they are for.
inline constexpr std::size_t kMaxLoan = 256;

/// Up to kMaxLoan messages taken out of a reader's cache. Their memory is the reader's and goes back when
/// this goes. At most one a reader at a time: a second would make the middleware allocate.
template <class Message>
class Loan {
 public:
  /// Takes what the cache holds, of all sensors.
  explicit Loan(dds_entity_t reader) noexcept : reader_(reader) {
    size_ = count(dds_take(reader, messages_.data(), infos_.data(), kMaxLoan, kMaxLoan));
  }
  /// Takes what the cache holds of one sensor.
  Loan(dds_entity_t reader, dds_instance_handle_t sensor) noexcept : reader_(reader) {
    size_ = count(dds_take_instance(reader, messages_.data(), infos_.data(), kMaxLoan, kMaxLoan, sensor));
  }
  ~Loan() {
    if (size_ > 0) (void)dds_return_loan(reader_, messages_.data(), static_cast<std::int32_t>(size_));
  }
  Loan(const Loan&) = delete;
  Loan& operator=(const Loan&) = delete;

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Only the key is set unless info(i).valid_data. @pre i < size()
  [[nodiscard]] const Message& message(std::size_t i) const noexcept {
    return *static_cast<const Message*>(messages_[i]);
  }
  [[nodiscard]] const dds_sample_info_t& info(std::size_t i) const noexcept { return infos_[i]; }

 private:
  /// An error of a take leaves nothing to hand over and nothing to return.
  static std::size_t count(dds_return_t taken) noexcept {
    return taken > 0 ? static_cast<std::size_t>(taken) : 0;
  }

  dds_entity_t reader_;
  std::size_t size_ = 0;
  std::array<void*, kMaxLoan> messages_{};  // the first null pointer asks for a loan
  // Filled by the take; not set before, to save 20 kB of zeros a take.
  std::array<dds_sample_info_t, kMaxLoan> infos_;
};

}  // namespace gyrod::bus
