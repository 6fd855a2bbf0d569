/// A TCP socket as an owned file descriptor, and the listening one.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

namespace gyrod::monitor {

/// Owns a file descriptor; -1 is none.
class Socket {
 public:
  Socket() = default;
  explicit Socket(int descriptor) noexcept : descriptor_(descriptor) {}
  ~Socket();
  Socket(Socket&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Socket& operator=(Socket&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }

  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
  explicit operator bool() const noexcept { return descriptor_ >= 0; }

 private:
  int descriptor_ = -1;
};

/// Listens on address and port without blocking in accept(). Another process on the same port is an error,
/// never a sharing.
/// @param port 0 takes a free one
/// @throws std::runtime_error with address, port and reason, e.g. "port 9464 on 127.0.0.1 is in use"
[[nodiscard]] Socket listen_on(const std::string& address, std::uint16_t port);

/// A client's connection.
struct Accepted {
  Socket socket;
  /// As a number in text; of IPv6 the first 64 bits, which one customer or machine has.
  std::string address;
};

/// The next client that waits. @return no socket, with errno set, if there is none
[[nodiscard]] Accepted accept_from(const Socket& listener);

/// The port that a listening socket has.
[[nodiscard]] std::uint16_t port_of(const Socket& listener);

}  // namespace gyrod::monitor
