/// Ownership of a DDS entity. Internal to bus/: includes Cyclone's headers.
#pragma once

#include <string>
#include <utility>

#include <dds/dds.h>

#include "bus/bus_error.hpp"
#include "bus/security_error.hpp"

namespace gyrod::bus {

/// Owns one DDS entity and deletes it with all its children. Move-only. As thread-safe as the entity itself.
class Entity {
 public:
  Entity() = default;
  /// Takes over what a dds_create_ function returned.
  /// @throws BusError if that is an error code; SecurityError if our permissions forbid it
  Entity(dds_entity_t created, const std::string& attempt) : handle_(created) {
    if (created == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY)
      throw SecurityError("not allowed to " + attempt + "; expected permissions.p7s to have a rule for it");
    if (created < 0) throw BusError(attempt, created);
  }
  ~Entity() { reset(); }
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&& other) noexcept {
    if (this != &other) {
      reset();
      handle_ = std::exchange(other.handle_, 0);
    }
    return *this;
  }

  [[nodiscard]] dds_entity_t get() const noexcept { return handle_; }

 private:
  void reset() noexcept {
    // An error can only mean that a parent has taken this child along.
    if (handle_ > 0) (void)dds_delete(std::exchange(handle_, 0));
  }

  dds_entity_t handle_ = 0;
};

/// @throws BusError if `result` is an error code
inline void check(dds_return_t result, const std::string& attempt) {
  if (result < 0) throw BusError(attempt, result);
}

}  // namespace gyrod::bus
