#include "bus/bus_error.hpp"

#include <dds/dds.h>

namespace gyrod::bus {

BusError::BusError(const std::string& attempt, int dds_code)
    : std::runtime_error("DDS: cannot " + attempt + ": " + dds_strretcode(dds_code)) {}

}  // namespace gyrod::bus
