#include "web/page.hpp"

#include "web/assets.hpp"

namespace gyrod::web {
namespace {

std::string elements(std::span<const std::string_view> names, std::string_view tag) {
  std::string text;
  for (const std::string_view name : names) {
    text.append("<").append(tag).append(">").append(asset(name)).append("</").append(tag).append(">\n");
  }
  return text;
}

std::string sources(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text.append(" '").append(asset_hash(name)).append("'");
  return text;
}

}  // namespace

std::string policy(const PageParts& parts) {
  return "default-src 'none'; base-uri 'none'; form-action 'none'; script-src" + sources(parts.scripts) +
         "; style-src" + sources(parts.styles);
}

std::string page(const PageParts& parts, const std::function<std::string(std::string_view name)>& value_of) {
  const auto text_of = [&](std::string_view name) {
    if (name == "POLICY") return policy(parts);
    if (name == "STYLES") return elements(parts.styles, "style");
    if (name == "SCRIPTS") return elements(parts.scripts, "script");
    if (name == "UPLOT_LICENSE") return escape_html(asset("uplot.license"));
    return value_of(name);
  };
  std::string_view rest = asset(parts.page);
  std::string made;
  while (true) {
    const auto begin = rest.find('@');
    const auto end = begin == std::string_view::npos ? begin : rest.find('@', begin + 1);
    if (end == std::string_view::npos) return made.append(rest);
    made.append(rest.substr(0, begin)).append(text_of(rest.substr(begin + 1, end - begin - 1)));
    rest.remove_prefix(end + 1);
  }
}

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

}  // namespace gyrod::web
