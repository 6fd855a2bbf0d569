/// The API's streams of server-sent events.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>

#include "live/event_log.hpp"
#include "monitor/answer.hpp"
#include "monitor/live_json.hpp"
#include "monitor/row_board.hpp"
#include "monitor/status_json.hpp"
#include "monitor/view.hpp"

namespace gyrod::monitor {

/// What every stream begins with: how long a browser waits before it comes back.
inline constexpr const char* kStreamBegin = "retry: 2000\n\n";

/// The new events of a log, of one sensor or of all.
class EventFeed {
 public:
  /// @param epoch of this run of gyrod
  /// @param last_event_id where the client left off, as append() has told it, or an event's number; empty or anything else: from now on. To
  /// one of another run all events are new
  EventFeed(const live::EventLog& log, std::string epoch, const std::string& last_event_id,
            std::string sensor);
  /// Tells the place at first, so that who has seen no event yet can come back to it.
  void append(std::string& text);

 private:
  void append_id(std::string& text, std::uint64_t event) const;

  const live::EventLog& log_;
  std::string epoch_;
  std::string sensor_;
  std::uint64_t after_;
  bool told_place_ = false;
};

/// Says something at the least every 15 s, so that whoever is between does not take the stream for dead.
class KeepAlive {
 public:
  /// @param said in this call of append()
  void append(std::string& text, bool said, double now_s);

 private:
  double next_s_ = 0.0;
};

/// /api/v1/stream: gyrod's state each second, the sensors' rows, events.
class FleetStream final : public EventSource {
 public:
  /// @param view, options, board outlive it; the view has a live::Live
  FleetStream(const View& view, const ApiOptions& options, RowBoard& board, const std::string& last_event_id,
              bool with_channels);
  void append(std::string& text) override;

 private:
  void append_channels(std::string& text, double now_s);

  const View& view_;
  const ApiOptions& options_;
  RowBoard& board_;
  EventFeed events_;
  KeepAlive keep_alive_;
  bool with_channels_;
  bool full_ = true;
  double next_s_ = 0.0;
  std::uint64_t round_ = 0;                            ///< of the noise's history, that was told
  std::unordered_map<std::string, std::size_t> told_;  ///< hash of each row
};

/// /api/v1/channels/{sensor}/stream: samples, figures and spectrum of one sensor.
class SensorStream final : public EventSource {
 public:
  /// @param view, options outlive it; the view has a live::Live
  SensorStream(const View& view, const ApiOptions& options, std::string sensor, const SamplesQuery& query,
               const std::string& last_event_id);
  /// @throws std::runtime_error once the sensor is forgotten
  void append(std::string& text) override;

 private:
  void append_channel(std::string& text, const stream::ChannelSnapshot& channel);

  const View& view_;
  const ApiOptions& options_;
  std::string sensor_;
  SamplesQuery query_;
  SampleFrames frames_;
  EventFeed events_;
  KeepAlive keep_alive_;
  double next_samples_s_ = 0.0;
  double next_channel_s_ = 0.0;
  double next_spectrum_s_ = 0.0;
  std::uint64_t spectrum_place_ = 0;
  std::size_t told_ = 0;  ///< hash of the figures
};

}  // namespace gyrod::monitor
