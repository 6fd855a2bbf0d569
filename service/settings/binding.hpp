/// Which key of the configuration is which member of Settings: the one list that loading and the tests go
/// through.
#pragma once

#include "settings/settings.hpp"
#include "settings/topic_qos_json.hpp"

namespace gyrod::settings {

template <class Visit>
void visit_qos(BusSettings& bus, Visit& visit) {
  visit("bus.input.deadline_s", bus.input.qos.deadline_s);
  visit("bus.input.liveliness", bus.input.qos.liveliness);
  visit("bus.input.liveliness_lease_s", bus.input.qos.liveliness_lease_s);
  visit("bus.input.partitions", bus.input.qos.partitions);
  visit("bus.output.deadline_s", bus.output.qos.deadline_s);
  visit("bus.output.liveliness", bus.output.qos.liveliness);
  visit("bus.output.liveliness_lease_s", bus.output.qos.liveliness_lease_s);
  visit("bus.output.partitions", bus.output.qos.partitions);
  visit("bus.ros2.input_deadline_s", bus.ros2.input_qos.deadline_s);
  visit("bus.ros2.input_liveliness", bus.ros2.input_qos.liveliness);
  visit("bus.ros2.input_liveliness_lease_s", bus.ros2.input_qos.liveliness_lease_s);
  visit("bus.ros2.output_deadline_s", bus.ros2.output_qos.deadline_s);
  visit("bus.ros2.output_liveliness", bus.ros2.output_qos.liveliness);
  visit("bus.ros2.output_liveliness_lease_s", bus.ros2.output_qos.liveliness_lease_s);
  visit("bus.ros2.partitions", bus.ros2.input_qos.partitions);
}

template <class Visit>
void visit_bus(BusSettings& bus, Visit& visit) {
  visit("bus.domain", bus.domain);
  visit("bus.network", bus.network);
  visit("bus.max_batch_samples", bus.max_batch_samples);
  visit("bus.shard", bus.shard);
  visit("bus.topics.raw", bus.topics.raw);
  visit("bus.topics.raw_batch", bus.topics.raw_batch);
  visit("bus.topics.denoised", bus.topics.denoised);
  visit("bus.topics.denoised_batch", bus.topics.denoised_batch);
  visit("bus.topics.noise", bus.topics.noise);
  visit("bus.topics.health", bus.topics.health);
  visit("bus.topics.realtime", bus.topics.realtime);
  visit("bus.topics.realtime_batch", bus.topics.realtime_batch);
  visit("bus.input.reliability", bus.input.reliability);
  visit("bus.input.history_depth", bus.input.history_depth);
  visit("bus.input.max_messages", bus.input.max_messages);
  visit("bus.input.max_sensors", bus.input.max_sensors);
  visit("bus.input.durability", bus.input.durability);
  visit("bus.output.reliability", bus.output.reliability);
  visit("bus.output.history_depth", bus.output.history_depth);
  visit("bus.output.ownership_strength", bus.output.ownership_strength);
  visit("bus.output.takeover_s", bus.output.takeover_s);
  visit("bus.topic_qos", bus.topic_qos);
  visit("bus.ros2.topics", bus.ros2.topics);
  visit("bus.ros2.denoised_suffix", bus.ros2.denoised_suffix);
  visit("bus.ros2.realtime_suffix", bus.ros2.realtime_suffix);
  visit("bus.ros2.input_reliability", bus.ros2.input_reliability);
  visit("bus.ros2.output_reliability", bus.ros2.output_reliability);
  visit("bus.ros2.history_depth", bus.ros2.history_depth);
  visit("bus.ros2.max_topics", bus.ros2.max_topics);
  visit("bus.security.folder", bus.security.folder);
  visit("bus.security.warn_before_days", bus.security.warn_before_days);
}

template <class Visit>
void visit_algorithm(Settings& settings, Visit& visit) {
  visit("denoise.method", settings.denoise.method);
  visit("denoise.scheme", settings.denoise.scheme);
  visit("denoise.screening", settings.denoise.screening);
  visit("denoise.window_samples", settings.engine.window_samples);
  visit("denoise.hop_samples", settings.engine.hop_samples);
  visit("denoise.stretch_windows", settings.engine.stretch_windows);
  visit("denoise.lag_samples", settings.engine.lag_samples);
  visit("denoise.sample_rate_hz", settings.engine.sample_rate_hz);
  visit("denoise.sifts", settings.denoise.sifts);
  visit("denoise.boundary", settings.denoise.boundary);
  visit("denoise.max_ar_order", settings.denoise.max_ar_order);
  visit("denoise.max_signal_hz", settings.denoise.max_signal_hz);
  visit("noise.source", settings.noise.source);
  visit("noise.calibrations", settings.noise.calibrations);
  visit("noise.state_file", settings.noise.state_file);
  visit("limits.max_hop_samples", settings.engine.max_hop_samples);
  visit("limits.max_channels", settings.engine.max_channels);
  visit("limits.max_rate_radps", settings.engine.max_rate_radps);
  visit("limits.max_bridged_samples", settings.engine.max_bridged_samples);
  visit("limits.max_queued_windows", settings.engine.max_queued_windows);
  visit("limits.max_delay_s", settings.engine.max_delay_s);
  visit("limits.silent_after_s", settings.engine.silent_after_s);
  visit("limits.forget_after_s", settings.engine.forget_after_s);
}

template <class Visit>
void visit_health(stream::HealthOptions& health, Visit& visit) {
  visit("health.silent_after_s", health.silent_after_s);
  visit("health.stuck_after_s", health.stuck_after_s);
  visit("health.all_stuck_after_s", health.all_stuck_after_s);
  visit("health.range_radps", health.range_radps);
  visit("health.saturated_hold_s", health.saturated_hold_s);
  visit("health.noisy_ratio", health.noisy_ratio);
  visit("health.noisy_clear_ratio", health.noisy_clear_ratio);
  visit("health.noisy_after_s", health.noisy_after_s);
  visit("health.drift_sigmas", health.drift_sigmas);
  visit("health.lossy_share", health.lossy_share);
  visit("health.lossy_clear_share", health.lossy_clear_share);
  visit("health.loss_window_s", health.loss_window_s);
}

/// Calls visit(key, member) for every key of the configuration.
template <class Visit>
void for_each_key(Settings& settings, Visit&& visit) {
  visit_bus(settings.bus, visit);
  visit_qos(settings.bus, visit);
  visit_algorithm(settings, visit);
  visit_health(settings.engine.health, visit);
  visit("workers", settings.workers);
  visit("restart.published_file", settings.restart.published_file);
  visit("monitor.enabled", settings.monitor.enabled);
  visit("monitor.address", settings.monitor.address);
  visit("monitor.port", settings.monitor.port);
  visit("monitor.max_channel_series", settings.monitor.max_channel_series);
  visit("monitor.tls.certificate_file", settings.monitor.tls.certificate_file);
  visit("monitor.tls.key_file", settings.monitor.tls.key_file);
  visit("monitor.auth.token_file", settings.monitor.auth.token_file);
  visit("monitor.auth.users_file", settings.monitor.auth.users_file);
  visit("monitor.allow_insecure", settings.monitor.allow_insecure);
  visit("stop.deadline_s", settings.stop_deadline_s);
  visit("log.level", settings.log_level);
}

}  // namespace gyrod::settings
