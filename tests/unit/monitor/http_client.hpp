/// A client that speaks bytes, so that it can also misbehave.
#pragma once

#include <arpa/inet.h>
#include <chrono>
#include <cstdint>
#include <netinet/in.h>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/socket.h>

#include "monitor/socket.hpp"

namespace gyrod::monitor::test {

/// Longest wait for an answer; never reached when all is well.
inline constexpr std::chrono::seconds kPatience{60};

/// One connection to a port of this machine.
class HttpClient {
 public:
  explicit HttpClient(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ =
        connect(socket_.descriptor(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }

  [[nodiscard]] bool connected() const { return connected_; }
  [[nodiscard]] int descriptor() const { return socket_.descriptor(); }

  /// @return false if the other side has closed
  bool send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(socket_.descriptor(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }

  /// All that comes until the other side closes.
  [[nodiscard]] std::string receive() const { return receive_until({}); }

  /// The same, or until `mark` has come.
  [[nodiscard]] std::string receive_until(std::string_view mark) const {
    std::string received;
    std::string piece(64U * 1024U, '\0');
    pollfd readable{socket_.descriptor(), POLLIN, 0};
    while (poll(&readable, 1, static_cast<int>(std::chrono::milliseconds(kPatience).count())) > 0) {
      const ssize_t count = recv(socket_.descriptor(), piece.data(), piece.size(), 0);
      if (count <= 0) return received;
      received.append(piece, 0, static_cast<std::size_t>(count));
      if (!mark.empty() && received.find(mark) != std::string::npos) return received;
    }
    throw std::runtime_error("the server neither answers nor closes");
  }

 private:
  Socket socket_;
  bool connected_ = false;
};

struct HttpAnswer {
  int status = 0;       ///< 0: none
  std::string headers;  ///< with the status line
  std::string body;
};

/// Sends one request on a connection of its own and reads the answer.
inline HttpAnswer ask(std::uint16_t port, const std::string& method, const std::string& path,
                      const std::string& headers = {}) {
  const HttpClient client(port);
  (void)client.send(method + " " + path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + headers +
                    "\r\n");
  const std::string all = client.receive();
  HttpAnswer answer;
  const std::size_t end = all.find("\r\n\r\n");
  if (end == std::string::npos) return answer;
  answer.headers = all.substr(0, end);
  answer.body = all.substr(end + 4);
  answer.status = std::stoi(answer.headers.substr(answer.headers.find(' ')));
  return answer;
}

inline HttpAnswer get(std::uint16_t port, const std::string& path) { return ask(port, "GET", path); }

}  // namespace gyrod::monitor::test
