/// One thing that is wrong with a configuration.
#pragma once

#include <string>

namespace gyrod::settings {

struct SettingsIssue {
  std::string key;       ///< e.g. "denoise.hop_samples"; empty when the whole file is meant
  std::string value;     ///< the offending value as JSON text, shortened; empty if there is none
  std::string expected;  ///< in words; empty for an unknown key
  std::string message;   ///< the line for people, holding all of it
};

}  // namespace gyrod::settings
