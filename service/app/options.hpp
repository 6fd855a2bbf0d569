/// From the configuration's words to the options of the rooms.
#pragma once

#include "app/noise_sources.hpp"
#include "app/published_file.hpp"
#include "bus/bus_options.hpp"
#include "core/denoise/denoiser.hpp"
#include "core/joint/joint_options.hpp"
#include "monitor/monitor.hpp"
#include "settings/settings.hpp"
#include "stream/engine.hpp"
#include "stream/method.hpp"

namespace gyrod::app {

[[nodiscard]] bus::BusOptions bus_options(const settings::BusSettings& settings);
/// The same for the daemon, which offers the topics that its method fills.
[[nodiscard]] bus::BusOptions live_bus_options(const settings::Settings& settings);

/// As many as the settings say, or as there are processor cores.
[[nodiscard]] std::size_t worker_threads(const settings::Settings& settings);

/// For the daemon: with worker_threads().
/// @param noise, published have to outlive the engine
[[nodiscard]] stream::EngineOptions live_engine_options(const settings::Settings& settings,
                                                        NoiseSources& noise, PublishedFile& published);

/// For one recording: the same windows and limits, computed in the calling thread.
/// @param noise has to outlive the engine
[[nodiscard]] stream::EngineOptions offline_engine_options(const settings::Settings& settings,
                                                           NoiseSources& noise);

[[nodiscard]] core::DenoiserOptions denoiser_options(const settings::DenoiseSettings& settings);
[[nodiscard]] core::JointOptions joint_options(const settings::Settings& settings);
[[nodiscard]] stream::MethodFactory method(const settings::Settings& settings);
/// Whether it is a model method: one that also estimates without look-ahead.
[[nodiscard]] bool is_model_method(const settings::DenoiseSettings& settings) noexcept;
[[nodiscard]] monitor::MonitorOptions monitor_options(const settings::MonitorSettings& settings);

}  // namespace gyrod::app
