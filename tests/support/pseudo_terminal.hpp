/// A program at a terminal that the test holds.
#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

namespace gyrod::testing {

class PseudoTerminal {
 public:
  /// Starts the command with a terminal of that size as its standard input, output and error. @throws std::runtime_error
  PseudoTerminal(const std::vector<std::string>& command, unsigned short columns, unsigned short rows);
  /// Kills what still runs.
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  void press(const std::string& keys) const;
  void resize(unsigned short columns, unsigned short rows) const;
  void signal(int number) const;

  /// Whether the program has written this, so far.
  [[nodiscard]] bool said(const std::string& words);
  /// All that it has written, so far.
  [[nodiscard]] const std::string& text();
  /// Whether the terminal gathers lines and shows keys, as a shell leaves it.
  [[nodiscard]] bool is_cooked() const;

  /// Waits until the program ends, a minute at most, after which it is killed. @return its exit code, or -1 where a signal ended it
  int wait();

 private:
  void take();

  int terminal_ = -1;     ///< our end
  int program_end_ = -1;  ///< kept open, so that the terminal outlives the program
  pid_t pid_ = -1;
  std::string text_;
};

}  // namespace gyrod::testing
