#include "report/page.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "web/assets.hpp"

namespace gyrod::report {
namespace {

constexpr std::array<std::string_view, 3> kStyles = {"uplot.css", "page.css", "report.css"};

/// What a page is made of besides the styles, which all share.
struct Parts {
  std::string_view page;
  std::array<std::string_view, 5> scripts;
};
constexpr Parts kReport = {"report.html",
                           {"uplot.js", "charts.js", "tabs.js", "report_figures.js", "report.js"}};
constexpr Parts kEvaluation = {"evaluation.html",
                               {"uplot.js", "charts.js", "tabs.js", "report_figures.js", "evaluation.js"}};

std::string elements(std::span<const std::string_view> names, std::string_view tag) {
  std::string text;
  for (const std::string_view name : names) {
    text.append("<").append(tag).append(">").append(web::asset(name)).append("</").append(tag).append(">\n");
  }
  return text;
}

std::string sources(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text.append(" '").append(web::asset_hash(name)).append("'");
  return text;
}

std::string policy(const Parts& parts) {
  return "default-src 'none'; base-uri 'none'; form-action 'none'; script-src" + sources(parts.scripts) +
         "; style-src" + sources(kStyles);
}

/// What stands for @NAME@ in the template.
std::string value_of(std::string_view name, const Parts& parts, const std::string& title, const Json& data) {
  if (name == "POLICY") return policy(parts);
  if (name == "TITLE") return escape_html(title);
  if (name == "STYLES") return elements(kStyles, "style");
  if (name == "SCRIPTS") return elements(parts.scripts, "script");
  if (name == "UPLOT_LICENSE") return escape_html(web::asset("uplot.license"));
  if (name == "DATA") return script_text(data);
  return "@" + std::string(name) + "@";
}

std::string filled(const Parts& parts, const std::string& title, const Json& data) {
  // One walk over the template: what is put in is never searched again.
  std::string_view rest = web::asset(parts.page);
  std::string page;
  while (true) {
    const auto begin = rest.find('@');
    const auto end = begin == std::string_view::npos ? begin : rest.find('@', begin + 1);
    if (end == std::string_view::npos) return page.append(rest);
    page.append(rest.substr(0, begin));
    page.append(value_of(rest.substr(begin + 1, end - begin - 1), parts, title, data));
    rest.remove_prefix(end + 1);
  }
}

}  // namespace

std::string escape_html(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string report_page(const std::string& title, const Json& data) { return filled(kReport, title, data); }

std::string evaluation_page(const std::string& title, const Json& data) {
  return filled(kEvaluation, title, data);
}

}  // namespace gyrod::report
