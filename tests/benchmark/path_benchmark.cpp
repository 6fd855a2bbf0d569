/// What a sample's way through the daemon costs, by path: single samples, batches, ROS 2; each open and with DDS Security.
///
///   cmake --preset benchmark && cmake --build --preset benchmark --target path_benchmark gyrod
///   build/benchmark/path_benchmark build/benchmark/gyrod
///
/// Run it in the repository's root: deploy/security/make.sh is called. Open and secret take turns, so that a noisy machine is unfair to
/// both; a round takes about 80 s. Added latency is from before a sample is written to after its estimate without look-ahead is read, by
/// one process, so that one clock measures both; a batch has the time of its message. Denoising is set light (hop 512).
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include "bus/domain.hpp"
#include "bus/imu_wire.hpp"
#include "bus/qos.hpp"
#include "bus/raw_writer.hpp"
#include "bus/recorder.hpp"
#include "bus/topic_reader.hpp"
#include "support/imu_node.hpp"
#include "support/process.hpp"
#include "support/samples.hpp"
#include "support/security_folder.hpp"

namespace gyrod {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr std::uint32_t kDomain = 95;
constexpr std::size_t kSensors = 4;
constexpr std::size_t kTicks = 1000;  ///< messages of a sensor, 100 a second
constexpr std::size_t kWarmUp = 50;   ///< the first are not looked at
constexpr std::chrono::milliseconds kTick{10};

struct Figures {
  double p50_us = 0.0;
  double p99_us = 0.0;
  double cpu_us = 0.0;  ///< of the daemon, a message
};

double cpu_s(pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string word;
  double ticks = 0.0;
  for (int field = 1; field <= 15 && stat >> word; ++field) {
    if (field >= 14) ticks += std::stod(word);
  }
  return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

/// When each message of each sensor was sent and came back.
class Times {
 public:
  void sent(std::size_t sensor, std::size_t message) { sent_[sensor][message] = Clock::now(); }
  void came(std::size_t sensor, std::size_t message) {
    if (sensor >= kSensors || message >= kTicks || came_[sensor][message] != Clock::time_point{}) return;
    came_[sensor][message] = Clock::now();
    ++count_;
  }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  [[nodiscard]] Figures figures(double cpu_seconds) const {
    std::vector<double> us;
    for (std::size_t s = 0; s < kSensors; ++s) {
      for (std::size_t n = kWarmUp; n < kTicks; ++n) {
        if (came_[s][n] != Clock::time_point{})
          us.push_back(Seconds(came_[s][n] - sent_[s][n]).count() * 1e6);
      }
    }
    std::ranges::sort(us);
    if (us.empty()) return {};
    const auto quantile = [&us](double q) {
      return us[static_cast<std::size_t>(q * static_cast<double>(us.size() - 1))];
    };
    return {quantile(0.5), quantile(0.99), cpu_seconds * 1e6 / static_cast<double>(kSensors * kTicks)};
  }

 private:
  using Moments = std::array<std::array<Clock::time_point, kTicks>, kSensors>;
  Moments sent_{};
  Moments came_{};
  std::atomic<std::size_t> count_{0};
};

/// A message for each sensor every 10 ms, while another thread receives.
Figures drive(pid_t daemon, const std::function<void(std::size_t sensor, std::size_t message)>& send,
              const std::function<void(Times&)>& receive) {
  auto times = std::make_unique<Times>();
  std::atomic<bool> done{false};
  std::thread receiver([&] {
    while (!done) receive(*times);
  });
  const double before = cpu_s(daemon);
  const Clock::time_point begin = Clock::now();
  for (std::size_t n = 0; n < kTicks; ++n) {
    std::this_thread::sleep_until(begin + n * kTick);
    for (std::size_t s = 0; s < kSensors; ++s) {
      times->sent(s, n);
      send(s, n);
    }
  }
  const auto give_up = Clock::now() + std::chrono::seconds{5};
  while (times->count() < kSensors * kTicks && Clock::now() < give_up) std::this_thread::sleep_for(kTick);
  const double used = cpu_s(daemon) - before;
  done = true;
  receiver.join();
  if (times->count() < kSensors * kTicks)
    std::printf("  (%zu of %zu came)\n", times->count(), kSensors * kTicks);
  return times->figures(used);
}

std::string sensor_name(std::size_t batch, std::size_t sensor) {
  return "batch" + std::to_string(batch) + "-" + std::to_string(sensor);
}

class Arrivals final : public bus::RecordHandler {
 public:
  Arrivals(Times& times, std::size_t batch) : times_(times), batch_(batch) {}
  void on_samples(std::string_view sensor, std::span<const stream::DenoisedSample> samples) override {
    const auto number = static_cast<std::size_t>(sensor.back() - '0');
    for (const stream::DenoisedSample& sample : samples) times_.came(number, sample.sequence / batch_);
  }
  void on_end(std::string_view) override {}

 private:
  Times& times_;
  std::size_t batch_;
};

/// gyrod's own topics, with so many samples a message.
Figures own_topics(const bus::Domain& domain, pid_t daemon, std::size_t batch) {
  const bus::BusOptions options;
  bus::RawWriter writer(domain, options, batch);
  bus::Recorder recorder(domain, options,
                         batch == 1 ? options.topics.realtime : options.topics.realtime_batch,
                         std::chrono::seconds{10});
  const auto give_up = Clock::now() + std::chrono::seconds{20};
  while (recorder.matched_writers() == 0 && Clock::now() < give_up) std::this_thread::sleep_for(kTick);
  if (!writer.wait_for_subscriber(std::chrono::seconds{20})) return {};
  const std::vector<stream::Sample> samples = testing::noisy_samples(kTicks * batch);
  const auto send = [&](std::size_t sensor, std::size_t n) {
    (void)writer.publish(sensor_name(batch, sensor), std::span(samples).subspan(n * batch, batch));
  };
  const Figures figures = drive(daemon, send, [&](Times& times) {
    Arrivals arrivals(times, batch);
    (void)recorder.poll(std::chrono::milliseconds{20}, arrivals);
  });
  for (std::size_t s = 0; s < kSensors; ++s) (void)writer.end(sensor_name(batch, s));
  return figures;
}

std::string ros2_topic(std::size_t sensor) { return "rt/bench" + std::to_string(sensor); }

Figures ros2_topics(const bus::Domain& domain, pid_t daemon) {
  bus::Ros2Options options;
  std::vector<std::unique_ptr<testing::ImuPublisher>> publishers;
  std::vector<std::unique_ptr<bus::TopicReader<bus::Imu>>> readers;
  const bus::Entity waitset(dds_create_waitset(domain.participant()), "create a waitset");
  for (std::size_t s = 0; s < kSensors; ++s) {
    publishers.push_back(std::make_unique<testing::ImuPublisher>(domain.participant(), ros2_topic(s)));
    readers.push_back(std::make_unique<bus::TopicReader<bus::Imu>>(
        domain.participant(), ros2_topic(s) + "_realtime",
        bus::imu_reader_qos(options, bus::Reliability::kBestEffort)));
    bus::check(dds_waitset_attach(waitset.get(), readers.back()->data_condition(), 0), "wait");
  }
  const auto matched = [&] {
    return std::ranges::all_of(readers, [](const auto& r) { return r->matched().current_count > 0; });
  };
  const auto give_up = Clock::now() + std::chrono::seconds{20};
  while (!matched() && Clock::now() < give_up) std::this_thread::sleep_for(kTick);
  for (const auto& publisher : publishers) (void)publisher->wait_for_reader();
  const std::vector<testing::ImuMessage> messages = testing::noisy_imu_messages(kTicks);
  std::map<std::int64_t, std::size_t> number_of;
  for (std::size_t n = 0; n < kTicks; ++n) number_of[testing::stamp_ns_of(messages[n])] = n;
  return drive(
      daemon, [&](std::size_t sensor, std::size_t n) { publishers[sensor]->publish(messages[n]); },
      [&](Times& times) {
        (void)dds_waitset_wait(waitset.get(), nullptr, 0, DDS_MSECS(20));
        for (std::size_t s = 0; s < kSensors; ++s) {
          readers[s]->take([&](const bus::Imu& message, const dds_sample_info_t& info) {
            if (info.valid_data) times.came(s, number_of[bus::sample_of(message).stamp_ns]);
          });
        }
      });
}

/// As fast as it goes, one sensor. @return samples/s
double throughput(const bus::Domain& domain, std::size_t batch) {
  constexpr std::size_t kSamples = 100'000;
  const bus::BusOptions options;
  bus::RawWriter writer(domain, options, batch);
  bus::Recorder recorder(domain, options, options.topics.denoised_batch, std::chrono::seconds{10});
  if (!writer.wait_for_subscriber(std::chrono::seconds{20})) return 0.0;
  const std::vector<stream::Sample> samples = testing::noisy_samples(kSamples);
  struct Count final : bus::RecordHandler {
    void on_samples(std::string_view, std::span<const stream::DenoisedSample> came) override {
      total += came.size();
    }
    void on_end(std::string_view) override { ended = true; }
    std::size_t total = 0;
    bool ended = false;
  } count;
  const Clock::time_point begin = Clock::now();
  const std::string name = "flood" + std::to_string(batch);
  std::thread sensor([&] {
    for (std::span<const stream::Sample> rest = samples; !rest.empty();)
      rest = rest.subspan(writer.publish(name, rest.first(std::min<std::size_t>(rest.size(), 256))));
    (void)writer.end(name);
  });
  const auto give_up = begin + std::chrono::minutes{1};
  while (!count.ended && Clock::now() < give_up) (void)recorder.poll(std::chrono::milliseconds{50}, count);
  const double seconds = Seconds(Clock::now() - begin).count();
  sensor.join();
  return static_cast<double>(count.total) / seconds;
}

void print(const char* kind, const char* path, const Figures& figures) {
  std::printf("%-6s %-8s added latency p50 %5.0f us, p99 %6.0f us; daemon %4.0f us of processor a message\n",
              kind, path, figures.p50_us, figures.p99_us, figures.cpu_us);
  std::fflush(stdout);
}

void measure(const std::string& binary, const std::string& security, const testing::ScratchFolder& folder) {
  const char* kind = security.empty() ? "open" : "secret";
  const std::uint32_t id = security.empty() ? kDomain : kDomain + 1;
  const std::string config = folder.write(
      "gyrod.json", R"({"bus": {"domain": )" + std::to_string(id) +
                        R"(, "ros2": {"topics": ["rt/bench0", "rt/bench1", "rt/bench2", "rt/bench3"]},
      "security": {"folder": ")" +
                        (security.empty() ? "" : security + "/gyrod") + R"("}},
      "denoise": {"hop_samples": 512}, "limits": {"max_hop_samples": 512}, "monitor": {"port": 0}})");
  testing::Process daemon({binary, "run", "--config", config}, folder.path(), "daemon");
  if (!daemon.wait_for_err("metrics at")) {
    std::fprintf(stderr, "the daemon did not start: %s\n", daemon.err().c_str());
    return;
  }
  const bus::Domain domain(id, "loopback", security.empty() ? "" : security + "/bench");
  print(kind, "single", own_topics(domain, daemon.id(), 1));
  print(kind, "batch 10", own_topics(domain, daemon.id(), 10));
  print(kind, "ROS 2", ros2_topics(domain, daemon.id()));
  const double singles = throughput(domain, 1);
  std::printf("%-6s flat out: single %.0f samples/s, batches of 32 %.0f samples/s\n", kind, singles,
              throughput(domain, 32));
  std::fflush(stdout);
  daemon.signal(SIGTERM);
  (void)daemon.wait();
}

