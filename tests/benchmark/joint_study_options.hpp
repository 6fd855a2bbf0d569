/// What the command line of joint_study says.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <type_traits>

#include "core/joint/joint_options.hpp"

namespace gyrod::benchmark {

using Arguments = std::map<std::string, std::string>;

inline double number(const Arguments& arguments, const std::string& key, double standard) {
  const auto found = arguments.find(key);
  return found == arguments.end() ? standard : std::stod(found->second);
}

/// The estimator's, as far as arguments are called like them.
inline core::JointOptions options_of(const Arguments& arguments) {
  core::JointOptions options;
  const auto set = [&arguments](const char* key, auto& member) {
    member = static_cast<std::decay_t<decltype(member)>>(number(arguments, key, static_cast<double>(member)));
  };
  options.hop_samples = static_cast<std::size_t>(number(arguments, "hop", 32));
  set("least_excess", options.least_excess);
  set("slow_period_samples", options.slow_period_samples);
  set("tapers", options.tapers);
  set("recency", options.recency);
  set("pruned_recency", options.pruned_recency);
  set("full_iterations", options.full_iterations);
  set("pruned_iterations", options.pruned_iterations);
  set("final_iterations", options.final_iterations);
  set("shrinkage", options.shrinkage);
  set("bandwidth_cycles", options.bandwidth_cycles);
  set("tone_prominence", options.tone_prominence);
  set("tone_pole", options.tone_pole);
  set("resonances", options.resonances);
  set("resonance_gain", options.resonance_gain);
  set("resonance_iterations", options.resonance_iterations);
  set("prune_gain", options.prune_gain);
  set("pole_factor", options.pole_factor);
  set("level_pole", options.level_pole);
  set("slope_pole", options.slope_pole);
  set("agile_drive", options.agile_drive);
  set("rough_drive", options.rough_drive);
  set("still_drive", options.still_drive);
  set("agile_log_prior", options.agile_log_prior);
  set("rough_log_prior", options.rough_log_prior);
  set("hand_over_memory", options.hand_over_memory);
  set("still_log_prior", options.still_log_prior);
  set("lasting_windows", options.lasting_windows);
  set("lasting_iterations", options.lasting_iterations);
  set("lasting_final_iterations", options.lasting_final_iterations);
  set("lasting_resonance_gain", options.lasting_resonance_gain);
  set("lasting_prune_gain", options.lasting_prune_gain);
  set("lasting_log_prior", options.lasting_log_prior);
  set("full_evidence", options.full_evidence);
  set("least_full_prior", options.least_full_prior);
  set("switching_rate", options.switching_rate);
  set("likelihood_power", options.likelihood_power);
  set("most_evidence", options.most_evidence);
  set("hindsight_rate", options.hindsight_rate);
  set("hand_over_samples", options.hand_over_samples);
  set("correction_rate", options.correction_rate);
  set("still_correction", options.still_correction);
  set("motion_mean", options.motion_mean);
  set("motion_memory", options.motion_memory);
  set("motion_low", options.motion_low);
  set("motion_high", options.motion_high);
  set("motion_steady", options.motion_steady);
  set("motion_sure", options.motion_sure);
  set("correction_share", options.correction_share);
  set("steady_correction", options.steady_correction);
  set("most_steady_correction", options.most_steady_correction);
  set("late_steady_correction", options.late_steady_correction);
  set("most_late_steady_correction", options.most_late_steady_correction);
  set("residual_weight", options.residual_weight);
  set("residual_decay", options.residual_decay);
  set("steady_memory", options.steady_memory);
  set("most_gain", options.most_gain);
  set("gain_ridge", options.gain_ridge);
  set("gain_clip", options.gain_clip);
  set("gain_band", options.gain_band);
  set("gain_follow", options.gain_follow);
  set("gain_mean", options.gain_mean);
  set("gain_memory", options.gain_memory);
  set("most_later_gain", options.most_later_gain);
  set("most_later_loss", options.most_later_loss);
  set("later_follow", options.later_follow);
  set("later_memory", options.later_memory);
  set("residual_limit", options.residual_limit);
  set("residual_mean_limit", options.residual_mean_limit);
  set("residual_memory", options.residual_memory);
  set("lone_limit", options.lone_limit);
  set("knock_ratio", options.knock_ratio);
  set("knock_tail", options.knock_tail);
  set("knock_share", options.knock_share);
  set("line_least_half_width", options.line.least_half_width);
  set("line_half_width", options.line.half_width);
  set("line_resolution", options.line.resolution);
  set("line_drift", options.line.drift);
  set("line_leak", options.line.leak);
  set("line_reach", options.line.reach);
  set("variance_factor", options.variance_factor);
  return options;
}

}  // namespace gyrod::benchmark
