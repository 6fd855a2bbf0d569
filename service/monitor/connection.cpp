#include "monitor/connection.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <poll.h>
#include <sys/socket.h>
#include <utility>

namespace gyrod::monitor {
namespace {

/// A request of ours is one line and a few headers; a browser's is below 4 KiB.
constexpr std::size_t kMaxRequestBytes = std::size_t{16} * 1024;
/// From accepting to the last byte of the request: clients that send nothing must not keep the threads from
/// others.
constexpr std::chrono::seconds kRequestTime{2};
/// From accepting to the last byte of the answer. Prometheus gives up after 10 s by default.
constexpr std::chrono::seconds kAnswerTime{10};

}  // namespace

Connection::Connection(Socket socket, const StopSignal& stop)
    : socket_(std::move(socket)),
      stop_(stop),
      request_deadline_(std::chrono::steady_clock::now() + kRequestTime),
      answer_deadline_(std::chrono::steady_clock::now() + kAnswerTime),
      bytes_left_(kMaxRequestBytes) {}

Connection::~Connection() {
  // Bytes left unread would make close() send a reset, and the client might lose the answer: take those that
  // are here.
  shutdown(socket_.descriptor(), SHUT_WR);
  std::array<char, kMaxRequestBytes> unread{};
  (void)recv(socket_.descriptor(), unread.data(), unread.size(), MSG_DONTWAIT);
}

bool Connection::is_readable() const { return stop_.wait(socket_.descriptor(), POLLIN, request_deadline_); }

bool Connection::is_writable() const { return stop_.wait(socket_.descriptor(), POLLOUT, answer_deadline_); }

ssize_t Connection::read(char* bytes, std::size_t size) {
  if (bytes_left_ == 0 || !is_readable()) return -1;
  const ssize_t count = recv(socket_.descriptor(), bytes, std::min(size, bytes_left_), MSG_DONTWAIT);
  if (count > 0) bytes_left_ -= static_cast<std::size_t>(count);
  return count;
}

ssize_t Connection::write(const char* bytes, std::size_t size) {
  if (!is_writable()) return -1;
  return send(socket_.descriptor(), bytes, size, MSG_DONTWAIT | MSG_NOSIGNAL);
}

void Connection::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip.clear();
  port = 0;
}

void Connection::get_local_ip_and_port(std::string& ip, int& port) const {
  ip.clear();
  port = 0;
}

}  // namespace gyrod::monitor
