#include "top/address.hpp"

#include <charconv>
#include <stdexcept>

#include "top/printable.hpp"

namespace gyrod::top {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& reason) {
  throw std::invalid_argument("'" + printable(text) + "' is no address of a gyrod: " + reason +
                              "; expected e.g. car7, car7:9464 or https://car7:9464");
}

std::uint16_t port_of(const std::string& text, std::string_view digits) {
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  if (error != std::errc{} || end != digits.data() + digits.size() || port == 0)
    refuse(text, "its port is '" + printable(digits) + "', and not 1 to 65535");
  return port;
}

/// Takes "http://" or "https://" off `rest`.
void take_scheme(const std::string& text, std::string_view& rest, Address& address) {
  constexpr std::uint16_t kHttp = 80;
  constexpr std::uint16_t kHttps = 443;
  const std::size_t colon = rest.find("://");
  if (colon == std::string_view::npos) return;
  const std::string_view scheme = rest.substr(0, colon);
  if (scheme != "http" && scheme != "https") refuse(text, "its scheme is neither http nor https");
  address.encrypted = scheme == "https";
  address.port = address.encrypted ? kHttps : kHttp;
  rest.remove_prefix(colon + 3);
}

/// Where the host ends in "host", "host:port" or "[host]:port".
std::size_t end_of_host(const std::string& text, std::string_view place) {
  if (!place.starts_with('[')) return std::min(place.find(':'), place.size());
  const std::size_t bracket = place.find(']');
  if (bracket == std::string_view::npos) refuse(text, "there is no ']' after '['");
  return bracket + 1;
}

bool is_host(std::string_view host) {
  constexpr std::string_view kSigns = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._:%";
  return !host.empty() && host.find_first_not_of(kSigns) == std::string_view::npos;
}

}  // namespace

std::string Address::origin() const {
  const std::string name = host.find(':') == std::string::npos ? host : "[" + host + "]";
  return (encrypted ? "https://" : "http://") + name + ":" + std::to_string(port);
}

Address parse_address(const std::string& text) {
  Address address;
  std::string_view rest = text;
  take_scheme(text, rest, address);
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  const std::string_view place = rest.substr(0, slash);
  const std::size_t end = end_of_host(text, place);
  const std::string_view host = place.substr(0, end);
  address.host = host.starts_with('[') ? host.substr(1, host.size() - 2) : host;
  if (!is_host(address.host)) refuse(text, "its host is '" + printable(host) + "'");
  if (end < place.size()) {
    if (place[end] != ':') refuse(text, "there is more after ']'");
    address.port = port_of(text, place.substr(end + 1));
  }
  address.prefix = rest.substr(slash);
  if (address.prefix.find_first_of("?# ") != std::string::npos) refuse(text, "it has a query");
  while (address.prefix.ends_with('/')) address.prefix.pop_back();
  return address;
}

}  // namespace gyrod::top
