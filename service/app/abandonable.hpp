/// Long work that has no place to stop at, such as the analysis of a whole record.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>

namespace gyrod::app {

/// Does the work in a thread of its own and asks twenty times a second whether it is still wanted. Once it is not, the thread is left
/// alone: it goes on until it is done or the process ends, whichever comes first.
/// @param work owns all that it uses, and computes only: nobody waits for a file it may have open
/// @return nothing if it was left alone  @throws what the work throws
template <class Work>
[[nodiscard]] std::optional<std::invoke_result_t<Work&>> while_wanted(const std::function<bool()>& wanted,
                                                                      Work work) {
  constexpr std::chrono::milliseconds kLookEvery{50};
  std::packaged_task<std::invoke_result_t<Work&>()> task(std::move(work));
  auto result = task.get_future();
  std::thread(std::move(task)).detach();
  while (result.wait_for(kLookEvery) != std::future_status::ready) {
    if (!wanted()) return std::nullopt;
  }
  return result.get();
}

}  // namespace gyrod::app
