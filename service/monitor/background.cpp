#include "monitor/background.hpp"

#include <cerrno>
#include <sys/resource.h>

namespace gyrod::monitor {

void run_in_background() noexcept {
  constexpr int kNicer = 5;        // sched(7): 335 against 1024
  constexpr id_t kThisThread = 0;  // on Linux; POSIX means the process
  errno = 0;
  const int now = getpriority(PRIO_PROCESS, kThisThread);
  if (errno == 0) setpriority(PRIO_PROCESS, kThisThread, now + kNicer);
}

}  // namespace gyrod::monitor
