#include "monitor/socket.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <memory>
#include <netdb.h>
#include <netinet/in.h>
#include <stdexcept>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>

namespace gyrod::monitor {
namespace {

/// Clients that may wait to be accepted; more are made to try again by TCP.
constexpr int kBacklog = 1024;

using AddressList = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

std::string reason_words(int error) {
  if (error == EADDRINUSE) return "is in use";
  if (error == EADDRNOTAVAIL) return "cannot be taken: this machine has no such address";
  if (error == EACCES) return "cannot be taken: ports below 1024 need a privilege";
  return "cannot be taken: " + std::generic_category().message(error);
}

AddressList resolve(const std::string& address, std::uint16_t port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(address.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (error != 0) {
    throw std::runtime_error("cannot listen on \"" + address + "\": " + gai_strerror(error) +
                             "; expected an address or host name of this machine");
  }
  return {found, &freeaddrinfo};
}

/// @return no socket, with errno set, if one of the steps fails
Socket try_listen(const addrinfo& address) {
  Socket socket(
      ::socket(address.ai_family, address.ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, address.ai_protocol));
  if (!socket) return {};
  const int on = 1;  // a restart must not wait for the last run's connections to time out
  setsockopt(socket.descriptor(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  const bool listening = bind(socket.descriptor(), address.ai_addr, address.ai_addrlen) == 0 &&
                         listen(socket.descriptor(), kBacklog) == 0;
  if (listening) return socket;
  const int error = errno;
  socket = {};
  errno = error;
  return {};
}

std::string text_of(int family, const void* address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  return inet_ntop(family, address, text.data(), text.size()) == nullptr ? std::string() : text.data();
}

std::string text_of(const sockaddr_storage& peer) {
  if (peer.ss_family == AF_INET)
    return text_of(AF_INET, &reinterpret_cast<const sockaddr_in&>(peer).sin_addr);
  if (peer.ss_family != AF_INET6) return {};
  in6_addr address = reinterpret_cast<const sockaddr_in6&>(peer).sin6_addr;
  std::uint8_t* const bytes = address.s6_addr;
  if (IN6_IS_ADDR_V4MAPPED(&address)) return text_of(AF_INET, bytes + 12);
  if (IN6_IS_ADDR_LOOPBACK(&address)) return "::1";
  std::fill(bytes + 8, bytes + 16, std::uint8_t{0});
  return text_of(AF_INET6, &address) + "/64";
}

}  // namespace

Socket::~Socket() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Socket listen_on(const std::string& address, std::uint16_t port) {
  const AddressList candidates = resolve(address, port);
  int error = 0;
  for (const addrinfo* candidate = candidates.get(); candidate != nullptr; candidate = candidate->ai_next) {
    if (Socket listener = try_listen(*candidate)) return listener;
    error = errno;
  }
  throw std::runtime_error("port " + std::to_string(port) + " on " + address + " " + reason_words(error));
}

Accepted accept_from(const Socket& listener) {
  sockaddr_storage peer{};
  socklen_t size = sizeof peer;
  Socket socket(accept4(listener.descriptor(), reinterpret_cast<sockaddr*>(&peer), &size,
                        SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (!socket) return {};
  return {std::move(socket), text_of(peer)};
}

std::uint16_t port_of(const Socket& listener) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (getsockname(listener.descriptor(), reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    throw std::system_error(errno, std::generic_category(), "getsockname");
  }
  const auto* const v6 = reinterpret_cast<const sockaddr_in6*>(&address);
  const auto* const v4 = reinterpret_cast<const sockaddr_in*>(&address);
  return ntohs(address.ss_family == AF_INET6 ? v6->sin6_port : v4->sin_port);
}

}  // namespace gyrod::monitor
