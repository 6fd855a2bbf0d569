#include "support/wire_capture.hpp"

#include <arpa/inet.h>
#include <linux/if_packet.h>
#include <net/ethernet.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <vector>

namespace gyrod::testing {
namespace {

constexpr std::size_t kMostBytes = 100'000'000;

int open_socket() {
  const int opened = socket(AF_PACKET, SOCK_DGRAM | SOCK_CLOEXEC, htons(ETH_P_IP));
  if (opened < 0) return -1;
  sockaddr_ll address{};
  address.sll_family = AF_PACKET;
  address.sll_protocol = htons(ETH_P_IP);
  address.sll_ifindex = static_cast<int>(if_nametoindex("lo"));
  constexpr int kBuffer = 32 << 20;
  (void)setsockopt(opened, SOL_SOCKET, SO_RCVBUFFORCE, &kBuffer, sizeof kBuffer);
  if (bind(opened, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) return opened;
  close(opened);
  return -1;
}

/// The payload of a UDP datagram to one of a domain's ports (RTPS: 250 a domain), or nothing.
std::string_view payload_of(std::string_view packet, std::uint32_t first_port) {
  constexpr std::size_t kUdpHeader = 8;
  constexpr char kUdp = 17;
  if (packet.size() < 20 || packet[9] != kUdp) return {};
  const std::size_t header = static_cast<std::size_t>(packet[0] & 0x0f) * 4;
  if (packet.size() < header + kUdpHeader) return {};
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(packet[header + i]));
  };
  const std::uint32_t port = byte(2) << 8U | byte(3);
  if (port < first_port || port >= first_port + 250) return {};
  return packet.substr(header + kUdpHeader);
}

}  // namespace

WireCapture::WireCapture(std::uint32_t domain) : first_port_(7400 + 250 * domain), socket_(open_socket()) {
  if (permitted()) thread_ = std::thread([this] { listen(); });
}

WireCapture::~WireCapture() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
  if (permitted()) close(socket_);
}

void WireCapture::listen() {
  std::vector<char> packet(1 << 17);
  while (!stopping_) {
    pollfd ready{socket_, POLLIN, 0};
    if (poll(&ready, 1, 20) <= 0) continue;
    const ssize_t size = recv(socket_, packet.data(), packet.size(), 0);
    if (size <= 0) continue;
    const std::string_view payload = payload_of({packet.data(), static_cast<std::size_t>(size)}, first_port_);
    const std::lock_guard lock(mutex_);
    if (heard_.size() + payload.size() < kMostBytes) heard_ += payload;
  }
}

std::size_t WireCapture::bytes() const {
  const std::lock_guard lock(mutex_);
  return heard_.size();
}

bool WireCapture::contains(std::string_view bytes) const {
  const std::lock_guard lock(mutex_);
  return heard_.find(bytes) != std::string::npos;
}

}  // namespace gyrod::testing
