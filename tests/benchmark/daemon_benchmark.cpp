/// The daemon as a whole, over DDS on the loopback interface: throughput, added latency, processor and
/// memory.
///
///   cmake --preset benchmark && cmake --build --preset benchmark --target daemon_benchmark gyrod
///   build/benchmark/daemon_benchmark build/benchmark/gyrod
///
/// Takes about two minutes. Method paper; for the estimates without look-ahead see path_benchmark.cpp. Added latency of a sample is what
/// the daemon adds to lag and hop: from the moment at
/// which the sample that completed its hop was sent, to the moment at which the denoised sample is in a
/// subscriber's hands.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include "benchmark/http_abuse.hpp"
#include "bus/domain.hpp"
#include "bus/raw_writer.hpp"
#include "bus/recorder.hpp"
#include "core/simulation/simulated_gyro.hpp"
#include "support/process.hpp"

namespace gyrod {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr std::uint32_t kDomain = 95;
constexpr double kRateHz = 100.0;
constexpr std::size_t kHop = 32;
constexpr std::size_t kLag = 16;

/// Notes when each sample came.
class Arrivals final : public bus::RecordHandler {
 public:
  void on_samples(std::string_view sensor, std::span<const stream::DenoisedSample> samples) override {
    auto& times = times_[std::string(sensor)];
    for (std::size_t i = 0; i < samples.size(); ++i) times.push_back(Clock::now());
    count_ += samples.size();
  }
  void on_end(std::string_view) override {}

  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  /// Times of the sensor's samples 0, 1, 2, ...
  [[nodiscard]] const std::vector<Clock::time_point>& of(const std::string& sensor) { return times_[sensor]; }

