/// The live page: what a person sees who opens the daemon's port in a browser.
#pragma once

#include "monitor/answer.hpp"

namespace gyrod::monitor {

/// One HTML page with all its scripts and styles inside, the same for the life of the program. Its Content-Security-Policy lets just those
/// run and lets it ask this daemon alone. Everything that moves on it comes from the API. Thread-safe.
[[nodiscard]] Answer live_page();

}  // namespace gyrod::monitor
