/// The sensors as the JSON API lists them: a row each, filtered, sorted and cut to a page.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "monitor/api_json.hpp"
#include "monitor/api_query.hpp"
#include "monitor/sensor_figures.hpp"
#include "monitor/view.hpp"

namespace gyrod::monitor {

/// What a row shows: a small part of a snapshot.
struct ChannelRow {
  struct Axis {
    stream::AxisHealth health;
    Value noise_in_radps;
    Value noise_out_radps;
    Value reduction_db;
  };

  std::string sensor;
  stream::Health health = stream::Health::kWarmingUp;
  stream::ChannelState state = stream::ChannelState::kActive;
  Value sample_rate_hz;
  std::uint32_t hop_samples = 0;
  int overload_step = 0;
  stream::NoiseSource noise_source = stream::NoiseSource::kNone;
  std::optional<bool> at_rest;
  std::uint64_t received = 0;
  std::uint64_t published = 0;
  std::uint64_t rejected = 0;
  std::uint64_t missing = 0;
  std::array<Axis, stream::kAxes> axes{};
};

[[nodiscard]] ChannelRow row_of(const stream::ChannelSnapshot& sensor);
[[nodiscard]] std::vector<ChannelRow> rows_of(const View& view);
[[nodiscard]] int worst_overload_step(const std::vector<ChannelRow>& rows);

/// @param history where set, each axis has its noise of the last ten minutes, too
[[nodiscard]] Json json_of(const ChannelRow& row, const live::Live* history = nullptr);

/// What is to be listed, and in which order.
struct Listing {
  /// The keys of a query that parse() knows, beside those of the route: health, search, sort, order, offset, limit, history.
  [[nodiscard]] static Listing parse(const Request& request);

  std::array<bool, stream::kHealthStates> health{};  ///< none set: all
  std::string search;
  std::size_t sort = 0;
  bool ascending = false;
  std::size_t offset = 0;
  std::size_t limit = 1000;
  bool history = false;
};

/// {"time_s", "total", "matching", "offset", "channels"}
[[nodiscard]] Json listing_json(const View& view, const Listing& listing, double time_s);

}  // namespace gyrod::monitor
