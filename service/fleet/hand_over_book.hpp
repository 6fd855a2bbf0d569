/// Which hand-overs other daemons have announced, and which have come.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace gyrod::fleet {

/// An announcement and the hand-over that it announces go by ways of their own: who takes a sensor waits for both. Daemons number their
/// hand-overs from 1; the newest stands for all before it. One thread.
class HandOverBook {
 public:
  /// A daemon says that it has told so many.
  void announce(const std::string& id, std::uint64_t number);
  /// This one has come.
  void receive(const std::string& id, std::uint64_t number);
  /// The daemon is gone. What it has announced may still come.
  void forget(const std::string& id);

  /// Whether anything was announced that has not come.
  [[nodiscard]] bool owes() const noexcept { return owing_ > 0; }
  /// Nothing more is awaited of what was announced.
  void write_off();

 private:
  /// Daemons that are kept in mind; further ones owe nothing.
  static constexpr std::size_t kMost = 1024;

  struct Account {
    std::uint64_t announced = 0;
    std::uint64_t received = 0;
    bool gone = false;
    [[nodiscard]] bool owes() const noexcept { return announced > received; }
  };

  template <class Change>
  void change(const std::string& id, const Change& change);

  std::map<std::string, Account> accounts_;
  std::size_t owing_ = 0;
};

}  // namespace gyrod::fleet
