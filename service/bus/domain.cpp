#include "bus/domain.hpp"

#include <chrono>
#include <map>
#include <mutex>
#include <utility>

#include "bus/entity.hpp"
#include "bus/log.hpp"
#include "bus/network_config.hpp"
#include "bus/security_error.hpp"
#include "bus/security_properties.hpp"

namespace gyrod::bus {
namespace {

/// Beyond it the ports of RTPS leave the 16 bits of UDP (7400 + 250 * id).
constexpr std::uint32_t kMaxDomainId = 230;

/// A domain of this process and how many Domain objects stand on it.
struct OpenDomain {
  Entity entity;
  std::string network;
  std::string security_folder;
  int users = 0;
};

// Process-wide, because the middleware's domains are.
std::mutex open_domains_mutex;
std::map<std::uint32_t, OpenDomain> open_domains;

/// "open domain 7 on network 'x.xml'", followed by what the middleware said about it.
std::string attempt_text(const char* verb, std::uint32_t id, const std::string& network,
                         const LogCapture& log) {
  const std::string attempt = verb + (" domain " + std::to_string(id)) + " on network '" + network + "'";
  return log.text().empty() ? attempt : attempt + " (" + log.text() + ")";
}

Entity create_domain(std::uint32_t id, const std::string& network, Calling calling) {
  const std::string config = network_config(network, calling);
  const LogCapture log;
  const dds_entity_t created = dds_create_domain(id, config.c_str());
  Entity domain(created, attempt_text("open", id, network, log));
  // Acts on the domains that exist and must come before their writers.
  dds_write_set_batch(true);
  return domain;
}

void acquire(std::uint32_t id, const std::string& network, const std::string& security_folder,
             Calling calling) {
  if (id > kMaxDomainId) {
    throw BusError("DDS domain id " + std::to_string(id) + ": expected 0.." + std::to_string(kMaxDomainId));
  }
  const std::lock_guard lock(open_domains_mutex);
  auto found = open_domains.find(id);
  if (found == open_domains.end()) {
    found =
        open_domains.emplace(id, OpenDomain{create_domain(id, network, calling), network, security_folder})
            .first;
  } else if (found->second.network != network) {
    throw BusError("DDS domain " + std::to_string(id) + " is open on network '" + found->second.network +
                   "' in this process; expected the same and not '" + network + "'");
  } else if (found->second.security_folder != security_folder) {
    // The middleware has one set of security plugins a domain.
    throw BusError("DDS domain " + std::to_string(id) + " is open with security files in '" +
                   found->second.security_folder + "' in this process; expected the same and not '" +
                   security_folder + "'");
  }
  ++found->second.users;
}

void release(std::uint32_t id) noexcept {
  // Deleted under the lock, so that a new Domain of this id never meets a half-closed one.
  const std::lock_guard lock(open_domains_mutex);
  const auto found = open_domains.find(id);
  if (--found->second.users == 0) open_domains.erase(found);
}

}  // namespace

class Domain::Impl {
 public:
  Impl(std::uint32_t id, const std::string& network, const std::string& security_folder, Calling calling)
      : identity_(identity_in(security_folder)), membership_(id, network, security_folder, calling) {
    const LogCapture log;
    const SecurityProperties security(security_folder);
    const dds_entity_t created = dds_create_participant(id, security.get(), nullptr);
    if (identity_ && (created == DDS_RETCODE_ERROR || created == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY)) {
      throw SecurityError(security_folder, "'" + identity_->subject + "' is not let into domain " +
                                               std::to_string(id) + " (" + log.text() +
                                               "); expected governance and permissions that cover it now");
    }
    participant_ = Entity(created, attempt_text("join", id, network, log));
  }

  [[nodiscard]] dds_entity_t participant() const noexcept { return participant_.get(); }
  [[nodiscard]] const std::optional<Identity>& identity() const noexcept { return identity_; }

 private:
  static std::optional<Identity> identity_in(const std::string& security_folder) {
    if (security_folder.empty()) return std::nullopt;
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    return check_security(security_files(security_folder), now);
  }

  struct Membership {
    Membership(std::uint32_t domain_id, const std::string& network, const std::string& security_folder,
               Calling calling)
        : id(domain_id) {
      acquire(id, network, security_folder, calling);
    }
    ~Membership() { release(id); }
    Membership(const Membership&) = delete;
    Membership& operator=(const Membership&) = delete;
    std::uint32_t id;
  };

  std::optional<Identity> identity_;
  Membership membership_;  // outlives the participant
  Entity participant_;
};

Domain::Domain(std::uint32_t id, const std::string& network, const std::string& security_folder,
               Calling calling)
    : impl_(std::make_shared<const Impl>(id, network, security_folder, calling)) {}

std::int32_t Domain::participant() const noexcept { return impl_->participant(); }
const std::optional<Identity>& Domain::identity() const noexcept { return impl_->identity(); }

}  // namespace gyrod::bus
