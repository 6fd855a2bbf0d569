/// Samples and spectra of a sensor that somebody looks at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "live/tap.hpp"
#include "live/trace.hpp"
#include "monitor/answer.hpp"
#include "monitor/api_json.hpp"

namespace gyrod::monitor {

/// How much is asked for, and how finely.
struct SamplesQuery {
  /// Of the keys seconds and points.
  [[nodiscard]] static SamplesQuery parse(const Request& request);
  double seconds = 30.0;
  std::size_t points = 1000;
};

/// Of the key seconds. @return how long a stretch of samples the spectrum is to be of, at the most, s
[[nodiscard]] double parse_spectrum_query(const Request& request);

/// What is known of the sensor at one look.
struct SensorNow {
  std::string sensor;
  double sample_rate_hz = 0.0;  ///< 0: not known
  double now_s = 0.0;           ///< of the clock of live::Tap
};

/// The samples of a sensor as a client is told of them, frame by frame: first all that is asked for, then what is new.
class SampleFrames {
 public:
  explicit SampleFrames(const SamplesQuery& query);

  /// Everything, the newest stretch of time included though more may join it: for a single answer.
  [[nodiscard]] Json whole(const live::Watched& watched, const SensorNow& now);
  /// What is new since the last call, complete stretches of time only; none where there is nothing new. The first one, and the first after
  /// the sensor's clock has gone back, is not to be appended.
  [[nodiscard]] std::optional<Json> next(const live::Watched& watched, const SensorNow& now);

 private:
  [[nodiscard]] bool take(const live::Watched& watched, const SensorNow& now);
  [[nodiscard]] Json frame(const live::Watched& watched, const SensorNow& now, bool append, bool with_open);
  void begin_anew();
  [[nodiscard]] Json intervals(const std::vector<live::Interval>& all) const;
  [[nodiscard]] Json json_of(const live::Trace& trace) const;

  SamplesQuery query_;
  std::int64_t bucket_ns_;
  live::TraceMaker raw_;
  live::TraceMaker denoised_;
  std::uint64_t raw_place_ = 0;
  std::uint64_t denoised_place_ = 0;
  std::optional<std::int64_t> origin_ns_;  ///< none until there is a sample
  std::int64_t newest_ns_ = 0;
  std::optional<std::int64_t> gap_from_ns_;
  std::vector<live::Interval> gaps_;
  std::vector<live::Point> points_;  ///< kept for its memory
  bool is_first_ = true;
  bool has_begun_ = false;  ///< stretches were told, to which more are appended
};

/// @param noise_floor_radps x, y, z; 0 where it is not known
[[nodiscard]] Json spectrum_json(const live::Watched& watched, const SensorNow& now, double seconds,
                                 const std::array<double, stream::kAxes>& noise_floor_radps);

}  // namespace gyrod::monitor
