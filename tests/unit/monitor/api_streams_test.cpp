/// The API's event streams: what comes when, and that what is new comes once.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "unit/monitor/api_fixture.hpp"

namespace gyrod::monitor::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Sent {
  std::string event;
  std::string id;
  nlohmann::json data;
};

/// Reads server-sent events strictly: blocks of known fields, each closed by an empty line.
std::vector<Sent> parse(std::string text) {
  std::vector<Sent> all;
  while (!text.empty()) {
    const std::size_t end = text.find("\n\n");
    EXPECT_NE(end, std::string::npos) << "an event that is not closed";
    if (end == std::string::npos) return all;
    std::string block = text.substr(0, end + 1);
    text.erase(0, end + 2);
    Sent sent;
    while (!block.empty()) {
      const std::string line = block.substr(0, block.find('\n'));
      block.erase(0, line.size() + 1);
      if (line.starts_with("event: "))
        sent.event = line.substr(7);
      else if (line.starts_with("id: "))
        sent.id = line.substr(4);
      else if (line.starts_with("data: "))
        sent.data = nlohmann::json::parse(line.substr(6));
      else if (line.starts_with(": "))
        sent.event = line;
      else
        ADD_FAILURE() << line;
    }
    all.push_back(std::move(sent));
  }
  return all;
}

class ApiStreamTest : public ApiTest {
 protected:
  static constexpr std::int64_t kPeriodNs = 10'000'000;
  static constexpr std::int64_t kStartNs = 1'700'000'000'000'000'000;

  void open(const std::string& target, const std::string& last_event_id = "") {
    Answer answer = ask("/api/v1/" + target, last_event_id);
    ASSERT_EQ(answer.status, 200) << answer.body;
    EXPECT_EQ(answer.content_type, "text/event-stream");
    EXPECT_EQ(answer.body, "retry: 2000\n\n");
    stream_ = std::move(answer.events);
    ASSERT_NE(stream_, nullptr);
  }

  /// What is sent after so long.
  std::vector<Sent> after(double seconds) {
    now_s_ += seconds;
    std::string text;
    stream_->append(text);
    return parse(text);
  }

  /// The first one of this kind, if any.
  static nlohmann::json first(const std::vector<Sent>& all, const std::string& event) {
    for (const Sent& sent : all) {
      if (sent.event == event) return sent.data;
    }
    return nullptr;
  }

  /// A 100 Hz sensor goes on by so many samples of noise without randomness, raw and denoised.
  void send(std::size_t samples) {
    for (std::size_t i = 0; i < samples; ++i, ++sent_) {
      const double wave = 0.01 * std::sin(2.0 * static_cast<double>(sent_));
      const std::int64_t stamp_ns = kStartNs + static_cast<std::int64_t>(sent_) * kPeriodNs;
      const stream::Sample raw{
          .sequence = sent_, .stamp_ns = stamp_ns, .rate_radps = {wave, 2.0 * wave, 3.0 * wave}};
      live_.tap.on_raw("imu_front", {&raw, 1});
      stream::DenoisedSample denoised;
      denoised.stamp_ns = stamp_ns;
      denoised.rate_radps = {0.1 * wave, 0.2 * wave, 0.3 * wave};
      live_.tap.on_denoised("imu_front", {&denoised, 1});
    }
  }

  std::unique_ptr<EventSource> stream_;
  std::uint64_t sent_ = 0;
};

TEST_F(ApiStreamTest, TheFleetsRowsComeOnceAndThenAsTheyChange) {
  open("stream?channels=1");
  const auto begin = after(0.0);
  EXPECT_EQ(first(begin, "status").at("version"), "1.2.3");
  const json full = first(begin, "channels");
  EXPECT_EQ(full.at("full"), true);
  EXPECT_EQ(full.at("channels").size(), 2U);
  EXPECT_TRUE(full.at("channels")[0].at("axes")[0].contains("history"));
  EXPECT_THAT(after(0.5), IsEmpty()) << "a second is not over";
  shown_.channels[1].counts.received = 11;
  const json changed = first(after(0.5), "channels");
  EXPECT_EQ(changed.at("full"), false);
  ASSERT_EQ(changed.at("channels").size(), 1U);
  EXPECT_EQ(changed.at("channels")[0].at("sensor"), "imu_rear");
  EXPECT_FALSE(changed.at("channels")[0].at("axes")[0].contains("history"));
  shown_.channels.erase(shown_.channels.begin());
  const json gone = first(after(1.0), "channels");
  EXPECT_THAT(gone.at("gone"), ElementsAre("imu_front"));
  EXPECT_EQ(gone.at("total"), 1);
  live_.noise.end_round();
  EXPECT_TRUE(first(after(1.0), "channels").at("channels")[0].at("axes")[0].contains("history"));
}

