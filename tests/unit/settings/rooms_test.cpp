// A default in the configuration is the default of the room that it is for: what runs without a configuration
// (tests, examples, offline use) runs as with an empty one. Only the app may know both sides, and this test.
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bus/bus_options.hpp"
#include "core/denoise/denoiser.hpp"
#include "monitor/monitor.hpp"
#include "settings/load.hpp"
#include "settings/schema.hpp"
#include "settings/settings.hpp"
#include "stream/engine.hpp"
#include "stream/paper_method.hpp"

namespace gyrod::settings {
namespace {

void expect_same(const QosSettings& settings, const bus::QosProfile& room) {
  EXPECT_EQ(settings.deadline_s, room.deadline_s);
  EXPECT_EQ(settings.liveliness == Liveliness::kAutomatic, room.liveliness == bus::Liveliness::kAutomatic);
  EXPECT_EQ(settings.liveliness_lease_s, room.lease_s);
  EXPECT_EQ(settings.partitions, room.partitions);
}

TEST(SettingsRooms, DenoiserDefaultsAgree) {
  const core::DenoiserOptions room;
  const DenoiseSettings settings;
  EXPECT_EQ(settings.sifts, room.emd.sifts);
  EXPECT_EQ(settings.boundary, room.emd.boundary);
  EXPECT_EQ(settings.max_ar_order, room.max_ar_order);
  EXPECT_EQ(settings.screening, Screening::kWindowed);
  EXPECT_EQ(room.screening.rule, core::ScreeningRule::kWindowed);
  EXPECT_EQ(schema_at({"denoise", "max_ar_order"})->at("maximum"), core::kMaxArOrder);
}

/// The engine's side of a seam that this test does not use.
class Nowhere final : public stream::Sink {
  void on_samples(std::string_view, std::span<const stream::DenoisedSample>) noexcept override {}
  void on_report(std::string_view, const stream::NoiseReport&) noexcept override {}
  void on_end(std::string_view) noexcept override {}
};

/// The configuration that gives every number of the groups `denoise` and `limits` its smallest or largest
/// value.
nlohmann::json at_bounds(const std::string& bound) {
  nlohmann::json document;
  for (const std::string group : {"denoise", "limits"}) {
    for (const auto& [key, node] : schema_at({group})->at("properties").items()) {
      if (node.contains(bound)) document[group][key] = node.at(bound);
    }
  }
  return document;
}

TEST(SettingsRooms, WhatTheSchemaAcceptsTheEngineAndTheDenoiserAccept) {
  for (const std::string bound : {"minimum", "maximum"}) {
    nlohmann::json document = at_bounds(bound);
    document["denoise"]["method"] = "paper";  // joint looks ahead less far
    if (bound == "maximum") document["bus"]["input"]["max_sensors"] = document["limits"]["max_channels"];
    const Outcome outcome = read_settings(document.dump(), ".");
    ASSERT_TRUE(outcome.issues.empty()) << outcome.issues.front().message;
    stream::EngineOptions engine = outcome.settings.engine;
    engine.workers = 0;
    core::DenoiserOptions denoiser;
    denoiser.emd.sifts = outcome.settings.denoise.sifts;
    denoiser.max_ar_order = outcome.settings.denoise.max_ar_order;
    Nowhere nowhere;
    EXPECT_NO_THROW(stream::Engine(engine, stream::paper_method(denoiser), nowhere)) << bound;
  }
}

TEST(SettingsRooms, BusDefaultsAgree) {
  const bus::BusOptions room;
  const BusSettings settings;
  EXPECT_EQ(settings.domain, room.domain_id);
  EXPECT_EQ(settings.network, room.network);
  EXPECT_EQ(settings.topics.raw, room.topics.raw);
  EXPECT_EQ(settings.topics.raw_batch, room.topics.raw_batch);
  EXPECT_EQ(settings.topics.denoised, room.topics.denoised);
  EXPECT_EQ(settings.topics.denoised_batch, room.topics.denoised_batch);
  EXPECT_EQ(settings.topics.noise, room.topics.noise);
  EXPECT_EQ(settings.topics.realtime, room.topics.realtime);
  EXPECT_EQ(settings.topics.realtime_batch, room.topics.realtime_batch);
  EXPECT_EQ(settings.input.reliability == InputReliability::kAuto,
            room.input_reliability == bus::InputReliability::kAuto);
  EXPECT_EQ(settings.ros2.input_reliability == InputReliability::kAuto,
            room.ros2.input_reliability == bus::InputReliability::kAuto);
  expect_same(settings.input.qos, room.input);
  expect_same(settings.output.qos, room.output);
  expect_same(settings.ros2.input_qos, room.ros2.input);
  expect_same(settings.ros2.output_qos, room.ros2.output);
  EXPECT_EQ(settings.input.history_depth == 0, room.input_history == bus::History::kKeepAll);
  EXPECT_EQ(settings.input.max_messages, room.input_max_messages);
  EXPECT_EQ(settings.input.max_sensors, room.max_instances);
  EXPECT_EQ(settings.output.reliability == Reliability::kReliable,
            room.output_reliability == bus::Reliability::kReliable);
  EXPECT_EQ(settings.output.history_depth, room.output_depth);
  EXPECT_EQ(settings.output.ownership_strength, room.ownership_strength);
  EXPECT_EQ(settings.output.takeover_s, room.takeover_s);
  EXPECT_EQ(settings.input.durability == Durability::kTransientLocal, room.input_past);
  EXPECT_EQ(settings.max_batch_samples, room.max_batch_samples);
}

TEST(SettingsRooms, BusRangesAreThoseDocumentedAtTheBus) {
  // From the comments in bus/bus_options.hpp.
  const std::vector<std::pair<std::vector<std::string>, std::pair<int, int>>> documented = {
      {{"bus", "domain"}, {0, 230}},
      {{"bus", "max_batch_samples"}, {1, 65'536}},
      {{"bus", "input", "history_depth"}, {0, 65'536}},  // 0: keep all
      {{"bus", "input", "max_messages"}, {16, 1'000'000}},
      {{"bus", "input", "max_sensors"}, {1, 1'000'000}},
      {{"bus", "output", "history_depth"}, {1, 65'536}}};
  for (const auto& [path, bounds] : documented) {
    EXPECT_EQ(schema_at(path)->at("minimum"), bounds.first) << path.back();
    EXPECT_EQ(schema_at(path)->at("maximum"), bounds.second) << path.back();
  }
}

TEST(SettingsRooms, MonitorDefaultsAgree) {
  const monitor::MonitorOptions room;
  const MonitorSettings settings;
  EXPECT_EQ(settings.address, room.address);
  EXPECT_EQ(settings.port, room.port);
  EXPECT_EQ(settings.max_channel_series, room.max_channel_series);
  EXPECT_FALSE(room.access.uses_tls() || room.access.asks_who());
  EXPECT_EQ(settings.tls.certificate_file + settings.tls.key_file, "");
  EXPECT_EQ(settings.auth.token_file + settings.auth.users_file, "");
  EXPECT_FALSE(settings.allow_insecure);
}

}  // namespace
}  // namespace gyrod::settings
