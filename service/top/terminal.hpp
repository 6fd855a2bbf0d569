/// The terminal, full-screen.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <termios.h>

#include "top/screen.hpp"

namespace gyrod::top {

/// Takes the terminal at standard input and output: keys come one by one and unseen, and the screen is a second one, without cursor. The destructor
/// gives both back as they were. Ctrl-Z does nothing meanwhile; Ctrl-C stays a signal.
class Terminal {
 public:
  /// Whether there is one at both ends.
  [[nodiscard]] static bool is_there() noexcept;

  /// @throws std::runtime_error where there is none
  Terminal();
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// Its size now; 80 x 24 where it does not tell.
  [[nodiscard]] static Size size() noexcept;

  /// Bytes of keys, after so long at the most; none where none was pressed. @return false where the terminal has gone
  [[nodiscard]] static bool read(std::string& bytes, std::chrono::milliseconds patience);

  static void write(std::string_view bytes) noexcept;

 private:
  termios before_{};
};

}  // namespace gyrod::top