TEST_F(ApiStreamTest, WithoutChannelsOnlyStatusAndEventsCome) {
  open("stream");
  EXPECT_TRUE(first(after(0.0), "channels").is_null());
  live_.events.add(1.0, "", "Stopping.");
  const auto sent = after(0.1);
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(sent[0].event, "event");
  EXPECT_EQ(sent[0].id, "1700000000000000-1");
  EXPECT_EQ(sent[0].data.at("text"), "Stopping.");
}

TEST_F(ApiStreamTest, WhoComesBackGetsTheEventsInBetween) {
  for (const char* text : {"one", "two", "three"}) live_.events.add(1.0, "", text);
  const auto texts = [this](const std::string& last_event_id) {
    open("stream", last_event_id);
    std::vector<std::string> all;
    for (const Sent& sent : after(0.0)) {
      if (sent.event == "event") all.push_back(sent.data.at("text"));
    }
    return all;
  };
  EXPECT_THAT(texts("1"), ElementsAre("two", "three"));
  EXPECT_THAT(texts("3"), IsEmpty());
  EXPECT_THAT(texts("77"), ElementsAre("one", "two", "three")) << "of a gyrod that has ended";
  EXPECT_THAT(texts(""), IsEmpty()) << "new here";
  EXPECT_THAT(texts("x1"), IsEmpty());
  EXPECT_THAT(texts("1700000000000000-2"), ElementsAre("three"));
  EXPECT_THAT(texts("1700000000000000-"), IsEmpty());
  EXPECT_THAT(texts("1600000000000000-2"), ElementsAre("one", "two", "three")) << "another run's second";
  EXPECT_THAT(texts("1600000000000000-9"), ElementsAre("one", "two", "three"));
}

TEST_F(ApiStreamTest, WhoLeavesBeforeTheFirstEventComesBackToItsPlace) {
  live_.events.add(1.0, "", "before");
  open("stream");
  std::string place;
  for (const Sent& sent : after(0.0)) place += sent.id;
  EXPECT_EQ(place, "1700000000000000-1");
  stream_.reset();
  live_.events.add(2.0, "imu_front", "meanwhile");
  live_.events.add(2.0, "imu_rear", "meanwhile");
  for (const auto& [target, events] : {std::pair("stream", 2), std::pair("channels/imu_front/stream", 1)}) {
    open(target, place);
    int told = 0;
    for (const Sent& sent : after(1.0)) told += sent.event == "event" ? 1 : 0;
    EXPECT_EQ(told, events) << target;
    for (const Sent& sent : after(1.0)) EXPECT_NE(sent.event, "event") << "told once";
  }
}

TEST_F(ApiStreamTest, TheStatusComesBeforeTheEventsOfItsRun) {
  live_.events.add(1.0, "", "one");
  open("stream", "0");
  std::vector<std::string> kinds;
  for (const Sent& sent : after(0.0)) {
    if (!sent.event.empty()) kinds.push_back(sent.event);
  }
  EXPECT_THAT(kinds, ElementsAre("status", "event"));
}

TEST_F(ApiStreamTest, AStreamOfASensorTellsAllAndThenWhatIsNew) {
  open("channels/imu_front/stream?seconds=10&points=1000");
  const auto begin = after(0.0);
  EXPECT_EQ(first(begin, "channel").at("sensor"), "imu_front");
  EXPECT_TRUE(first(begin, "samples").at("from_ns").is_null()) << "nobody has looked before";
  send(300);
  const json whole = first(after(0.1), "samples");
  EXPECT_EQ(whole.at("append"), false);
  EXPECT_EQ(whole.at("raw").at("t_s").size(), 299U) << "the last stretch may get more samples";
  send(5);
  const json more = first(after(0.1), "samples");
  EXPECT_EQ(more.at("append"), true);
  EXPECT_EQ(more.at("from_ns"), whole.at("from_ns"));
  EXPECT_EQ(more.at("denoised").at("x_max").size(), 5U);
  const double step =
      more.at("raw").at("t_s")[0].get<double>() - whole.at("raw").at("t_s").back().get<double>();
  EXPECT_NEAR(step, 0.01, 1e-9) << "the next sample's, neither twice nor left out";
  EXPECT_THAT(after(0.1), IsEmpty());
}

