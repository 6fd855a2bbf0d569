/// What really goes over the loopback interface.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace gyrod::testing {

/// From its making on, collects the UDP datagrams on `lo` that are sent to the ports of one DDS domain, up to some 100 MB.
/// It reads a packet socket, as tcpdump does: that needs CAP_NET_RAW.
class WireCapture {
 public:
  explicit WireCapture(std::uint32_t domain);
  ~WireCapture();
  WireCapture(const WireCapture&) = delete;
  WireCapture& operator=(const WireCapture&) = delete;

  /// Whether this process may listen. If not, it hears nothing.
  [[nodiscard]] bool permitted() const noexcept { return socket_ >= 0; }
  [[nodiscard]] std::size_t bytes() const;
  /// Whether these bytes stood in any datagram.
  [[nodiscard]] bool contains(std::string_view bytes) const;

 private:
  void listen();

  std::uint32_t first_port_;
  int socket_;
  std::atomic<bool> stopping_{false};
  mutable std::mutex mutex_;
  std::string heard_;
  std::thread thread_;
};

}  // namespace gyrod::testing
