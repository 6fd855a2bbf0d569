#include "app/options.hpp"

#include <algorithm>
#include <iterator>
#include <thread>

#include "app/version.hpp"
#include "stream/joint_method.hpp"
#include "stream/paper_method.hpp"

namespace gyrod::app {
namespace {

bus::Reliability reliability(settings::Reliability setting) noexcept {
  return setting == settings::Reliability::kReliable ? bus::Reliability::kReliable
                                                     : bus::Reliability::kBestEffort;
}

bus::InputReliability input_reliability(settings::InputReliability setting) noexcept {
  switch (setting) {
    case settings::InputReliability::kReliable:
      return bus::InputReliability::kReliable;
    case settings::InputReliability::kBestEffort:
      return bus::InputReliability::kBestEffort;
    case settings::InputReliability::kAuto:
      break;
  }
  return bus::InputReliability::kAuto;
}

bus::QosProfile profile(const settings::QosSettings& settings) {
  const bool automatic = settings.liveliness == settings::Liveliness::kAutomatic;
  return {.deadline_s = settings.deadline_s,
          .liveliness = automatic ? bus::Liveliness::kAutomatic : bus::Liveliness::kManualByTopic,
          .lease_s = settings.liveliness_lease_s,
          .partitions = settings.partitions};
}

std::optional<bus::Liveliness> liveliness(std::optional<settings::Liveliness> kind) {
  if (!kind) return {};
  return *kind == settings::Liveliness::kAutomatic ? bus::Liveliness::kAutomatic
                                                   : bus::Liveliness::kManualByTopic;
}

bus::TopicQos topic_qos(const settings::TopicQosSettings& settings) {
  return {.topic = settings.topic,
          .reliability =
              settings.reliability ? std::optional(input_reliability(*settings.reliability)) : std::nullopt,
          .depth = settings.history_depth,
          .deadline_s = settings.deadline_s,
          .liveliness = liveliness(settings.liveliness),
          .lease_s = settings.liveliness_lease_s,
          .partitions = settings.partitions};
}

core::ScreeningRule rule_of(settings::Screening screening) noexcept {
  switch (screening) {
    case settings::Screening::kPaper:
      return core::ScreeningRule::kPaper;
    case settings::Screening::kSignificance:
      return core::ScreeningRule::kSignificance;
    case settings::Screening::kWindowed:
      break;
  }
  return core::ScreeningRule::kWindowed;
}

}  // namespace

bus::BusOptions bus_options(const settings::BusSettings& settings) {
  bus::BusOptions options;
  options.domain_id = settings.domain;
  options.network = settings.network;
  options.topics = {.raw = settings.topics.raw,
                    .raw_batch = settings.topics.raw_batch,
                    .denoised = settings.topics.denoised,
                    .denoised_batch = settings.topics.denoised_batch,
                    .noise = settings.topics.noise,
                    .health = settings.topics.health,
                    .realtime = settings.topics.realtime,
                    .realtime_batch = settings.topics.realtime_batch};
  options.input_reliability = input_reliability(settings.input.reliability);
  const bool keep_all = settings.input.history_depth == 0;
  options.input_history = keep_all ? bus::History::kKeepAll : bus::History::kKeepLast;
  if (!keep_all) options.input_depth = settings.input.history_depth;
  options.input_max_messages = settings.input.max_messages;
  options.max_instances = settings.input.max_sensors;
  options.output_reliability = reliability(settings.output.reliability);
  options.output_depth = settings.output.history_depth;
  options.input_past = settings.input.durability == settings::Durability::kTransientLocal;
  options.ownership_strength = settings.output.ownership_strength;
  options.takeover_s = settings.output.takeover_s;
  options.max_batch_samples = settings.max_batch_samples;
  options.shard = fleet::parse_shard(settings.shard);
  options.input = profile(settings.input.qos);
  options.output = profile(settings.output.qos);
  std::ranges::transform(settings.topic_qos, std::back_inserter(options.topic_qos), topic_qos);
  options.ros2.topics = settings.ros2.topics;
  options.ros2.outputs = {.denoised_suffix = settings.ros2.denoised_suffix,
                          .realtime_suffix = settings.ros2.realtime_suffix};
  options.ros2.input_reliability = input_reliability(settings.ros2.input_reliability);
  options.ros2.output_reliability = reliability(settings.ros2.output_reliability);
  options.ros2.depth = settings.ros2.history_depth;
  options.ros2.max_topics = settings.ros2.max_topics;
  options.ros2.input = profile(settings.ros2.input_qos);
  options.ros2.output = profile(settings.ros2.output_qos);
  options.ros2.output.partitions = options.ros2.input.partitions;
  return options;
}

bus::BusOptions live_bus_options(const settings::Settings& settings) {
  bus::BusOptions options = bus_options(settings.bus);
  options.realtime = is_model_method(settings.denoise);
  options.ros2.max_held_messages = stream::most_held_samples(settings.engine) + 1;  // one is on its way in
  return options;
}

std::size_t worker_threads(const settings::Settings& settings) {
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  return settings.workers > 0 ? settings.workers : cores;
}

stream::EngineOptions live_engine_options(const settings::Settings& settings, NoiseSources& noise,
                                          PublishedFile& published) {
  stream::EngineOptions options = settings.engine;
  options.workers = worker_threads(settings);
  noise.attach_to(options, is_model_method(settings.denoise));
  if (settings.bus.input.durability == settings::Durability::kTransientLocal) {
    options.published_before = [&published](std::string_view sensor) {
      return published.take_before(sensor);
    };
  }
  return options;
}

stream::EngineOptions offline_engine_options(const settings::Settings& settings, NoiseSources& noise) {
  stream::EngineOptions options = settings.engine;
  options.workers = 0;
  options.max_channels = 1;
  noise.attach_to(options, is_model_method(settings.denoise));
  return options;
}

core::DenoiserOptions denoiser_options(const settings::DenoiseSettings& settings) {
  core::DenoiserOptions options;
  options.scheme = settings.scheme;
  options.emd.sifts = settings.sifts;
  options.emd.boundary = settings.boundary;
  options.screening.rule = rule_of(settings.screening);
  options.max_ar_order = settings.max_ar_order;
  return options;
}

core::JointOptions joint_options(const settings::Settings& settings) {
  core::JointOptions options;
  options.emd.sifts = settings.denoise.sifts;
  options.emd.boundary = settings.denoise.boundary;
  options.hop_samples = settings.engine.hop_samples;
  return options;
}

stream::MethodFactory method(const settings::Settings& settings) {
  const settings::DenoiseSettings& denoise = settings.denoise;
  if (denoise.method == settings::Method::kPaper) return stream::paper_method(denoiser_options(denoise));
  return stream::joint_method(joint_options(settings), denoise.max_signal_hz);
}

bool is_model_method(const settings::DenoiseSettings& settings) noexcept {
  return settings.method == settings::Method::kJoint;
}

monitor::MonitorOptions monitor_options(const settings::MonitorSettings& settings) {
  monitor::MonitorOptions options;
  options.address = settings.address;
  options.port = settings.port;
  options.max_channel_series = settings.max_channel_series;
  options.access = {.certificate_file = settings.tls.certificate_file,
                    .key_file = settings.tls.key_file,
                    .token_file = settings.auth.token_file,
                    .users_file = settings.auth.users_file};
  options.version = version();
  return options;
}

}  // namespace gyrod::app
