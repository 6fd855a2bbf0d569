#include "monitor/transport.hpp"

#include <cerrno>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <openssl/bio.h>
#include <openssl/err.h>
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
  if (tls_ != nullptr) {
    ERR_clear_error();
    std::size_t count = 0;
    const int result = SSL_read_ex(tls_.get(), bytes.data(), bytes.size(), &count);
    return outcome(result, count);
  }
  const ssize_t count = recv(socket_.descriptor(), bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (count <= 0) return {.ended = !only_blocked(count)};
  received_ += static_cast<std::uint64_t>(count);
  return {.bytes = static_cast<std::size_t>(count)};
}

Transfer Transport::write(std::string_view bytes) noexcept {
  if (tls_ != nullptr) {
    ERR_clear_error();
    std::size_t count = 0;
    const int result = SSL_write_ex(tls_.get(), bytes.data(), bytes.size(), &count);
    return outcome(result, count);
  }
  const ssize_t count = send(socket_.descriptor(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (count >= 0) return {.bytes = static_cast<std::size_t>(count)};
  return {.ended = !only_blocked(count)};
}

Transfer Transport::outcome(int result, std::size_t bytes) noexcept {
  blocked_on_ = 0;
  if (result == 1) return {.bytes = bytes};
  const int error = SSL_get_error(tls_.get(), result);
  if (error == SSL_ERROR_WANT_READ) blocked_on_ = POLLIN;
  if (error == SSL_ERROR_WANT_WRITE) blocked_on_ = POLLOUT;
  broken_ = blocked_on_ == 0;
  return {.ended = broken_};
}

pollfd Transport::waits_for(short events) const noexcept {
  const bool one_way = events == POLLIN || events == POLLOUT;
  return {socket_.descriptor(), one_way && blocked_on_ != 0 ? blocked_on_ : events, 0};
}

std::uint64_t Transport::received_bytes() const noexcept {
  return tls_ == nullptr ? received_ : BIO_number_read(SSL_get_rbio(tls_.get()));
}

bool Transport::is_shaking_hands() const noexcept {
  return tls_ != nullptr && received_bytes() > 0 && SSL_is_init_finished(tls_.get()) == 0;
}

void Transport::end_writing() noexcept {
  // After an error SSL_shutdown() must not be called.
  if (tls_ != nullptr && !broken_) {
    ERR_clear_error();
    (void)SSL_shutdown(tls_.get());
  }
  shutdown(socket_.descriptor(), SHUT_WR);
}

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
