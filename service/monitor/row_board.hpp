/// The rows of all sensors, made once for all streams that tell them.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "monitor/view.hpp"

namespace gyrod::monitor {

/// All rows at one moment, as JSON.
struct RowTexts {
  struct Row {
    std::string sensor;
    std::string text;
    std::size_t hash = 0;  ///< of the text without history: another where anything has changed
  };
  std::vector<Row> rows;
  int overload_step = 0;  ///< the worst of them
  double made_s = 0.0;
};

/// Any thread; one makes rows while others that want them wait.
class RowBoard {
 public:
  /// Rows that are older are made anew, s.
  static constexpr double kFreshS = 0.4;

  /// @param now_s of a steady clock
  [[nodiscard]] std::shared_ptr<const RowTexts> look(const View& view, bool history, double now_s);

 private:
  std::mutex mutex_;
  std::array<std::shared_ptr<const RowTexts>, 2> made_;  ///< without history, and with it
};

}  // namespace gyrod::monitor
