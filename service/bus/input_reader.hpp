/// A topic from writers of both kinds. Internal to bus/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "bus/promise_watch.hpp"
#include "bus/topic_reader.hpp"
#include "bus/writer_book.hpp"

namespace gyrod::bus {

/// Who is told of a reader's condition and promises when it opens.
struct Attendants {
  dds_entity_t waitset = 0;
  PromiseWatch* promises = nullptr;
};

/// Reads a topic as InputReliability says. Under kAuto there is a reliable reader, and, from the moment on that a best-effort writer of the
/// topic appears, a second one for it. DDS gives that one the messages of reliable writers, too; it is asked of each message who wrote it,
/// so that every writer's messages are handed on once, and in their order.
///
/// Messages come with the number of the reader, the *side*, 0 or 1: what is known of a sensor's life holds for a side.
/// One thread takes; the counts are for any.
template <class Message>
class InputReader {
 public:
  static constexpr std::size_t kSides = 2;

  /// @param make_qos gives the reader's QoS for a Reliability @throws BusError naming topic and QoS
  template <class MakeQos>
  InputReader(dds_entity_t participant, std::string name, InputReliability reliability,
              const MakeQos& make_qos)
      : participant_(participant), name_(std::move(name)) {
    const bool best_effort = reliability == InputReliability::kBestEffort;
    sides_[0].emplace(participant, name_,
                      make_qos(best_effort ? Reliability::kBestEffort : Reliability::kReliable));
    if (reliability == InputReliability::kAuto) second_.emplace(make_qos(Reliability::kBestEffort));
  }

  /// Has a waitset wait for this topic, and the promises of its writers watched, under the numbers source and source + 1.
  void attend(const Attendants& attendants, const QosProfile& asked, std::size_t source) {
    attendants_ = attendants;
    asked_ = asked;
    source_ = source;
    attend_to(0);
  }

  /// A writer was discovered: opens a second reader if it needs one. @return whether it did @throws BusError
  bool serve(const WriterBook::Writer& writer) {
    if (!second_ || writer.topic != name_ || writer.reliability == Reliability::kReliable) return false;
    TopicReader<Message> reader(participant_, name_, *second_);
    {
      const std::lock_guard lock(mutex_);
      sides_[1].emplace(std::move(reader));
    }
    second_.reset();
    attend_to(1);
    return true;
  }

  /// As TopicReader::take(), with visit(side, message, info).
  template <class Visit>
  std::size_t take(WriterBook& book, Visit&& visit) const {
    std::size_t taken = 0;
    for_each_side([&](std::size_t side, const TopicReader<Message>& reader) {
      taken += reader.take(only_meant_for(side, book, visit));
    });
    return taken;
  }

  /// As TopicReader::take_sensor(), the same way. @pre fits_wire(sensor)
  template <class Visit>
  void take_sensor(WriterBook& book, std::string_view sensor, Visit&& visit) const {
    for_each_side([&](std::size_t side, const TopicReader<Message>& reader) {
      reader.take_sensor(sensor, only_meant_for(side, book, visit));
    });
  }

  /// Writers that send to this topic's reader, and how many did so far.
  [[nodiscard]] dds_subscription_matched_status_t matched() const noexcept {
    const std::lock_guard lock(mutex_);
    dds_subscription_matched_status_t status{};
    // Of both, which ends what a waitset waits for. The second asks for less than the first: who matches that matches this.
    for_each_side([&](std::size_t, const TopicReader<Message>& reader) { status = reader.matched(); });
    return status;
  }
  [[nodiscard]] std::uint64_t refusals() const noexcept {
    const std::lock_guard lock(mutex_);
    std::uint64_t refusals = 0;
    for_each_side([&](std::size_t, const TopicReader<Message>& reader) { refusals += reader.refusals(); });
    return refusals;
  }

  /// @pre side < kSides. 0 where there is none
  [[nodiscard]] dds_entity_t reader(std::size_t side) const noexcept {
    return sides_[side] ? sides_[side]->get() : 0;
  }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

 private:
  void attend_to(std::size_t side) {
    if (attendants_.waitset == 0) return;
    check(dds_waitset_attach(attendants_.waitset, sides_[side]->data_condition(), 0),
          "wait for topic '" + name_ + "'");
    if (attendants_.promises != nullptr)
      attendants_.promises->watch(sides_[side]->get(), asked_, source_ + side);
  }

  template <class Visit>
  void for_each_side(const Visit& visit) const {
    for (std::size_t side = 0; side < kSides; ++side) {
      if (sides_[side]) visit(side, *sides_[side]);
    }
  }

  /// Samples of a reliable writer belong to the first reader. What else they tell, of the sensor's end, holds for the second, too.
  template <class Visit>
  static auto only_meant_for(std::size_t side, WriterBook& book, Visit& visit) {
    return [side, &book, &visit](const Message& message, dds_sample_info_t info) {
      if (side == 1 && info.valid_data && !book.is_best_effort(info.publication_handle)) {
        if (info.instance_state == DDS_ALIVE_INSTANCE_STATE) return;
        info.valid_data = false;  // an end may come with it alone
      }
      visit(side, message, info);
    };
  }

  dds_entity_t participant_;
  std::string name_;
  mutable std::mutex mutex_;  ///< for those who only count, while the second reader opens
  std::array<std::optional<TopicReader<Message>>, kSides> sides_;
  std::optional<Qos> second_;  ///< of the reader that is not needed yet
  Attendants attendants_;
  QosProfile asked_;
  std::size_t source_ = 0;
};

}  // namespace gyrod::bus
