/// What a daemon of several tells when it gives up a sensor.
#pragma once

#include <string>

#include "stream/sample.hpp"

namespace gyrod::bus {

/// The sensor was served here up to and with `taken`; who serves it from now on goes on behind that.
struct GivenUp {
  std::string sensor;
  stream::PublishedMark taken;

  friend bool operator==(const GivenUp& a, const GivenUp& b) noexcept {
    return a.sensor == b.sensor && a.taken.sequence == b.taken.sequence &&
           a.taken.stamp_ns == b.taken.stamp_ns;
  }
};

}  // namespace gyrod::bus
