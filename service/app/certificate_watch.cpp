#include "app/certificate_watch.hpp"

namespace gyrod::app {

std::optional<CertificateWatch::News> CertificateWatch::look(std::chrono::sys_seconds now) {
  const auto left = identity_.expires_at - now;
  const bool expired = left <= std::chrono::seconds{0};
  if (!expired && left > warn_before_) return std::nullopt;
  if (next_ && now < *next_ && expired == said_expired_) return std::nullopt;
  next_ = now + std::chrono::days{1};
  said_expired_ = expired;
  const std::string file = "DDS Security: '" + identity_.expiring_file + "' ";
  if (expired) {
    return News{true,
                file +
                    "has expired: gyrod is cut off from all other programs until it is restarted with a "
                    "certificate that holds"};
  }
  const auto days = std::chrono::floor<std::chrono::days>(left).count();
  return News{false, file + "expires in " + std::to_string(days) + (days == 1 ? " day" : " days") +
                         ": renew it and restart gyrod before"};
}

}  // namespace gyrod::app
