#include "report/page.hpp"

#include <array>
#include <string_view>

#include "web/page.hpp"

namespace gyrod::report {
namespace {

constexpr std::array<std::string_view, 3> kStyles = {"uplot.css", "page.css", "report.css"};
constexpr std::array<std::string_view, 6> kReportScripts = {"uplot.js", "charts.js",         "parts.js",
                                                            "tabs.js",  "report_figures.js", "report.js"};
constexpr std::array<std::string_view, 6> kEvaluationScripts = {
    "uplot.js", "charts.js", "parts.js", "tabs.js", "report_figures.js", "evaluation.js"};

std::string filled(const web::PageParts& parts, const std::string& title, const Json& data) {
  return web::page(parts, [&](std::string_view name) {
    if (name == "TITLE") return web::escape_html(title);
    if (name == "DATA") return script_text(data);
    return "@" + std::string(name) + "@";
  });
}

}  // namespace

std::string report_page(const std::string& title, const Json& data) {
  return filled({.page = "report.html", .styles = kStyles, .scripts = kReportScripts}, title, data);
}

std::string evaluation_page(const std::string& title, const Json& data) {
  return filled({.page = "evaluation.html", .styles = kStyles, .scripts = kEvaluationScripts}, title, data);
}

}  // namespace gyrod::report
