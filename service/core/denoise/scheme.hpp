/// The paper's comparison: what is done with a record.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace gyrod::core {

/// The schemes that [Yang2019] compares in its Tables 5 to 9. IMF 1..j are noise, j+1..k mixed, the rest and the residue signal.
enum class Scheme : std::uint8_t {
  kRaw,       ///< nothing: the input as it is
  kDirect,    ///< scheme 1: model and Kalman filter on the mean-removed record itself, without EMD
  kEmd,       ///< scheme 2: IMF 1..j dropped, the rest kept, no modelling
  kAcfEmd,    ///< their reference [16]: the ACF boundary alone decides, IMF 1..k dropped, the rest kept
  kImproved,  ///< scheme 3, the paper's own: IMF 1..j dropped, j+1..k modelled and filtered, the rest kept
};

/// Number of schemes.
inline constexpr std::size_t kSchemes = 5;

/// All of them, in the order of the enumerators.
inline constexpr std::array<Scheme, kSchemes> kAllSchemes = {Scheme::kRaw, Scheme::kDirect, Scheme::kEmd,
                                                             Scheme::kAcfEmd, Scheme::kImproved};

/// Their names for users, in the order of the enumerators.
inline constexpr std::array<std::string_view, kSchemes> kSchemeNames = {"raw", "direct", "emd", "acf-emd",
                                                                        "improved"};

/// "raw", "direct", "emd", "acf-emd" or "improved".
[[nodiscard]] constexpr std::string_view name_of(Scheme scheme) noexcept {
  return kSchemeNames[static_cast<std::size_t>(scheme)];
}

/// The scheme of that name; nothing for any other text.
[[nodiscard]] constexpr std::optional<Scheme> scheme_of(std::string_view name) noexcept {
  for (const Scheme scheme : kAllSchemes) {
    if (name_of(scheme) == name) return scheme;
  }
  return std::nullopt;
}

}  // namespace gyrod::core