/// The programs gyrod, and bench, who may do what sensor and reader may.
std::unique_ptr<testing::SecurityFolder> certificates(const testing::ScratchFolder& folder) {
  for (const std::string name : {"governance.xml", "permissions-daemon.xml", "permissions-bench.xml"}) {
    std::string text =
        testing::security_template(name == "permissions-bench.xml" ? "permissions-daemon.xml" : name);
    if (name == "permissions-bench.xml") {
      // Everything that the daemon reads and writes, the other way round.
      for (const auto& [from, to] :
           {std::pair("publish>", "PUBLISH>"), {"subscribe>", "publish>"}, {"PUBLISH>", "subscribe>"}}) {
        const std::string word(from);
        for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
          text.replace(at, word.size(), to);
      }
    }
    folder.write(name, text);
  }
  return std::make_unique<testing::SecurityFolder>(std::vector<std::string>{
      "--templates", folder.path().string(), "--program", "gyrod=daemon", "--program", "bench=bench"});
}

}  // namespace
}  // namespace gyrod

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: path_benchmark PATH_OF_GYROD [ROUNDS]\n");
    return 2;
  }
  const gyrod::testing::ScratchFolder folder;
  const auto security = gyrod::certificates(folder);
  for (int round = argc == 3 ? std::atoi(argv[2]) : 3; round > 0; --round) {
    gyrod::measure(argv[1], "", folder);
    gyrod::measure(argv[1], security->path(""), folder);
  }
  return 0;
}
