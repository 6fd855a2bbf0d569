/// Membership in a DDS domain.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "bus/calling.hpp"
#include "bus/security_check.hpp"

namespace gyrod::bus {

/// Joins a DDS domain on a network that gyrod's own settings choose. What is made from a Domain (Subscriber,
/// Publisher, ...) holds a copy, so that objects may die in any order. Copies are cheap and are one DDS
/// participant.
///
/// One process is in a domain on one network: a second Domain with the same id and network shares the first
/// one's middleware (and talks to it without the network); with another network or other security files it is refused.
/// Thread-safe.
class Domain {
 public:
  /// Also switches the middleware's write batching on for this domain's writers: every writer in bus/ flushes
  /// by itself.
  /// @param id       0..230
  /// @param network  as BusOptions::network
  /// @param security_folder  DDS Security with these files (bus/security_files.hpp); empty: without, unless the network's XML file
  /// asks for it
  /// @param calling  of no effect where the domain is open already
  /// @throws BusError for a bad id, file, XML element or interface (named), or a domain that is open on
  /// another network; SecurityError for what is wrong with the security files, or where they do not let us in
  Domain(std::uint32_t id, const std::string& network, const std::string& security_folder = {},
         Calling calling = Calling::kUsual);

  /// The DDS participant's handle. For the other classes of bus/.
  [[nodiscard]] std::int32_t participant() const noexcept;

  /// Who we are in the domain; nothing without a security folder.
  [[nodiscard]] const std::optional<Identity>& identity() const noexcept;

 private:
  class Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace gyrod::bus
