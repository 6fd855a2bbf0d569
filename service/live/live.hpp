/// What people who look at a running gyrod see and the engine itself has no use for.
#pragma once

#include <cstddef>
#include <vector>

#include "live/daemon_watch.hpp"
#include "live/event_log.hpp"
#include "live/fit_watch.hpp"
#include "live/noise_history.hpp"
#include "live/recent.hpp"
#include "live/tap.hpp"
#include "stream/engine.hpp"

namespace gyrod::live {

struct Live {
  EventLog events;
  NoiseHistory noise;
  Recent recent;
  Tap tap;

  /// To be called about once a second, by one thread. @param now_s of a steady clock @param time_s since 1970
  /// @return what of the events is for the log, too, and is told by nobody else
  std::vector<FitWatch::News> tick(double now_s, double time_s, const stream::Engine& engine);

 private:
  DaemonWatch watch_;
  FitWatch fits_;
  double next_round_s_ = 0.0;
};

}  // namespace gyrod::live
