/// What a channel's windows together show of its motion.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/joint/spectral_mode.hpp"

namespace gyrod::core {

/// The mean periodogram of a channel's windows, later ones counting more, and the modes that were fitted to it last: a fit that goes on where the window
/// before left it needs few iterations to find what is narrow or faint. In the data's unit, as the unit of a fit may change.
/// A plain value; not thread-safe.
/// Source: docs/joint.md, "What lasts".
class LastingSpectrum {
 public:
  /// For periodograms of so many bins at the most; allocates, observe() does not after it.
  void make_room(std::size_t bins) { power_.reserve(bins); }

  /// Takes a window's periodogram. Until so much has been seen it is the mean of all windows by their amounts, then an exponential one.
  /// Where windows have become longer or shorter by a whole factor, the mean is restated at their bins; any other number of bins starts anew. Both
  /// allocate where there is no room. A mean that is not finite starts anew.
  /// @param periodogram finite, in parts of `unit`
  /// @param amount what the window tells in parts of a full one: short ones blur what is narrow
  /// @param share  of a full window in the mean
  /// @pre unit > 0, 0 < amount <= 1, 0 < share <= 1
  void observe(std::span<const double> periodogram, double unit, double amount, double share);

  /// The mean, in parts of `unit`. @pre a call above, of as many bins
  void mean(double unit, std::span<double> periodogram) const noexcept;

  /// Keeps modes, in parts of `unit`; none where one is not finite.
  void keep(const ModeSet& modes, double unit) noexcept;
  /// The modes that were kept, in parts of `unit`, all of them motion; none before keep().
  [[nodiscard]] ModeSet modes(double unit) const noexcept;

  /// As just made, but for the room.
  void forget() noexcept;

 private:
  void start_anew(std::size_t bins);
  [[nodiscard]] bool restate(std::size_t bins);

  std::vector<double> power_;
  double amount_ = 0.0;  ///< of all windows
  ModeSet modes_;
};

}  // namespace gyrod::core