TEST_F(ApiStreamTest, TheFiguresOfASensorComeWithItsReports) {
  open("channels/imu_front/stream");
  EXPECT_FALSE(first(after(0.0), "channel").is_null());
  EXPECT_TRUE(first(after(2.0), "channel").is_null());
  shown_.channels[0].last_report.model_epoch++;
  EXPECT_FALSE(first(after(1.0), "channel").is_null());
  shown_.channels[0].state = stream::ChannelState::kEnded;
  EXPECT_EQ(first(after(1.0), "channel").at("state"), "ended");
}

TEST_F(ApiStreamTest, TheSpectrumComesEveryTwoSecondsWhileSamplesCome) {
  open("channels/imu_front/stream");
  (void)after(0.0);
  send(600);
  const json spectrum = first(after(0.1), "spectrum");
  EXPECT_FALSE(spectrum.at("axes")[0].at("raw").is_null());
  send(100);
  EXPECT_TRUE(first(after(1.0), "spectrum").is_null());
  EXPECT_FALSE(first(after(1.0), "spectrum").is_null());
  EXPECT_TRUE(first(after(5.0), "spectrum").is_null()) << "nothing new";
}

TEST_F(ApiStreamTest, AClockThatGoesBackBeginsThePlotAnew) {
  open("channels/imu_front/stream");
  (void)after(0.0);
  send(100);
  (void)after(0.1);
  const stream::Sample early{.sequence = 0, .stamp_ns = 5, .rate_radps = {1.0, 2.0, 3.0}};
  live_.tap.on_raw("imu_front", {&early, 1});
  const json anew = first(after(0.1), "samples");
  EXPECT_EQ(anew.at("append"), false);
}

TEST_F(ApiStreamTest, AStreamWithoutNewsSaysThatItIsAlive) {
  open("channels/imu_front/stream");
  (void)after(0.0);
  EXPECT_THAT(after(14.0), IsEmpty());
  const auto sent = after(2.0);
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(sent[0].event, ": keep-alive");
}

TEST_F(ApiStreamTest, AForgottenSensorEndsItsStream) {
  open("channels/imu_front/stream");
  (void)after(0.0);
  shown_.channels.clear();
  std::string text;
  now_s_ += 1.0;
  EXPECT_THROW(stream_->append(text), std::runtime_error);
}

TEST_F(ApiStreamTest, SamplesAreKeptFromTheFirstLookOn) {
  EXPECT_EQ(get("channels/imu_front/samples").at("watched_s"), 0.0);
  send(50);
  now_s_ += 0.5;
  const json samples = get("channels/imu_front/samples?points=4000");
  EXPECT_EQ(samples.at("watched_s"), 0.5);
  EXPECT_EQ(samples.at("raw").at("t_s").size(), 50U) << "also the one that is not complete";
  EXPECT_EQ(samples.at("raw").at("y_max")[1], samples.at("raw").at("y_min")[1]);
  EXPECT_FLOAT_EQ(samples.at("raw").at("y_max")[1].get<float>(), static_cast<float>(0.02 * std::sin(2.0)));
}

TEST_F(ApiStreamTest, ASpectrumSaysHowLongItHasToBeWaitedFor) {
  shown_.channels[0].sample_rate_hz = 100.0;
  const json nothing = get("channels/imu_front/spectrum");
  EXPECT_EQ(nothing.at("needs_s"), 5.12);
  EXPECT_TRUE(nothing.at("axes")[0].at("raw").is_null());
  send(600);
  const json spectrum = get("channels/imu_front/spectrum");
  EXPECT_TRUE(spectrum.at("needs_s").is_null());
  EXPECT_EQ(spectrum.at("frequency_hz").size(), spectrum.at("axes")[2].at("denoised").size());
  EXPECT_NEAR(spectrum.at("axes")[0].at("noise_floor").get<double>(), 0.008 * std::sqrt(2.0 / 100.0), 1e-12);
}

TEST_F(ApiStreamTest, NoMoreThanSixteenSensorsAreLookedAtAtATime) {
  shown_.channels.clear();
  for (int i = 0; i < 17; ++i) shown_.channels.push_back(busy_sensor("imu" + std::to_string(i)));
  for (int i = 0; i < 16; ++i) (void)get("channels/imu" + std::to_string(i) + "/samples");
  const Answer refusal = ask("/api/v1/channels/imu16/samples");
  EXPECT_EQ(refusal.status, 503);
  EXPECT_THAT(refusal.headers, ::testing::Contains(std::pair<std::string, std::string>("Retry-After", "60")));
  (void)get("channels/imu3/samples");
  live_.tap.tidy(now_s_ + 61.0);
  (void)get("channels/imu16/samples");
}

}  // namespace
}  // namespace gyrod::monitor::test
