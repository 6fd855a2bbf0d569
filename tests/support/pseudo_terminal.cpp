#include "support/pseudo_terminal.hpp"

#include <array>
#include <csignal>
#include <poll.h>
#include <pty.h>
#include <stdexcept>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>
#include <utmp.h>

#include "support/eventually.hpp"

namespace gyrod::testing {

PseudoTerminal::PseudoTerminal(const std::vector<std::string>& command, unsigned short columns,
                               unsigned short rows) {
  const winsize size{rows, columns, 0, 0};
  if (openpty(&terminal_, &program_end_, nullptr, nullptr, &size) != 0)
    throw std::runtime_error("there is no pseudo terminal to be had");
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_ = fork();
  if (pid_ != 0) return;
  close(terminal_);
  login_tty(program_end_);
  execv(arguments[0], arguments.data());
  _exit(127);
}

PseudoTerminal::~PseudoTerminal() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  close(terminal_);
  close(program_end_);
}

void PseudoTerminal::press(const std::string& keys) const {
  if (write(terminal_, keys.data(), keys.size()) != static_cast<ssize_t>(keys.size()))
    throw std::runtime_error("the terminal takes no keys");
}

void PseudoTerminal::resize(unsigned short columns, unsigned short rows) const {
  const winsize size{rows, columns, 0, 0};
  ioctl(terminal_, TIOCSWINSZ, &size);
}

void PseudoTerminal::signal(int number) const { kill(pid_, number); }

void PseudoTerminal::take() {
  pollfd input{terminal_, POLLIN, 0};
  std::array<char, 4096> buffer{};
  while (poll(&input, 1, 0) > 0) {
    const ssize_t count = read(terminal_, buffer.data(), buffer.size());
    if (count <= 0) return;
    text_.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

bool PseudoTerminal::said(const std::string& words) { return text().find(words) != std::string::npos; }

const std::string& PseudoTerminal::text() {
  take();
  return text_;
}

bool PseudoTerminal::is_cooked() const {
  termios state{};
  tcgetattr(program_end_, &state);
  return (state.c_lflag & ICANON) != 0 && (state.c_lflag & ECHO) != 0;
}

int PseudoTerminal::wait() {
  int status = 0;
  // Taken meanwhile: a program that nobody reads waits for ever.
  const auto ended = [&] {
    take();
    return waitpid(pid_, &status, WNOHANG) != 0;
  };
  if (!eventually(ended)) {
    kill(pid_, SIGKILL);
    waitpid(pid_, &status, 0);
  }
  pid_ = -1;
  take();
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace gyrod::testing
