#include "live/live.hpp"

#include <string>
#include <utility>

namespace gyrod::live {

void Live::tick(double now_s, double time_s, const stream::Engine& engine) {
  const stream::EngineSnapshot now = engine.snapshot();
  recent.note(now_s, now);
  for (std::string& sentence : watch_.look(now_s, now, engine.options().max_channels))
    events.add(time_s, "", std::move(sentence));
  tap.tidy(now_s);
  events.settle();
  if (now_s < next_round_s_) return;
  next_round_s_ = now_s + NoiseHistory::kPeriodS;
  engine.visit_channels(engine.options().max_channels,
                        [this](const stream::ChannelSnapshot& sensor) { noise.note(sensor); });
  noise.end_round();
}

}  // namespace gyrod::live
