/// How far a long piece of work is, on a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace gyrod::app {

/// Draws on standard error, ten times a second at the most, and only where that is a terminal: logs and pipes
/// stay clean.
class ProgressBar {
 public:
  /// @param label  what is going on, e.g. "denoising"
  explicit ProgressBar(std::string label);
  /// Clears the line.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param fraction 0..1, or nothing where the end is not known  @param samples done so far
  void show(std::optional<double> fraction, std::uint64_t samples);

 private:
  using Clock = std::chrono::steady_clock;

  void draw(std::optional<double> fraction, std::uint64_t samples, Clock::duration elapsed) const;

  std::string label_;
  bool terminal_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point next_ = begin_;
};

}  // namespace gyrod::app
