#include "bus/mismatch_watch.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "bus/entity.hpp"
#include "bus/loan.hpp"
#include "bus/log.hpp"
#include "bus/mismatch_text.hpp"
#include "bus/peer_name.hpp"
#include "bus/qos_match.hpp"
#include "bus/topic_type.hpp"

namespace gyrod::bus {
namespace {

using Guid = std::array<std::uint8_t, sizeof(dds_guid_t::v)>;

/// Endpoints of others that are kept track of, and that are warned of.
constexpr std::size_t kMostPeers = 4096;
constexpr std::size_t kMostWarnings = 256;
/// What comes together is looked at together.
constexpr dds_duration_t kSettle = DDS_MSECS(500);

Guid bytes_of(const dds_guid_t& guid) {
  Guid bytes{};
  std::memcpy(bytes.data(), guid.v, bytes.size());
  return bytes;
}

struct DeleteQos {
  void operator()(dds_qos_t* qos) const noexcept { dds_delete_qos(qos); }
};

/// A writer or a reader, as discovery tells.
struct KnownEnd {
  explicit KnownEnd(const dds_builtintopic_endpoint_t& told)
      : topic(told.topic_name),
        type(told.type_name),
        participant(told.participant_key),
        qos(dds_create_qos()) {
    (void)dds_copy_qos(qos.get(), told.qos);
  }
  std::string topic;
  std::string type;
  dds_guid_t participant;
  std::unique_ptr<dds_qos_t, DeleteQos> qos;
};

/// The endpoints of one direction: writers that we read from and our readers, or the other way round.
struct Ends {
  Direction direction;
  std::map<Guid, KnownEnd> ours;
  std::map<Guid, KnownEnd> theirs;
  std::set<Guid> warned;
};

}  // namespace

class MismatchWatch::Impl {
 public:
  Impl(Domain domain, BusOptions options)
      : domain_(std::move(domain)),
        options_(std::move(options)),
        publications_(create_reader(DDS_BUILTIN_TOPIC_DCPSPUBLICATION)),
        subscriptions_(create_reader(DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION)),
        published_(dds_create_readcondition(publications_.get(), DDS_ANY_STATE), kAttempt),
        subscribed_(dds_create_readcondition(subscriptions_.get(), DDS_ANY_STATE), kAttempt),
        waitset_(dds_create_waitset(domain_.participant()), kAttempt) {
    check(dds_get_guid(domain_.participant(), &self_), kAttempt);
    for (const dds_entity_t condition : {published_.get(), subscribed_.get(), waitset_.get()})
      check(dds_waitset_attach(waitset_.get(), condition, 0), kAttempt);
    thread_ = std::thread([this] { work(); });
  }

  ~Impl() {
    stopping_.store(true, std::memory_order_relaxed);
    (void)dds_waitset_set_trigger(waitset_.get(), true);
    thread_.join();
  }

  [[nodiscard]] std::vector<PeerMismatch> mismatches() const {
    const std::lock_guard lock(mutex_);
    std::vector<PeerMismatch> found;
    for (std::size_t direction = 0; direction < kDirections; ++direction) {
      for (std::size_t policy = 0; policy < kPolicies; ++policy)
        found.push_back({kDirectionNames[direction], kPolicyNames[policy], counts_[direction][policy]});
    }
    return found;
  }

 private:
  static constexpr const char* kAttempt = "watch for peers that do not match";
  using Counts = std::array<std::array<std::size_t, kPolicies>, kDirections>;

  [[nodiscard]] Entity create_reader(dds_entity_t topic) const {
    return {dds_create_reader(domain_.participant(), topic, nullptr, nullptr), kAttempt};
  }

  void work() noexcept {
    dds_time_t due = DDS_NEVER;
    while (!stopping_.load(std::memory_order_relaxed)) {
      (void)dds_waitset_wait_until(waitset_.get(), nullptr, 0, due);
      const bool writers = look(publications_.get(), input_.theirs, output_.ours);
      const bool readers = look(subscriptions_.get(), output_.theirs, input_.ours);
      if ((writers || readers) && due == DDS_NEVER) due = dds_time() + kSettle;
      if (dds_time() < due) continue;
      judge();
      due = DDS_NEVER;
    }
  }

