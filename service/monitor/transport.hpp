/// The bytes between gyrod and one client.
#pragma once

#include <cstddef>
#include <cstdint>
#include <poll.h>
#include <span>
#include <string_view>
#include <utility>

#include "monitor/socket.hpp"
#include "monitor/tls.hpp"

namespace gyrod::monitor {

/// What became of an attempt to move bytes.
struct Transfer {
  std::size_t bytes = 0;
  /// The client has ended its side (reading), is gone, or broke the protocol: nothing comes any more.
  bool ended = false;
};

/// Never waits: what cannot be moved at once is for the next time that the socket is ready. One thread.
class Transport {
 public:
  /// @param socket connected and non-blocking
  /// @param tls for that socket; none: without
  explicit Transport(Socket socket, Ssl tls = nullptr) noexcept
      : socket_(std::move(socket)), tls_(std::move(tls)) {}

  [[nodiscard]] Transfer read(std::span<char> bytes) noexcept;
  [[nodiscard]] Transfer write(std::string_view bytes) noexcept;
  /// Tells the client that no more comes, while it may still send.
  void end_writing() noexcept;
  /// Whether little enough of what was written is still on this machine.
  [[nodiscard]] bool is_writable() const noexcept;
  /// What to poll for before reading (POLLIN), writing (POLLOUT), or either.
  [[nodiscard]] pollfd waits_for(short events) const noexcept;
  /// Whether the client has begun to agree on TLS, and is not done.
  [[nodiscard]] bool is_shaking_hands() const noexcept;
  /// All that has come, the handshake included.
  [[nodiscard]] std::uint64_t received_bytes() const noexcept;
  /// Caps what the system holds for a client that does not read, and how long for one that is gone.
  void limit_unsent() noexcept;

 private:
  [[nodiscard]] Transfer outcome(int result, std::size_t bytes) noexcept;

  Socket socket_;
  Ssl tls_;  ///< gone before the socket
  std::uint64_t received_ = 0;
  bool broken_ = false;
  short blocked_on_ = 0;  ///< what TLS waits for, be it to read or to write
};

}  // namespace gyrod::monitor
