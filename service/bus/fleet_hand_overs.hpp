/// What daemons of a fleet tell one another when sensors change hands. Internal to bus/.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus_options.hpp"
#include "bus/domain.hpp"
#include "bus/given_up.hpp"
#include "bus/topic_reader.hpp"
#include "bus/topic_writer.hpp"
#include "fleet/hand_over_book.hpp"

namespace gyrod::bus {

/// Writes and reads the topic of hand-overs that belongs to a topic of denoised samples. One thread.
class FleetHandOvers {
 public:
  /// @param options for the topic of denoised samples (for_topic) @param id of this daemon among all, 32 characters
  /// @param patience for which what was announced is waited for, ns
  /// @throws BusError
  FleetHandOvers(const Domain& domain, const BusOptions& options, const std::string& id,
                 dds_duration_t patience);

  /// Tells that these are served here no more. @param leaves whether nothing is @return false, with a warning in the log, if DDS refused that
  [[nodiscard]] bool tell(std::span<const GivenUp> given, bool leaves) noexcept;
  /// Hand-overs told so far.
  [[nodiscard]] std::uint64_t told() const noexcept { return told_; }

  /// Takes what others have told: calls visit(daemon's id, std::span<const GivenUp>, leaves) for each hand-over, oldest first of each daemon.
  template <class Visit>
  void take(const Visit& visit) {
    const auto hand_out = [&](const gyrod_HandOver& message, const dds_sample_info_t& info) {
      const std::string daemon(message.daemon);
      if (daemon == id_) return;
      if (info.valid_data) {
        book_.receive(daemon, message.number);
        visit(daemon, given_in(message), message.leaves);
      }
      if (info.instance_state != DDS_ALIVE_INSTANCE_STATE) book_.forget(daemon);
    };
    while (reader_.take(hand_out) > 0) {
    }
  }

  /// A daemon has announced that it has told so many.
  void expect(const std::string& daemon, std::uint64_t number) { book_.announce(daemon, number); }
  /// It is gone.
  void forget(const std::string& daemon) { book_.forget(daemon); }

  /// Whether what was announced has not come yet, and is waited for.
  [[nodiscard]] bool must_wait(dds_time_t now);
  /// The latest time at which must_wait() has another answer.
  [[nodiscard]] dds_time_t waits_until() const noexcept { return waits_until_; }
  /// Since the last call: false where the patience for one has ended.
  [[nodiscard]] bool all_have_told() noexcept { return std::exchange(all_have_told_, true); }

  /// Holds while there is something to take: for a waitset.
  [[nodiscard]] dds_entity_t data_condition() const noexcept { return reader_.data_condition(); }
  /// Waits until all that was told has been confirmed.
  void wait_for_acknowledgements(std::chrono::milliseconds timeout) const noexcept;

 private:
  [[nodiscard]] std::span<const GivenUp> given_in(const gyrod_HandOver& message);

  std::string id_;
  TopicWriter<gyrod_HandOver> writer_;
  TopicReader<gyrod_HandOver> reader_;
  std::uint64_t told_ = 0;
  fleet::HandOverBook book_;
  dds_duration_t patience_;
  dds_time_t waits_until_ = DDS_NEVER;
  bool all_have_told_ = true;
  std::vector<GivenUp> given_;  ///< of the message at hand
};

}  // namespace gyrod::bus
