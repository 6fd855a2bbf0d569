/// Programs that DDS Security keeps out.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bus/domain.hpp"

namespace gyrod::bus {

/// Looks at what discovery has found, since the middleware itself says little of those that it does not let in: of a program without
/// DDS Security nothing at all, and of one with a bad certificate or without a grant only one of the two sides hears why.
///
/// A participant's id tells whether it has an identity (DDS-Security 1.1, 9.3.3: its first bit is set). One that has none is kept out for sure. One that has is let in
/// as soon as a topic of it is known; if that takes longer than kPatience it is told as one that was most likely refused.
///
/// Bounded: at most kMostPeers are remembered. One thread looks; refused() is for any.
class PeerWatch {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kPatience{10};
  static constexpr std::size_t kMostPeers = 1024;

  /// @param domain with an identity @throws BusError
  explicit PeerWatch(const Domain& domain);
  ~PeerWatch();
  PeerWatch(const PeerWatch&) = delete;
  PeerWatch& operator=(const PeerWatch&) = delete;

  /// To be called about once a second. @return a line for each peer that is found to be kept out, once each
  [[nodiscard]] std::vector<std::string> look(Clock::time_point now);

  /// Peers told so far.
  [[nodiscard]] std::uint64_t refused() const noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyrod::bus
