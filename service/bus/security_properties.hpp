/// What a DDS participant is told about security. Internal to bus/: includes Cyclone's headers.
#pragma once

#include <memory>
#include <string>

#include <dds/dds.h>

namespace gyrod::bus {

/// The quality of service of a participant that uses the built-in plugins of DDS Security with these files.
class SecurityProperties {
 public:
  /// @param folder see bus/security_files.hpp; empty: no security
  explicit SecurityProperties(const std::string& folder);

  /// Null without security.
  [[nodiscard]] const dds_qos_t* get() const noexcept { return qos_.get(); }

 private:
  struct Delete {
    void operator()(dds_qos_t* qos) const noexcept { dds_delete_qos(qos); }
  };
  std::unique_ptr<dds_qos_t, Delete> qos_;
};

}  // namespace gyrod::bus
