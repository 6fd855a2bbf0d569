/// Asks a gyrod over HTTP.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "top/address.hpp"
#include "top/answers.hpp"
#include "top/view.hpp"

namespace gyrod::top {

/// No answer; what() names the URL and the reason.
class Unreachable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// gyrod wants to know who asks, and is not content; what() names the URL and what to do.
class Forbidden : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// With what a gyrod is asked that wants to know who asks, and how it shows that it is one itself.
struct Credentials {
  std::string token;  ///< bearer token; empty: none
  std::string user;   ///< with `password`; empty: none
  std::string password;
  std::string ca_file;  ///< PEM; empty: the system's authorities
};

/// One thread at a time but for stop().
class Client {
 public:
  Client(const Address& address, const Credentials& credentials);
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  // What is asked for, as the API's own text, 16 MiB at most. @throws Unreachable, Forbidden, AnswerError
  [[nodiscard]] std::string status_text();
  [[nodiscard]] std::string sensors_text(const View& view, std::uint64_t offset, std::uint64_t limit);
  /// The newest, the last one last.
  [[nodiscard]] std::string events_text(std::uint64_t limit);

  [[nodiscard]] const std::string& url() const noexcept { return url_; }

  /// Ends a request that waits. Any thread.
  void stop() noexcept;

 private:
  [[nodiscard]] std::string get(const std::string& target);

  [[nodiscard]] std::string refusal(int status, const std::string& target, const std::string& words) const;

  std::string url_;
  std::string prefix_;
  bool tells_who_ = false;
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace gyrod::top
