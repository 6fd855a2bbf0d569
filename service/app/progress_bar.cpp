#include "app/progress_bar.hpp"

#include <algorithm>
#include <cstdio>
#include <unistd.h>
#include <utility>

namespace gyrod::app {

ProgressBar::ProgressBar(std::string label)
    : label_(std::move(label)), terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::show(std::optional<double> fraction, std::uint64_t samples) {
  if (!terminal_) return;
  constexpr std::chrono::milliseconds kRedraw{100};
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + kRedraw;
  draw(fraction, samples, now - begin_);
}

void ProgressBar::draw(std::optional<double> fraction, std::uint64_t samples, Clock::duration elapsed) const {
  constexpr int kWidth = 30;
  const double seconds = std::max(1e-3, std::chrono::duration<double>(elapsed).count());
  const double rate = static_cast<double>(samples) / seconds;
  std::string bar;
  if (fraction) {
    const int done = static_cast<int>(*fraction * kWidth);
    bar = " [" + std::string(static_cast<std::size_t>(done), '#') +
          std::string(static_cast<std::size_t>(kWidth - done), '.') + "]";
  }
  std::fprintf(stderr, "\r\033[K%s%s", label_.c_str(), bar.c_str());
  if (fraction) std::fprintf(stderr, " %3.0f %%", *fraction * 100.0);
  std::fprintf(stderr, "  %.0f samples, %.0f/s", static_cast<double>(samples), rate);
  if (fraction && *fraction > 0.01)
    std::fprintf(stderr, ", %.0f s left", seconds * (1.0 - *fraction) / *fraction);
  std::fflush(stderr);
}

}  // namespace gyrod::app
