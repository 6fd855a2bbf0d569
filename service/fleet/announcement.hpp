/// What a daemon tells the other daemons of its fleet about itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fleet/shard.hpp"

namespace gyrod::fleet {

/// Goes round as text with the writer of denoised samples (DDS: its user data), which others than gyrod may read:
///   "gyrod.shard=2/3;gyrod.state=active;gyrod.yields=ID,ID;gyrod.greets=ID;gyrod.awaits=ID;gyrod.handed=4;"
/// A daemon that has left in order says how it did: "gyrod.handed=5;"
struct Announcement {
  Shard shard;
  bool active = false;  ///< false: joining, takes part in who yields to whom and serves nothing
  std::vector<std::string>
      yields_to;  ///< ids of daemons for which this one has stopped to serve what both hold

  std::vector<std::string> greets = {};  ///< ids of daemons that this one has heard are joining
  /// Ids of daemons to which this one leaves what both hold until they yield.
  std::vector<std::string> awaits = {};
  /// Hand-overs that this one has told so far, the newest of them for what it has given up by now. None: it tells none.
  std::optional<std::uint64_t> handed = {};

  friend bool operator==(const Announcement&, const Announcement&) = default;
};

/// Daemons of one fleet that are taken notice of; more are not.
inline constexpr std::size_t kMostPeers = 256;

[[nodiscard]] std::string text_of(const Announcement& announcement);
/// Of a daemon that has left, and has told so many hand-overs.
[[nodiscard]] std::string text_of_leaving(std::uint64_t handed);

/// Keys that are not known are passed over. @return nothing if there is no shard in it, or anything of gyrod's that is malformed
[[nodiscard]] std::optional<Announcement> parse_announcement(std::string_view text);
/// Hand-overs told. @return nothing if the text does not say, or not as a number
[[nodiscard]] std::optional<std::uint64_t> parse_handed(std::string_view text);

}  // namespace gyrod::fleet