  /// Takes what discovery has told. @return whether anything of it concerns us
  bool look(dds_entity_t reader, std::map<Guid, KnownEnd>& theirs, std::map<Guid, KnownEnd>& ours) {
    bool concerned = false;
    while (true) {
      const Loan<dds_builtintopic_endpoint_t> loan(reader);
      if (loan.size() == 0) return concerned;
      for (std::size_t i = 0; i < loan.size(); ++i) {
        const dds_builtintopic_endpoint_t& told = loan.message(i);
        const Guid key = bytes_of(told.key);
        if (loan.info(i).instance_state != DDS_ALIVE_INSTANCE_STATE) {
          concerned = theirs.erase(key) + ours.erase(key) > 0 || concerned;
        } else if (loan.info(i).valid_data) {
          const bool own = bytes_of(told.participant_key) == bytes_of(self_);
          if (!own && (!concerns_us(told.topic_name) || theirs.size() == kMostPeers)) continue;
          (own ? ours : theirs).insert_or_assign(key, KnownEnd(told));
          concerned = true;
        }
      }
    }
  }

  /// Topics of ours, also those that are not open yet.
  [[nodiscard]] bool concerns_us(std::string_view topic) const {
    const TopicNames& names = options_.topics;
    for (const std::string* name : {&names.raw, &names.raw_batch, &names.denoised, &names.denoised_batch,
                                    &names.noise, &names.realtime, &names.realtime_batch}) {
      if (topic == *name) return true;
    }
    const auto is_input = [topic](const std::string& pattern) { return ros2::matches(pattern, topic); };
    return std::ranges::any_of(options_.ros2.topics, is_input) ||
           ros2::is_output(topic, options_.ros2.outputs);
  }

  void judge() {
    Counts counts{};
    for (Ends* side : {&input_, &output_}) {
      for (const auto& [key, peer] : side->theirs) {
        const auto found = mismatch(*side, peer);
        if (found.empty()) continue;
        ++counts[static_cast<std::size_t>(side->direction)][static_cast<std::size_t>(found.front().policy)];
        warn(*side, key, peer, found);
      }
      std::erase_if(side->warned, [side](const Guid& key) { return !side->theirs.contains(key); });
    }
    const std::lock_guard lock(mutex_);
    counts_ = counts;
  }

  /// What keeps the peer from all of ours of its topic; nothing where it matches one of them, or there is none that it could match.
  [[nodiscard]] std::vector<Difference> mismatch(const Ends& side, const KnownEnd& peer) const {
    std::vector<Difference> least;
    for (const auto& [key, own] : side.ours) {
      if (own.topic != peer.topic) continue;
      const bool reads = side.direction == Direction::kInput;
      const KnownEnd& writer = reads ? peer : own;
      const KnownEnd& reader = reads ? own : peer;
      if (!share_partition(writer.qos.get(), reader.qos.get())) continue;
      auto found =
          writer.type == reader.type
              ? differences(writer.qos.get(), reader.qos.get())
              : std::vector{Difference{Policy::kType, printable(writer.type), printable(reader.type)}};
      // A second reader opens for best-effort writers.
      if (reads && is_auto(peer.topic))
        std::erase_if(found, [](const Difference& one) { return one.policy == Policy::kReliability; });
      if (found.empty()) return {};
      if (least.empty() || found.size() < least.size()) least = std::move(found);
    }
    return least;
  }

  [[nodiscard]] bool is_auto(const std::string& topic) const {
    const BusOptions own = for_topic(options_, topic);
    const bool is_raw = topic == own.topics.raw || topic == own.topics.raw_batch;
    return (is_raw ? own.input_reliability : own.ros2.input_reliability) == InputReliability::kAuto;
  }

  void warn(Ends& side, const Guid& key, const KnownEnd& peer, const std::vector<Difference>& found) {
    if (side.warned.contains(key) || warnings_ == kMostWarnings) return;
    side.warned.insert(key);
    const bool ros2 = ros2::is_topic(peer.topic);
    log(LogLevel::kWarning,
        mismatch_text({side.direction, peer.topic, name_of_participant(domain_, peer.participant), ros2},
                      found));
    if (++warnings_ == kMostWarnings) {
      log(LogLevel::kWarning,
          std::to_string(kMostWarnings) +
              " writers and readers that do not match were named; further ones are only counted");
    }
  }

  Domain domain_;
  BusOptions options_;
  dds_guid_t self_{};
  Entity publications_;
  Entity subscriptions_;
  Entity published_;
  Entity subscribed_;
  Entity waitset_;
  Ends input_{Direction::kInput, {}, {}, {}};
  Ends output_{Direction::kOutput, {}, {}, {}};
  std::size_t warnings_ = 0;
  mutable std::mutex mutex_;
  Counts counts_{};  ///< behind the mutex
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

MismatchWatch::MismatchWatch(const Domain& domain, const BusOptions& options)
    : impl_(std::make_unique<Impl>(domain, options)) {}
MismatchWatch::~MismatchWatch() = default;

std::vector<PeerMismatch> MismatchWatch::mismatches() const { return impl_->mismatches(); }

}  // namespace gyrod::bus
