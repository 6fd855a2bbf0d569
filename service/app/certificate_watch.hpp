/// When to say that a certificate ends.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "bus/security_check.hpp"

namespace gyrod::app {

/// Says once a day that a certificate ends soon, and once a day that it has ended, from the second on in which it does. One thread.
class CertificateWatch {
 public:
  struct News {
    bool expired = false;
    std::string line;
  };

  /// @param warn_before how long before the end to begin
  CertificateWatch(bus::Identity identity, std::chrono::days warn_before)
      : identity_(std::move(identity)), warn_before_(warn_before) {}

  /// To be called about once a second. @return what to log now, if anything
  [[nodiscard]] std::optional<News> look(std::chrono::sys_seconds now);

 private:
  bus::Identity identity_;
  std::chrono::days warn_before_;
  std::optional<std::chrono::sys_seconds> next_;  ///< nothing is said before
  bool said_expired_ = false;
};

}  // namespace gyrod::app
