/// Who a participant is, in words. Internal to bus/: includes Cyclone's headers.
#pragma once

#include <string>
#include <string_view>

#include <dds/dds.h>

#include "bus/domain.hpp"

namespace gyrod::bus {

/// What others tell, as far as it is plain text, and not at length: their words must not make lines of a log.
[[nodiscard]] std::string printable(std::string_view text);

/// E.g. "'imu_driver' (process 4242 on car1)", as far as the participant tells; else "participant 0110a3...". Looks it up with a reader made
/// for it: seldom, and nothing of participants that come and go stays.
[[nodiscard]] std::string name_of_participant(const Domain& domain, const dds_guid_t& participant);

}  // namespace gyrod::bus
