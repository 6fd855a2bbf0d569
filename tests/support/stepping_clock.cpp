// Preloaded into a program, lets a test set the wall clock that the program sees: the file that GYROD_TEST_CLOCK names holds what is added
// to it, ns, as a 64-bit number. Waits until a wall-clock time end by the clock that is set, as the kernel ends them when the machine's is.
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <unistd.h>

namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;

const volatile std::int64_t& offset_ns() {
  static const auto* const mapped = [] {
    static constexpr std::int64_t kNone = 0;
    const char* name = std::getenv("GYROD_TEST_CLOCK");
    const int file = name == nullptr ? -1 : open(name, O_RDONLY | O_CLOEXEC);
    if (file < 0) return &kNone;
    void* memory = mmap(nullptr, sizeof(std::int64_t), PROT_READ, MAP_SHARED, file, 0);
    close(file);
    return memory == MAP_FAILED ? &kNone : static_cast<const std::int64_t*>(memory);
  }();
  return *static_cast<const volatile std::int64_t*>(mapped);
}

std::int64_t ns_of(const timespec& time) { return time.tv_sec * kSecondNs + time.tv_nsec; }
timespec timespec_of(std::int64_t ns) { return {ns / kSecondNs, ns % kSecondNs}; }

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

int real_clock(clockid_t clock, timespec* time) {
  static auto* const real = next<int(clockid_t, timespec*)>("clock_gettime");
  return real(clock, time);
}

std::int64_t set_clock_ns() {
  timespec time{};
  real_clock(CLOCK_REALTIME, &time);
  return ns_of(time) + offset_ns();
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const int result = real_clock(clock, time);
  if (result == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE))
    *time = timespec_of(ns_of(*time) + offset_ns());
  return result;
}

int gettimeofday(timeval* time, void* /*zone*/) noexcept {
  const std::int64_t ns = set_clock_ns();
  *time = {ns / kSecondNs, ns % kSecondNs / 1000};
  return 0;
}

time_t time(time_t* result) noexcept {
  const time_t seconds = set_clock_ns() / kSecondNs;
  if (result != nullptr) *result = seconds;
  return seconds;
}

// Wakes its caller now and then for nothing, as it may: the clock could have been set meanwhile.
int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex, const timespec* until) {
  constexpr std::int64_t kLook = kSecondNs / 50;
  static auto* const real =
      next<int(pthread_cond_t*, pthread_mutex_t*, const timespec*)>("pthread_cond_timedwait");
  const std::int64_t left = ns_of(*until) - set_clock_ns();
  if (left <= 0) return ETIMEDOUT;
  timespec now{};
  real_clock(CLOCK_REALTIME, &now);
  const timespec look = timespec_of(ns_of(now) + (left < kLook ? left : kLook));
  const int result = real(condition, mutex, &look);
  return result == ETIMEDOUT && left > kLook ? 0 : result;
}
}
