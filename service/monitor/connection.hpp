/// One client's connection as the byte stream that cpp-httplib reads requests from.
#pragma once

#include <cstddef>
#include <string>

#include <httplib.h>

#include "monitor/socket.hpp"
#include "monitor/stop_signal.hpp"

namespace gyrod::monitor {

/// Ends reading and writing when the client has sent too much, has taken too long in total (not per byte, so
/// that one that trickles gains nothing), or the monitor stops. One thread.
class Connection final : public httplib::Stream {
 public:
  /// @param stop outlives the connection
  Connection(Socket socket, const StopSignal& stop);
  /// Closes so that a client still gets an answer that was given before it had sent everything.
  ~Connection() override;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  using httplib::Stream::write;
  [[nodiscard]] bool is_readable() const override;
  [[nodiscard]] bool is_writable() const override;
  /// @return bytes read; 0 at the client's end; -1 when a limit or the stop ends it
  ssize_t read(char* bytes, std::size_t size) override;
  /// @return bytes written, or -1
  ssize_t write(const char* bytes, std::size_t size) override;
  /// Not known here: nothing that gyrod answers depends on who asks.
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  [[nodiscard]] int socket() const override { return socket_.descriptor(); }

 private:
  Socket socket_;
  const StopSignal& stop_;
  Deadline request_deadline_;
  Deadline answer_deadline_;
  std::size_t
      bytes_left_;  // NOLINT(modernize-use-default-member-init): the limit is known to the source alone
};

}  // namespace gyrod::monitor
