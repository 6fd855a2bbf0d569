#include "monitor/live_page.hpp"

#include <array>
#include <openssl/evp.h>
#include <stdexcept>
#include <string>
#include <string_view>

#include "web/page.hpp"

namespace gyrod::monitor {
namespace {

constexpr std::array<std::string_view, 3> kStyles = {"uplot.css", "page.css", "live.css"};
/// Each uses those before it.
constexpr std::array<std::string_view, 16> kScripts = {
    "uplot.js",        "charts.js",    "parts.js",       "live_units.js",
    "live_health.js",  "live_feed.js", "live_state.js",  "live_history.js",
    "live_plots.js",   "live_imfs.js", "live_facts.js",  "live_events.js",
    "live_channel.js", "live_list.js", "live_daemon.js", "live.js"};
constexpr web::PageParts kParts = {.page = "live.html", .styles = kStyles, .scripts = kScripts};

/// The icon in the browser's tab is the only picture, and stands in the page.
std::string content_security_policy() {
  return web::policy(kParts) + "; connect-src 'self'; img-src data:; frame-ancestors 'none'";
}

/// Weak, since the page may come compressed.
std::string entity_tag(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::array<unsigned char, 32> digest{};
  if (EVP_Digest(text.data(), text.size(), digest.data(), nullptr, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("SHA-256 is not to be had");
  std::string tag = "W/\"";
  for (const unsigned char byte : digest) {
    tag += kDigits[byte / 16U];
    tag += kDigits[byte % 16U];
  }
  return tag + '"';
}

}  // namespace

Answer live_page() {
  static const std::string page =
      web::page(kParts, [](std::string_view name) { return "@" + std::string(name) + "@"; });
  static const std::string policy = content_security_policy();
  static const std::string tag = entity_tag(page);
  return {
      .content_type = "text/html; charset=utf-8",
      .body = page,
      .headers = {
          {"Content-Security-Policy", policy},
          // Another version of the daemon has another page, on the same address: to be asked for each time.
          {"Cache-Control", "no-cache"},
          {"ETag", tag}}};
}

}  // namespace gyrod::monitor
