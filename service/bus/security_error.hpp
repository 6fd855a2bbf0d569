/// What is thrown when DDS Security is asked for and cannot be had.
#pragma once

#include <string>

#include "bus/bus_error.hpp"

namespace gyrod::bus {

/// A certificate, a key, or what permissions say. Names the file, what is in it, and what was expected.
class SecurityError : public BusError {
 public:
  explicit SecurityError(const std::string& message) : BusError("DDS Security: " + message) {}
  SecurityError(const std::string& file, const std::string& trouble)
      : SecurityError("'" + file + "': " + trouble) {}
};

}  // namespace gyrod::bus
