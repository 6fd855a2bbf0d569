#include "monitor/transport.hpp"

#include <cerrno>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

namespace gyrod::monitor {
namespace {

/// Some seconds of what an event stream sends.
constexpr int kSendBufferBytes = 256 * 1024;
/// Below this the socket counts as ready for more.
constexpr unsigned kLowUnsentBytes = 32U * 1024U;
/// For a client that confirms nothing: its machine is off or out of reach.
constexpr unsigned kUnconfirmedMs = 30'000;

bool only_blocked(ssize_t count) noexcept {
  return count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
}

}  // namespace

Transfer Transport::read(std::span<char> bytes) noexcept {
  const ssize_t count = recv(socket_.descriptor(), bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (count > 0) return {.bytes = static_cast<std::size_t>(count)};
  return {.ended = !only_blocked(count)};
}

Transfer Transport::write(std::string_view bytes) noexcept {
  const ssize_t count = send(socket_.descriptor(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (count >= 0) return {.bytes = static_cast<std::size_t>(count)};
  return {.ended = !only_blocked(count)};
}

void Transport::end_writing() noexcept { shutdown(socket_.descriptor(), SHUT_WR); }

bool Transport::is_writable() const noexcept {
  pollfd socket{socket_.descriptor(), POLLOUT, 0};
  return poll(&socket, 1, 0) > 0;
}

void Transport::limit_unsent() noexcept {
  setsockopt(socket_.descriptor(), SOL_SOCKET, SO_SNDBUF, &kSendBufferBytes, sizeof kSendBufferBytes);
  setsockopt(socket_.descriptor(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &kLowUnsentBytes, sizeof kLowUnsentBytes);
  setsockopt(socket_.descriptor(), IPPROTO_TCP, TCP_USER_TIMEOUT, &kUnconfirmedMs, sizeof kUnconfirmedMs);
}

}  // namespace gyrod::monitor
