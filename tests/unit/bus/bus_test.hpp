/// What the tests of bus/ share: a writer's and a reader's side that meet in one process, and handlers that
/// can be waited for.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "bus/bus_options.hpp"
#include "bus/domain.hpp"
#include "bus/recorder.hpp"
#include "bus/subscriber.hpp"
#include "bus/topic_writer.hpp"
#include "bus/writer_book.hpp"

namespace gyrod::bus::test {

/// Longest wait for anything; generous because sanitizers and busy machines are slow. Never reached when all
/// is well.
inline constexpr std::chrono::seconds kPatience{60};

/// DDS domains of this executable; no other test uses them.
inline constexpr std::uint32_t kReaderDomain = 71;
inline constexpr std::uint32_t kWriterDomain = 72;
/// The domain id that both show on the wire when they talk over UDP.
inline constexpr std::uint32_t kWireDomain = 73;

/// Options under topic names of this process only: runs of the same test on one machine do not meet.
inline BusOptions test_options() {
  const std::string prefix = "test" + std::to_string(getpid()) + "/";
  BusOptions options;
  options.domain_id = kReaderDomain;
  options.topics = {.raw = prefix + "raw",
                    .raw_batch = prefix + "raw_batch",
                    .denoised = prefix + "denoised",
                    .denoised_batch = prefix + "denoised_batch",
                    .noise = prefix + "noise",
                    .health = prefix + "health",
                    .realtime = prefix + "realtime",
                    .realtime_batch = prefix + "realtime_batch"};
  return options;
}

/// The repository's loopback configuration, for domains that are different ones in the process and one on the
/// wire.
inline std::string udp_network_file() {
  const char* source_dir = std::getenv("GYROD_SOURCE_DIR");
  std::ifstream original(std::string(source_dir == nullptr ? "." : source_dir) +
                         "/config/cyclonedds/loopback.xml");
  std::string xml{std::istreambuf_iterator<char>(original), std::istreambuf_iterator<char>()};
  const std::string place = "<Discovery>";
  xml.insert(xml.find(place) + place.size(),
             "<ExternalDomainId>" + std::to_string(kWireDomain) + "</ExternalDomainId>");
  const std::string path = ::testing::TempDir() + "gyrod_bus_test_" + std::to_string(getpid()) + ".xml";
  std::ofstream(path) << xml;
  return path;
}

/// How writer and reader meet.
enum class Route {
  kInProcess,  ///< in one DDS domain: the middleware hands messages over in memory
  kUdp,        ///< in two: every message goes through the loopback interface
};

/// Runs every test on both routes.
class BusTest : public ::testing::TestWithParam<Route> {
 protected:
  /// The same participant each time. With several of one side that come and go, Cyclone DDS 0.10 loses endpoints at times: of what one of
  /// them is about to be told when it goes the others never hear.
  [[nodiscard]] Domain reader_domain() const { return side(reader_, kReaderDomain); }
  [[nodiscard]] Domain writer_domain() const { return side(writer_, kWriterDomain); }
  [[nodiscard]] Domain another_writer_domain() const {
    std::optional<Domain> another;
    return side(another, kWriterDomain);
  }

  static void wait_until(const auto& condition) {
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline);
      std::this_thread::yield();
    }
  }

  /// Waits until `at` has dealt with all that it heard of `from` so far. A match shows at a reader a moment before messages reach it; those
  /// that come meanwhile it never gets, reliable ones neither, as nobody who joins late. What is discovered after the match, which one thread
  /// sees to in order, shows that the moment is over.
  static void settle(const Domain& from, const Domain& at) {
    const std::string topic = "test" + std::to_string(getpid()) + "/settled";
    WriterBook book(at, {TopicType<gyrod_NoiseReport>::kDescriptor->m_typename});
    const TopicWriter<gyrod_NoiseReport> last(from.participant(), topic, Qos());
    wait_until([&] {
      const std::vector<WriterBook::Writer> news = book.take_news();
      return std::ranges::any_of(news,
                                 [&](const WriterBook::Writer& writer) { return writer.topic == topic; });
    });
  }

  BusOptions options_ = test_options();

 private:
  [[nodiscard]] Domain side(std::optional<Domain>& made, std::uint32_t id) const {
    if (!made) made = GetParam() == Route::kUdp ? Domain(id, network_) : Domain(kReaderDomain, "loopback");
    return *made;
  }

  std::string network_ = udp_network_file();
  mutable std::optional<Domain> reader_;
  mutable std::optional<Domain> writer_;
};

