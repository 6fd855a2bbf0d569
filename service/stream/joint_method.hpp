/// The two-speed estimator as a model method of the engine.
#pragma once

#include "core/joint/joint_options.hpp"
#include "stream/method.hpp"

namespace gyrod::stream {

/// core::JointFit on every window, core::KalmanBank on every sample.
/// A member of a bank that cannot be made of a window stays what the channel's last window made it (ModelFit::fallbacks), and the
/// level of the noise and the places of its lines are watched over windows: a model depends on the windows before it, too, in their order, but on
/// nothing else.
/// @param max_signal_hz what is faster counts as noise; 0 for no such limit. Takes effect once the sample rate is known.
[[nodiscard]] ModelMethodFactory joint_method(const core::JointOptions& options, double max_signal_hz = 0.0);

}  // namespace gyrod::stream
