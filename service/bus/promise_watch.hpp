/// Writers that do not keep what they promised. Internal to bus/: includes Cyclone's headers.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "bus/domain.hpp"
#include "bus/entity.hpp"
#include "bus/qos_profile.hpp"

namespace gyrod::bus {

/// Gathers what DDS tells, on threads of its own, of deadlines missed and of writers that give no sign of life, for the thread that takes
/// messages. watch() and take() belong to that thread.
class PromiseWatch {
 public:
  struct Event {
    enum class Kind {
      kDeadlineMissed,  ///< handle: of the sensor's instance in the reader
      kLivelinessLost,  ///< handle: of the writer
      kWriterBack,      ///< handle: of the writer: it lives again, or is gone for good
    };
    Kind kind;
    std::size_t source;  ///< of the reader, see watch()
    dds_instance_handle_t handle;
  };

  /// @throws BusError
  explicit PromiseWatch(const Domain& domain);

  /// Listens to a reader that asks for promises; to one that asks for none there is nothing to listen. The reader has to be gone before
  /// this, and nobody else may listen to it.
  void watch(dds_entity_t reader, const QosProfile& asked, std::size_t source);

  /// Holds while there are events: for a waitset.
  [[nodiscard]] dds_entity_t condition() const noexcept { return guard_.get(); }

  /// What has happened since the last call. Of a flood only the first; a sensor that is left out is found silent by its time.
  [[nodiscard]] std::vector<Event> take();

 private:
  struct Ear {
    PromiseWatch* watch;
    std::size_t source;
  };

  static void on_deadline_missed(dds_entity_t reader, dds_requested_deadline_missed_status_t status,
                                 void* ear);
  static void on_liveliness_changed(dds_entity_t reader, dds_liveliness_changed_status_t status, void* ear);
  void add(const Event& event);

  Entity guard_;
  std::vector<std::unique_ptr<Ear>> ears_;
  std::mutex mutex_;
  std::vector<Event> events_;
};

}  // namespace gyrod::bus
