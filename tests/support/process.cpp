#include "support/process.hpp"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <spawn.h>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

#include "support/eventually.hpp"

namespace gyrod::testing {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

int exit_code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

}  // namespace

Process::Process(const std::vector<std::string>& command, const std::filesystem::path& folder,
                 const std::string& prefix)
    : out_(folder / (prefix + ".out")), err_(folder / (prefix + ".err")) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  constexpr int kNewFile = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out_.c_str(), kNewFile, 0600);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err_.c_str(), kNewFile, 0600);
  std::vector<std::string> words = command;
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int error = posix_spawn(&pid_, argv[0], &files, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) throw std::runtime_error("start " + command[0] + ": " + std::strerror(error));
}

Process::~Process() {
  if (!running()) return;
  signal(SIGKILL);
  int status = 0;
  waitpid(pid_, &status, 0);
}

void Process::signal(int number) const { kill(pid_, number); }

bool Process::running() {
  if (exit_code_ >= 0) return false;
  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) != pid_) return true;
  exit_code_ = exit_code_of(status);
  return false;
}

int Process::wait(std::chrono::seconds timeout) {
  (void)eventually([this] { return !running(); }, timeout);
  return exit_code_;
}

std::string Process::out() const { return text_of(out_); }
std::string Process::err() const { return text_of(err_); }

bool Process::wait_for_err(const std::string& text, std::chrono::seconds timeout) {
  bool found = false;
  (void)eventually(
      [&] {
        const bool alive = running();
        found = err().find(text) != std::string::npos;
        return found || !alive;
      },
      timeout);
  return found;
}

}  // namespace gyrod::testing
