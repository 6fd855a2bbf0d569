/// Scripts, styles and templates of gyrod's pages, built into the binary: pages load nothing from anywhere.
///
///     uplot.js, uplot.css, uplot.license   the plotting library, from npm, version pinned in package-lock.json
///     page.css, charts.js, parts.js        look, chart helpers, tables and figures that all pages share
///     tabs.js                              tabs of the reports
///     report.html, report.css, report_figures.js, report.js   the report page (service/report)
///     evaluation.html, evaluation.js       the page of `gyrod evaluate`, with the report's styles and figure helpers
///     live.html, live.css, live_*.js, live.js   the daemon's live page (service/monitor)
#pragma once

#include <string_view>

namespace gyrod::web {

/// The text of a file, UTF-8. Reentrant; lives as long as the program.
/// @pre name is one of those above
[[nodiscard]] std::string_view asset(std::string_view name) noexcept;

/// Its hash as a Content-Security-Policy names it, "sha256-...", for the text exactly as asset() gives it.
/// @pre name is one of those above
[[nodiscard]] std::string_view asset_hash(std::string_view name) noexcept;

}  // namespace gyrod::web
