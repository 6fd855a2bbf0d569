/// A curve of samples with few enough points to draw, in which every spike still shows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "live/rest_trail.hpp"
#include "live/sample_trail.hpp"

namespace gyrod::live {

/// Least and largest rate of each stretch of time that has samples.
struct Trace {
  std::vector<std::int64_t> middle_ns;  ///< of the stretch
  std::array<std::vector<float>, stream::kAxes> least;
  std::array<std::vector<float>, stream::kAxes> largest;
};

/// Cuts time into stretches at multiples of their length since 1970, so that what was drawn once is the same when it is drawn again.
class TraceMaker {
 public:
  /// @pre bucket_ns > 0
  explicit TraceMaker(std::int64_t bucket_ns) : bucket_ns_(bucket_ns) {}

  /// @param points oldest first, newer than those before, unless their clock went back, which begins a new stretch
  void take(std::span<const Point> points);
  /// The stretches that are complete since the last call. @param with_open also the one that more samples may join; it then comes again
  [[nodiscard]] Trace make(bool with_open);

 private:
  struct Bucket {
    std::int64_t number = 0;
    std::array<float, stream::kAxes> least{};
    std::array<float, stream::kAxes> largest{};
  };

  void close(const Bucket& bucket, Trace& trace) const;

  std::int64_t bucket_ns_;
  std::optional<Bucket> open_;
  Trace done_;
};

/// Length of a stretch, ns, where this time is to have so many of them at the most.
[[nodiscard]] std::int64_t bucket_for(double seconds, std::size_t points) noexcept;

/// Where the stamps of neighbours are further apart than this many periods, samples are missing.
inline constexpr double kGapPeriods = 1.8;

/// Appends the gaps between neighbours. @param last the stamp before the first point, if any; becomes that of the last point
void find_gaps(std::span<const Point> points, double sample_rate_hz, std::optional<std::int64_t>& last,
               std::vector<Interval>& gaps);

}  // namespace gyrod::live