 private:
  std::map<std::string, std::vector<Clock::time_point>> times_;
  std::size_t count_ = 0;
};

/// Processor time of a process so far, s, and its resident memory, MiB.
struct Usage {
  double cpu_s = 0.0;
  double resident_mib = 0.0;
};
Usage usage_of(pid_t process) {
  const std::string folder = "/proc/" + std::to_string(process);
  Usage usage;
  std::ifstream stat(folder + "/stat");
  std::string word;
  constexpr int kUserTime = 14;  // proc(5)
  for (int field = 1; field <= kUserTime + 1 && stat >> word; ++field) {
    if (field >= kUserTime) usage.cpu_s += std::stod(word) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }
  std::ifstream status(folder + "/status");
  while (status >> word && word != "VmRSS:") {
  }
  status >> usage.resident_mib;
  usage.resident_mib /= 1024.0;
  return usage;
}

std::vector<stream::Sample> drive(std::uint64_t seed, std::size_t count) {
  core::SimulatedGyroOptions options;
  options.seed = seed;
  options.drive = core::DriveOptions{};
  core::SimulatedGyro gyro(options);
  std::vector<stream::Sample> samples;
  for (std::size_t n = 0; n < count; ++n) {
    const core::SimulatedSample sample = gyro.next();
    samples.push_back({sample.sequence, sample.stamp_ns, sample.measured_radps});
  }
  return samples;
}

std::string sensor_name(char kind, std::size_t number) {
  return std::string(1, kind).append(std::to_string(number));
}

/// As fast as the daemon takes them, from so many sensors in turn. @return samples/s
double throughput(const bus::Domain& domain, std::size_t batch, std::size_t sensors, std::size_t samples) {
  const bus::BusOptions options;
  bus::RawWriter writer(domain, options, batch);
  bus::Recorder recorder(domain, options, options.topics.denoised_batch, std::chrono::seconds{10});
  if (!writer.wait_for_subscriber(std::chrono::seconds{10})) return 0.0;
  const auto input = drive(1, samples);
  Arrivals arrivals;
  const Clock::time_point begin = Clock::now();
  std::thread sensor([&] {
    const auto name = [batch, sensors](std::size_t s) {
      return sensor_name('b', 1000 * batch + 100 * sensors + s);
    };
    constexpr std::size_t kChunk = 256;
    for (std::size_t n = 0; n < samples; n += kChunk) {
      for (std::size_t s = 0; s < sensors; ++s) {
        std::span<const stream::Sample> part = std::span(input).subspan(n, std::min(kChunk, samples - n));
        while (!part.empty()) part = part.subspan(writer.publish(name(s), part));
      }
    }
    for (std::size_t s = 0; s < sensors; ++s) (void)writer.end(name(s));
  });
  const auto give_up = begin + std::chrono::minutes{2};
  while (arrivals.count() < sensors * samples && Clock::now() < give_up) {
    (void)recorder.poll(std::chrono::milliseconds{50}, arrivals);
  }
  const double seconds = Seconds(Clock::now() - begin).count();
  sensor.join();
  return static_cast<double>(arrivals.count()) / seconds;
}

/// Sensors at 100 Hz in real time.
void real_time(const bus::Domain& domain, pid_t daemon, std::size_t sensors, std::size_t seconds) {
  static std::size_t run = 0;  // each has sensors of its own
  ++run;
  const bus::BusOptions options;
  bus::RawWriter writer(domain, options, 1);
  bus::Recorder recorder(domain, options, options.topics.denoised, std::chrono::seconds{10});
  if (!writer.wait_for_subscriber(std::chrono::seconds{10})) return;
  const auto samples = seconds * static_cast<std::size_t>(kRateHz);
  const auto input = drive(2, samples);
  Arrivals arrivals;
  std::atomic<bool> done{false};
  std::thread receiver([&] {
    while (!done) (void)recorder.poll(std::chrono::milliseconds{50}, arrivals);
  });
  std::vector<std::vector<Clock::time_point>> sent(sensors);
  const Usage before = usage_of(daemon);
  const Clock::time_point begin = Clock::now();
  const auto name = [sensors](std::size_t s) { return sensor_name('r', 10'000 * run + 100 * sensors + s); };
  for (std::size_t n = 0; n < samples; ++n) {
    std::this_thread::sleep_until(
        begin + std::chrono::duration_cast<Clock::duration>(Seconds(static_cast<double>(n) / kRateHz)));
    for (std::size_t s = 0; s < sensors; ++s) {
      sent[s].push_back(Clock::now());
      (void)writer.publish(name(s), {&input[n], 1});
    }
  }
  const double elapsed = Seconds(Clock::now() - begin).count();
  done = true;
  receiver.join();
  const Usage after = usage_of(daemon);
  std::vector<double> latency_ms;
  for (std::size_t s = 0; s < sensors; ++s) {
    const auto& came = arrivals.of(name(s));
    for (std::size_t n = 0; n < came.size(); ++n) {
      const std::size_t completing = (n + kLag) / kHop * kHop + kHop - 1;
      latency_ms.push_back(Seconds(came[n] - sent[s][completing]).count() * 1e3);
    }
  }
  std::sort(latency_ms.begin(), latency_ms.end());
  const auto quantile = [&](double q) {
    return latency_ms.empty()
               ? 0.0
               : latency_ms[static_cast<std::size_t>(q * static_cast<double>(latency_ms.size() - 1))];
  };
  std::printf(
      "%zu sensors, 100 Hz, %zu s: added latency p50 %.2f ms, p99 %.2f ms, max %.2f ms (%zu samples)\n",
      sensors, seconds, quantile(0.5), quantile(0.99), quantile(1.0), latency_ms.size());
  std::printf("  processor %.1f %% of one core, memory %.1f MiB (%.1f MiB before)\n",
              100.0 * (after.cpu_s - before.cpu_s) / elapsed, after.resident_mib, before.resident_mib);
}

/// What the log tells.
std::uint16_t port_in(const std::string& log) {
  const std::string before = "metrics at http://127.0.0.1:";
  return static_cast<std::uint16_t>(std::stoi(log.substr(log.find(before) + before.size())));
}

int run(const std::string& binary) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("gyrod-benchmark-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string config = (folder / "gyrod.json").string();
  std::ofstream(config) << R"({"bus": {"domain": )" << kDomain
                        << R"(}, "denoise": {"method": "paper"}, "monitor": {"port": 0}})";
  {
    testing::Process daemon({binary, "run", "--config", config}, folder, "daemon");
    if (!daemon.wait_for_err("metrics at")) {
      std::fprintf(stderr, "the daemon did not start: %s\n", daemon.err().c_str());
      return 1;
    }
    const bus::Domain domain(kDomain, "loopback");
    real_time(domain, daemon.id(), 1, 10);
    real_time(domain, daemon.id(), 30, 20);
    {
      HttpAbuse abuse(port_in(daemon.err()));
      std::printf("the same, while HTTP clients mean no good:\n");
      real_time(domain, daemon.id(), 30, 20);
      std::printf("  %d connections; %d scrapes, of which %d failed\n", abuse.connections(), abuse.scrapes(),
                  abuse.failed_scrapes());
    }
    std::printf("and quiet again:\n");
    real_time(domain, daemon.id(), 30, 20);
    std::printf("one sensor, singles: %.0f samples/s\n", throughput(domain, 1, 1, 60'000));
    std::printf("one sensor, batches of 32: %.0f samples/s\n", throughput(domain, 32, 1, 60'000));
    std::printf("eight sensors, singles: %.0f samples/s\n", throughput(domain, 1, 8, 20'000));
    std::printf("eight sensors, batches of 32: %.0f samples/s\n", throughput(domain, 32, 8, 20'000));
    daemon.signal(SIGTERM);
    (void)daemon.wait();
  }
  std::filesystem::remove_all(folder);
  return 0;
}

}  // namespace
}  // namespace gyrod

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: daemon_benchmark PATH_OF_GYROD\n");
    return 2;
  }
  return gyrod::run(argv[1]);
}
