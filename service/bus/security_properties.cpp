#include "bus/security_properties.hpp"

#include <array>
#include <utility>

#include "bus/security_files.hpp"

namespace gyrod::bus {
namespace {

/// The plugins that come with Cyclone DDS, which looks for them beside itself.
constexpr std::array<std::pair<const char*, const char*>, 9> kPlugins = {
    {{"dds.sec.auth.library.path", "dds_security_auth"},
     {"dds.sec.auth.library.init", "init_authentication"},
     {"dds.sec.auth.library.finalize", "finalize_authentication"},
     {"dds.sec.access.library.path", "dds_security_ac"},
     {"dds.sec.access.library.init", "init_access_control"},
     {"dds.sec.access.library.finalize", "finalize_access_control"},
     {"dds.sec.crypto.library.path", "dds_security_crypto"},
     {"dds.sec.crypto.library.init", "init_crypto"},
     {"dds.sec.crypto.library.finalize", "finalize_crypto"}}};

}  // namespace

SecurityProperties::SecurityProperties(const std::string& folder) {
  if (folder.empty()) return;
  qos_.reset(dds_create_qos());
  for (const auto& [name, value] : kPlugins) dds_qset_prop(qos_.get(), name, value);
  const auto add = [this](const char* name, const std::string& file) {
    if (!file.empty()) dds_qset_prop(qos_.get(), name, ("file:" + file).c_str());
  };
  const SecurityFiles files = security_files(folder);
  add("dds.sec.auth.identity_ca", files.identity_ca);
  add("dds.sec.auth.identity_certificate", files.certificate);
  add("dds.sec.auth.private_key", files.private_key);
  add("dds.sec.access.permissions_ca", files.permissions_ca);
  add("dds.sec.access.governance", files.governance);
  add("dds.sec.access.permissions", files.permissions);
  add("org.eclipse.cyclonedds.sec.auth.crl", files.revocation_list);
}

}  // namespace gyrod::bus
