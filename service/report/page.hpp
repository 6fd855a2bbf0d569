/// The report and the evaluation as one HTML page each that needs nothing else: no network, no second file.
#pragma once

#include <string>

#include "report/json.hpp"

namespace gyrod::report {

/// Puts the data, scripts and styles into the page's template. A Content-Security-Policy lets the browser run and apply just those,
/// by hash, and load nothing at all. Whatever text the title or the data hold stays text.
[[nodiscard]] std::string report_page(const std::string& title, const Json& data);

/// The same for the page of `gyrod evaluate`.
[[nodiscard]] std::string evaluation_page(const std::string& title, const Json& data);

}  // namespace gyrod::report
