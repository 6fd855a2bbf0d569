/// One HTML page of a template and what it needs: styles and scripts stand inside, so that it loads nothing from anywhere.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace gyrod::web {

/// Names of assets (web/assets.hpp).
struct PageParts {
  std::string_view page;  ///< the template
  std::span<const std::string_view> styles;
  std::span<const std::string_view> scripts;
};

/// A Content-Security-Policy that lets these styles and scripts run, by their hashes, and forbids all else.
[[nodiscard]] std::string policy(const PageParts& parts);

/// The template with @STYLES@, @SCRIPTS@, @POLICY@ and @UPLOT_LICENSE@ filled in, and every other @NAME@ by `value_of`. What is put in is
/// never searched again.
/// @param value_of gives text that is safe where it will stand
[[nodiscard]] std::string page(const PageParts& parts,
                               const std::function<std::string(std::string_view name)>& value_of);

/// `text` as HTML shows it, in text and in attributes.
[[nodiscard]] std::string escape_html(std::string_view text);

}  // namespace gyrod::web
