/// What the fast loop of the two-speed estimator answers.
#pragma once

namespace gyrod::core {

/// An estimate of the true rate, and of its error's variance, in the data's unit and its square.
struct BankEstimate {
  double rate = 0.0;
  double variance = 0.0;
};

}  // namespace gyrod::core
