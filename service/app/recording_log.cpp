#include "app/recording_log.hpp"

#include <algorithm>

namespace gyrod::app {

void RecordingLog::add(std::string_view sensor, std::uint64_t sequence) {
  auto found = sensors_.find(sensor);
  if (found == sensors_.end()) found = sensors_.emplace(sensor, Account{}).first;
  Account& account = found->second;
  if (account.samples > 0 && sequence <= account.last_sequence) {
    ++account.restarts;
  } else if (account.samples > 0 && sequence > account.last_sequence + 1) {
    if (account.gaps++ == 0) account.first_gap_after = account.last_sequence;
    account.missing += sequence - account.last_sequence - 1;
  }
  ++account.samples;
  account.last_sequence = sequence;
  account.ended = false;
}

void RecordingLog::end(std::string_view sensor) {
  const auto found = sensors_.find(sensor);
  if (found != sensors_.end()) found->second.ended = true;
}

bool RecordingLog::all_ended() const {
  return !sensors_.empty() &&
         std::ranges::all_of(sensors_, [](const auto& entry) { return entry.second.ended; });
}

}  // namespace gyrod::app
