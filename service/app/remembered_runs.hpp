/// Runs on records that several ask for, one after the other.
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <span>
#include <vector>

#include "core/evaluation/contender.hpp"

namespace gyrod::app {

/// What takes one pass over a record for several answers. The newest records are remembered with all of them, and who asks for another answer to
/// one of these has it at once. Not thread-safe.
class RememberedRuns {
 public:
  /// All answers to a record.
  using Run = std::function<std::vector<core::Contender>(std::span<const double> noisy)>;

  /// @param records to remember, at least 1
  RememberedRuns(Run run, std::size_t records);

  /// Valid until the next call. @param answer that is asked for, of those that the run gives
  [[nodiscard]] const core::Contender& answer(std::span<const double> noisy, std::size_t answer);

 private:
  struct Remembered {
    std::vector<double> noisy;
    std::vector<core::Contender> answers;
  };

  Run run_;
  std::size_t records_;
  std::list<Remembered> remembered_;  ///< what was asked for last comes first
};

}  // namespace gyrod::app
