#include "live/live.hpp"

namespace gyrod::live {

void Live::tick(double now_s, const stream::Engine& engine) {
  recent.note(now_s, engine.snapshot());
  tap.tidy(now_s);
  events.settle();
  if (now_s < next_round_s_) return;
  next_round_s_ = now_s + NoiseHistory::kPeriodS;
  engine.visit_channels(engine.options().max_channels,
                        [this](const stream::ChannelSnapshot& sensor) { noise.note(sensor); });
  noise.end_round();
}

}  // namespace gyrod::live
