#include "monitor/live_page.hpp"

#include <array>
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

}  // namespace

Answer live_page() {
  static const std::string page =
      web::page(kParts, [](std::string_view name) { return "@" + std::string(name) + "@"; });
  static const std::string policy = content_security_policy();
  return {.content_type = "text/html; charset=utf-8",
          .body = page,
          .headers = {{"Content-Security-Policy", policy},
                      // Another version of the daemon has another page, on the same address.
                      {"Cache-Control", "no-cache"}}};
}

}  // namespace gyrod::monitor
