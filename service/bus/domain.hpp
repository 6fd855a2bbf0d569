/// Membership in a DDS domain.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace gyrod::bus {

/// Joins a DDS domain on a network that gyrod's own settings choose. What is made from a Domain (Subscriber,
/// Publisher, ...) holds a copy, so that objects may die in any order. Copies are cheap and are one DDS
/// participant.
///
/// One process is in a domain on one network: a second Domain with the same id and network shares the first
/// one's middleware (and talks to it without the network); with another network it is refused. Thread-safe.
class Domain {
 public:
  /// Also switches the middleware's write batching on for this domain's writers: every writer in bus/ flushes
  /// by itself.
  /// @param id       0..230
  /// @param network  as BusOptions::network
  /// @throws BusError for a bad id, file, XML element or interface (named), or a domain that is open on
  /// another network
  Domain(std::uint32_t id, const std::string& network);

  /// The DDS participant's handle. For the other classes of bus/.
  [[nodiscard]] std::int32_t participant() const noexcept;

 private:
  class Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace gyrod::bus
