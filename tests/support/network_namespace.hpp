/// Several hosts on one machine, for tests: network namespaces on a bridge that nothing else is connected to.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "support/process.hpp"
#include "support/scratch_folder.hpp"

namespace gyrod::testing {

/// Hosts 1, 2, ... with the addresses 10.77.0.1, 10.77.0.2, ... on eth0, and lo. They and the bridge have no names, so that nothing of
/// them is seen outside, and they are gone with this object or, however it ends, with the test's process.
class TestNetwork {
 public:
  /// Needs root and the program `ip` (iproute2). @return why it cannot be had; empty if it can
  [[nodiscard]] static std::string why_not();

  /// @throws std::runtime_error with what `ip` said
  explicit TestNetwork(std::size_t hosts);
  ~TestNetwork();
  TestNetwork(const TestNetwork&) = delete;
  TestNetwork& operator=(const TestNetwork&) = delete;

  /// Runs the function on a thread that is on this host, and waits for it. What it throws is thrown here. Processes that it starts are
  /// on the host, too.
  void on(std::size_t host, const std::function<void()>& function) const;

  /// Unplugs the host, or plugs it in again: its eth0 goes down or up, as if by its own administrator.
  void set_link(std::size_t host, bool up) const;

 private:
  class Namespace;
  void run_ip(const Namespace& where, const std::string& script) const;

  ScratchFolder folder_;
  std::unique_ptr<Namespace> bridge_;
  std::vector<std::unique_ptr<Namespace>> hosts_;
};

}  // namespace gyrod::testing
