/// The versions of the rates that `gyrod navigate` compares.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "files/record.hpp"
#include "settings/settings.hpp"
#include "stream/sample.hpp"

namespace gyrod::app {

using NavigatedRates = std::array<std::vector<double>, stream::kAxes>;

/// The schemes of method paper; `joint` and `realtime`, method joint with look-ahead and without.
[[nodiscard]] std::vector<std::string> navigated_names();

/// What is compared where nothing is asked for: raw, joint, realtime and improved. Where method joint cannot be had (see check_navigated()), the
/// schemes of the paper alone: raw, acf-emd, improved.
[[nodiscard]] std::vector<std::string> navigated_by_default(const settings::Settings& settings,
                                                            bool whole_record);

/// Whether a version's rates come without delay.
[[nodiscard]] bool comes_at_once(std::string_view name) noexcept;

/// Method joint works in windows, with a bounded look-ahead.
/// @throws CLI::ValidationError where it is among the names and cannot be had
void check_navigated(const std::vector<std::string>& names, const settings::Settings& settings,
                     bool whole_record);

/// @pre check_navigated() had nothing to say
/// @throws as OfflineDenoiser
[[nodiscard]] NavigatedRates navigated_rates(const std::string& name, const files::Record& record,
                                             const settings::Settings& settings, bool whole_record);

}  // namespace gyrod::app
