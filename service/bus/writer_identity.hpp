/// What a writer is known by, and what it says of itself. Internal to bus/.
#pragma once

#include <string>
#include <vector>

#include <dds/dds.h>

namespace gyrod::bus {

/// 32 hex digits.
[[nodiscard]] std::string text_of(const dds_guid_t& guid);
/// @throws BusError
[[nodiscard]] std::string guid_of(dds_entity_t writer);

/// The partitions, sorted; none at all is the one without a name.
[[nodiscard]] std::vector<std::string> place_of(const dds_qos_t* qos);
/// @throws BusError
[[nodiscard]] std::vector<std::string> place_of(dds_entity_t writer);

/// Empty where there is none.
[[nodiscard]] std::string user_data_of(const dds_qos_t* qos);

}  // namespace gyrod::bus
