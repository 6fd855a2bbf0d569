/// Daemons of one fleet for tests of bus/, and others that write to their topic.
#pragma once

#include <cstdio>
#include <optional>

#include <gmock/gmock.h>

#include "bus/entity.hpp"
#include "bus/fleet_hand_overs.hpp"
#include "bus/fleet_members.hpp"
#include "bus/loan.hpp"
#include "bus/qos.hpp"
#include "bus/topic_writer.hpp"
#include "bus/writer_identity.hpp"
#include "unit/bus/bus_test.hpp"

namespace gyrod::bus::test {
/// Sensors of all shards of two.
inline std::vector<GivenUp> sensors() {
  return {{"imu_1", {101, 1'001}}, {"imu_2", {102, 1'002}}, {"imu_3", {103, 1'003}}, {"imu_4", {104, 1'004}}};
}

/// Those that the first rule serves, and the second does not.
inline std::vector<GivenUp> given_up(const fleet::ServingRule& first, const fleet::ServingRule& second) {
  std::vector<GivenUp> given = sensors();
  std::erase_if(given,
                [&](const GivenUp& one) { return !first.serves(one.sensor) || second.serves(one.sensor); });
  return given;
}

/// Serves sensors(), and keeps what it is told.
class Handler final : public FleetHandler {
 public:
  std::vector<GivenUp> on_rule(const fleet::ServingRule& rule, bool told) noexcept override {
    const std::lock_guard lock(mutex_);
    const fleet::ServingRule before = rules_.empty() ? fleet::ServingRule{rule.own} : rules_.back();
    rules_.push_back(rule);
    told_ = told;
    return given_up(before, rule);
  }
  std::vector<GivenUp> on_leave() noexcept override { return given_up(rule(), {rule().own}); }
  void on_given_up(std::span<const GivenUp> given) noexcept override {
    const std::lock_guard lock(mutex_);
    heard_.assign(given.begin(), given.end());
  }
  void on_standing(const fleet::Standing& /*standing*/) noexcept override {}

  [[nodiscard]] std::vector<fleet::ServingRule> rules() const {
    const std::lock_guard lock(mutex_);
    return rules_;
  }
  [[nodiscard]] fleet::ServingRule rule() const { return rules().back(); }
  /// With the last rule.
  [[nodiscard]] bool told() const {
    const std::lock_guard lock(mutex_);
    return told_;
  }
  /// What others gave up last.
  [[nodiscard]] std::vector<GivenUp> heard() const {
    const std::lock_guard lock(mutex_);
    return heard_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<fleet::ServingRule> rules_;
  bool told_ = false;
  std::vector<GivenUp> heard_;
};

/// Too short for a network, and long enough for one process.
inline constexpr FleetTimes kShort{.listening_s = 0.2, .joining_s = 0.05, .longest_s = 60.0};

/// One daemon.
class Member {
 public:
  Member(const Domain& domain, BusOptions options, std::optional<fleet::Shard> shard,
         FleetTimes times = kShort)
      : options_(std::move(options)),
        publisher_(domain, with(shard)),
        members_(domain, publisher_, options_, handler_, times) {
    members_.start();
  }

  [[nodiscard]] fleet::Standing standing() const { return members_.standing(); }
  [[nodiscard]] const Handler& handler() const { return handler_; }
  [[nodiscard]] bool is_active() const { return standing().active; }
  void leave() { members_.leave(); }

 private:
  const BusOptions& with(std::optional<fleet::Shard> shard) {
    options_.shard = shard;
    return options_;
  }

  BusOptions options_;
  Publisher publisher_;
  Handler handler_;
  FleetMembers members_;
};

/// A writer of another program on the topic, with user data of its own.
class Stranger {
 public:
  Stranger(const Domain& domain, const BusOptions& options, const std::string& text)
      : domain_(domain),
        writer_(domain_.participant(), options.topics.denoised, output_writer_qos(options).user_data(text)) {}

  [[nodiscard]] std::string id() const { return guid_of(writer_.get()); }

  void tell(const std::string& text) const {
    Qos qos;
    qos.user_data(text);
    ASSERT_EQ(dds_set_qos(writer_.get(), qos.get()), DDS_RETCODE_OK);
  }

 private:
  Domain domain_;
  TopicWriter<gyrod_DenoisedSample> writer_;
};

class FleetMembersTest : public BusTest {
 protected:
  /// What the newest writer of the topic that shows a user data tells, as another program reads it; the id it has among all.
  struct Told {
    std::string id;
    std::string text;
  };
  [[nodiscard]] Told look() {
    const Loan<dds_builtintopic_endpoint_t> loan(publications_.get());
    for (std::size_t i = 0; i < loan.size(); ++i) {
      const dds_builtintopic_endpoint_t& writer = loan.message(i);
      if (!loan.info(i).valid_data || writer.topic_name != options_.topics.denoised) continue;
      void* data = nullptr;
      std::size_t size = 0;
      told_.text.clear();
      if (dds_qget_userdata(writer.qos, &data, &size)) told_.text = {static_cast<char*>(data), size};
      dds_free(data);
      told_.id.clear();
      for (const std::uint8_t byte : writer.key.v) {
        char hex[3];
        std::snprintf(hex, sizeof hex, "%02x", static_cast<unsigned>(byte));
        told_.id += hex;
      }
    }
    return told_;
  }

  const Domain here_ = reader_domain();
  const Domain there_ = writer_domain();

 private:
  Entity publications_{
      dds_create_reader(there_.participant(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr), "look"};
  Told told_;
};

}  // namespace gyrod::bus::test
