/// Writers and readers of gyrod's topics that do not match gyrod's own.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "bus/bus_options.hpp"
#include "bus/domain.hpp"

namespace gyrod::bus {

/// How many peers do not match now, of one kind.
struct PeerMismatch {
  std::string_view
      direction;  ///< "input": their writers and our readers; "output": our writers and their readers
  std::string_view policy;  ///< what they disagree on first: "type", "reliability", "deadline", ...
  std::size_t peers = 0;
};

/// Compares what discovery tells of others' writers and readers with this participant's own of the same topic and, where they disagree on type
/// or QoS, warns once of each, with the values of both sides and what to set (bus/log.hpp). DDS itself says nothing of a type, and of QoS not
/// who it is. Those in other partitions are let alone: they are apart on purpose.
///
/// Works on a thread of its own, only when something has appeared or gone, at most twice a second. Keeps track of some thousand peers and
/// warns of some hundred; beyond that it is a flood. The count is for any thread.
class MismatchWatch {
 public:
  /// @throws BusError where DDS refuses
  MismatchWatch(const Domain& domain, const BusOptions& options);
  ~MismatchWatch();
  MismatchWatch(const MismatchWatch&) = delete;
  MismatchWatch& operator=(const MismatchWatch&) = delete;

  /// Each kind there can be, most of them with no peers.
  [[nodiscard]] std::vector<PeerMismatch> mismatches() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyrod::bus
