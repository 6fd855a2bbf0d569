/// Who takes what gyrod writes.
#pragma once

#include <cstddef>
#include <string>

namespace gyrod::bus {

/// Readers that match one topic of ours.
struct TopicReaders {
  std::string topic;
  std::size_t readers = 0;  ///< now
};

}  // namespace gyrod::bus
