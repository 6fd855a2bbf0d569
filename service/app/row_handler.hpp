/// Where the rows of a denoised recording go.
#pragma once

#include <array>
#include <string>

#include "stream/sample.hpp"

namespace gyrod::app {

/// Takes rows in the order of the recording.
class RowHandler {
 public:
  virtual ~RowHandler() = default;
  /// @param rate_radps, rate_std_radps x, y, z: the estimate and the standard deviation of its error, 0 if unknown
  virtual void on_denoised(const std::string& row_text, const std::array<double, stream::kAxes>& rate_radps,
                           const std::array<double, stream::kAxes>& rate_std_radps) = 0;
  /// The row's sample was refused.
  virtual void on_refused(const std::string& row_text) = 0;
};

}  // namespace gyrod::app
