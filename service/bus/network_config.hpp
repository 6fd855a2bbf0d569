/// From BusOptions::network to what Cyclone DDS is configured with. Internal to bus/.
#pragma once

#include <string>

#include "bus/calling.hpp"

namespace gyrod::bus {

/// The configuration text for dds_create_domain().
/// @param network "loopback", "default" or a path, see BusOptions::network
/// @throws BusError naming the file, if it cannot be read or is not XML
[[nodiscard]] std::string network_config(const std::string& network, Calling calling);

}  // namespace gyrod::bus
