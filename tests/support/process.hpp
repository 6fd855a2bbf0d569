/// A child process for tests: started, watched, ended, never left behind.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace gyrod::testing {

/// One thread at a time. Standard output and error go to one file each.
class Process {
 public:
  /// Starts a program. @param folder gets the files PREFIX.out and PREFIX.err
  /// @throws std::runtime_error if it cannot be started
  Process(const std::vector<std::string>& command, const std::filesystem::path& folder,
          const std::string& prefix);
  /// Kills it if it still runs.
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const;
  [[nodiscard]] pid_t id() const noexcept { return pid_; }

  /// Waits for its end. @return exit code, 128 + signal where one ended it, -1 where it still runs after the
  /// timeout
  int wait(std::chrono::seconds timeout = std::chrono::seconds{120});
  [[nodiscard]] bool running();

  [[nodiscard]] std::string out() const;
  [[nodiscard]] std::string err() const;

  /// Waits until standard error holds the text. @return false if it does not in time, or the process ends
  /// without
  bool wait_for_err(const std::string& text, std::chrono::seconds timeout = std::chrono::seconds{60});

 private:
  std::filesystem::path out_;
  std::filesystem::path err_;
  pid_t pid_ = -1;
  int exit_code_ = -1;
};

}  // namespace gyrod::testing
