/// Keeps the picture of a gyrod up to date while somebody looks at it.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "top/client.hpp"
#include "top/screen.hpp"
#include "top/view.hpp"

namespace gyrod::top {

/// Asks once a second, and at once when something else is wanted, on a thread of its own: keys are answered while a gyrod is not. It asks for what is on
/// the screen and no more, whatever the size of the fleet.
class Poller {
 public:
  /// `client` must outlive it; nobody else uses it meanwhile.
  explicit Poller(Client& client);
  ~Poller();
  Poller(const Poller&) = delete;
  Poller& operator=(const Poller&) = delete;

  /// What is looked at from now on: so many sensors from view.first on.
  void want(const View& view, std::uint64_t rows);

  /// What is known, and how often it has changed.
  struct Known {
    Picture picture;
    std::uint64_t version = 0;
  };
  [[nodiscard]] Known known();

 private:
  void run();
  [[nodiscard]] Picture ask(const View& view, std::uint64_t rows);

  Client& client_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ending_ = false;
  bool changed_ = true;
  View view_;
  std::uint64_t rows_ = 1;
  Known known_;
  std::thread thread_;
};

}  // namespace gyrod::top