inline std::string route_name(const ::testing::TestParamInfo<Route>& info) {
  return info.param == Route::kUdp ? "OverUdp" : "InProcess";
}

/// Collects what a subscriber or recorder hands over, and in which order.
template <class Sample>
class Collector {
 public:
  void add(std::string_view sensor, std::span<const Sample> samples) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kPatience, [&] { return open_; });
    auto& of_sensor = samples_[std::string(sensor)];
    EXPECT_FALSE(samples.empty());
    of_sensor.insert(of_sensor.end(), samples.begin(), samples.end());
    count_ += samples.size();
    changed_.notify_all();
  }

  void end(std::string_view sensor) {
    const std::lock_guard lock(mutex_);
    ends_.emplace_back(sensor, samples_[std::string(sensor)].size());
    changed_.notify_all();
  }

  void come_again(std::string_view sensor) {
    const std::lock_guard lock(mutex_);
    returns_.emplace_back(sensor, samples_[std::string(sensor)].size());
  }
  /// The sensors that came back, and how many of their samples had come before.
  [[nodiscard]] std::vector<std::pair<std::string, std::size_t>> returns() {
    const std::lock_guard lock(mutex_);
    return returns_;
  }

  void break_promise(std::string_view sensor, stream::ChannelState why) {
    const std::lock_guard lock(mutex_);
    broken_promises_.emplace_back(sensor, why);
    changed_.notify_all();
  }
  [[nodiscard]] bool wait_for_broken_promises(std::size_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return broken_promises_.size() >= count; });
  }
  [[nodiscard]] std::vector<std::pair<std::string, stream::ChannelState>> broken_promises() {
    const std::lock_guard lock(mutex_);
    return broken_promises_;
  }

  /// While closed, the handler does not come back from on_samples().
  void set_open(bool open) {
    const std::lock_guard lock(mutex_);
    open_ = open;
    changed_.notify_all();
  }

  [[nodiscard]] bool wait_for_samples(std::size_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return count_ >= count; });
  }

  [[nodiscard]] bool wait_for_ends(std::size_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return ends_.size() >= count; });
  }

  [[nodiscard]] std::vector<Sample> samples(const std::string& sensor) {
    const std::lock_guard lock(mutex_);
    return samples_[sensor];
  }

  /// The sensors that ended, and how many of their samples had come by then.
  [[nodiscard]] std::vector<std::pair<std::string, std::size_t>> ends() {
    const std::lock_guard lock(mutex_);
    return ends_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool open_ = true;
  std::size_t count_ = 0;
  std::map<std::string, std::vector<Sample>> samples_;
  std::vector<std::pair<std::string, std::size_t>> ends_;
  std::vector<std::pair<std::string, std::size_t>> returns_;
  std::vector<std::pair<std::string, stream::ChannelState>> broken_promises_;
};

class SampleCollector : public SampleHandler, public Collector<stream::Sample> {
 public:
  void on_samples(std::string_view sensor, std::span<const stream::Sample> samples) noexcept override {
    add(sensor, samples);
  }
  void on_end(std::string_view sensor) noexcept override { end(sensor); }
  void on_return(std::string_view sensor) noexcept override { come_again(sensor); }
  void on_broken_promise(std::string_view sensor, stream::ChannelState why) noexcept override {
    break_promise(sensor, why);
  }
};

class RecordCollector : public RecordHandler, public Collector<stream::DenoisedSample> {
 public:
  void on_samples(std::string_view sensor, std::span<const stream::DenoisedSample> samples) override {
    add(sensor, samples);
  }
  void on_end(std::string_view sensor) override { end(sensor); }
};

/// Samples first, first + 1, ..., told apart by every field.
inline std::vector<stream::Sample> make_samples(std::uint64_t first, std::size_t count) {
  std::vector<stream::Sample> samples(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t number = first + i;
    const auto value = static_cast<double>(number);
    samples[i] = {
        number, static_cast<std::int64_t>(number) * 10'000'000, {value + 0.25, -value, value / 3.0}};
  }
  return samples;
}

inline std::vector<std::uint64_t> sequence_numbers(const auto& samples) {
  std::vector<std::uint64_t> numbers;
  for (const auto& sample : samples) numbers.push_back(sample.sequence);
  return numbers;
}

}  // namespace gyrod::bus::test
