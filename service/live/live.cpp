#include "live/live.hpp"

#include <string>
#include <utility>

namespace gyrod::live {

std::vector<FitWatch::News> Live::tick(double now_s, double time_s, const stream::Engine& engine) {
  const stream::EngineSnapshot now = engine.snapshot();
  recent.note(now_s, now);
  for (std::string& sentence : watch_.look(now_s, now, engine.options().max_channels))
    events.add(time_s, "", std::move(sentence));
  tap.tidy(now_s);
  std::vector<FitWatch::News> news;
  if (now_s >= next_round_s_) {
    next_round_s_ = now_s + NoiseHistory::kPeriodS;
    engine.visit_channels(engine.options().max_channels,
                          [this, now_s](const stream::ChannelSnapshot& sensor) {
                            noise.note(sensor);
                            fits_.note(now_s, sensor);
                          });
    noise.end_round();
    news = fits_.end_round(now_s);
  }
  for (const FitWatch::News& one : news) events.add(time_s, one.sensor, one.text + ".");
  events.settle();
  return news;
}

}  // namespace gyrod::live
