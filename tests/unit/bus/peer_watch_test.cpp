/// Who is told to be kept out, over the loopback interface: domains that are different ones in the process and one on the wire.
#include "bus/peer_watch.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>

#include "bus/raw_writer.hpp"
#include "bus/security_error.hpp"
#include "bus/subscriber.hpp"
#include "support/eventually.hpp"
#include "support/security_folder.hpp"

namespace gyrod::bus::test {
namespace {

using gyrod::testing::eventually;
using gyrod::testing::ScratchFolder;
using gyrod::testing::SecurityFolder;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::uint32_t kOwnDomain = 74;
constexpr std::uint32_t kPeerDomain = 75;
/// The id that both show on the wire: one of 220..230, which no other test uses, so that two runs on a machine hardly ever meet.
std::uint32_t wire() { return 220 + static_cast<std::uint32_t>(getpid()) % 11; }

/// For readers whose samples do not matter.
struct Ignore final : SampleHandler {
  void on_samples(std::string_view, std::span<const stream::Sample>) noexcept override {}
  void on_end(std::string_view) noexcept override {}
  void on_return(std::string_view) noexcept override {}
  void on_broken_promise(std::string_view, stream::ChannelState) noexcept override {}
};

class PeerWatchTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { made_ = std::make_unique<SecurityFolder>(); }
  static void TearDownTestSuite() { made_.reset(); }

  PeerWatchTest() {
    const char* source_dir = std::getenv("GYROD_SOURCE_DIR");
    std::ifstream loopback(std::string(source_dir == nullptr ? "." : source_dir) +
                           "/config/cyclonedds/loopback.xml");
    std::string xml{std::istreambuf_iterator<char>(loopback), {}};
    const std::string place = "<Discovery>";
    xml.insert(xml.find(place) + place.size(),
               "<ExternalDomainId>" + std::to_string(wire()) + "</ExternalDomainId>");
    network_ = scratch_.write("network.xml", xml);
  }

  [[nodiscard]] Domain join(std::uint32_t id, const std::string& folder) const {
    return {id, network_, folder};
  }

  /// Looks until something is told. @return all that was
  static std::vector<std::string> told(PeerWatch& watch, PeerWatch::Clock::time_point now) {
    std::vector<std::string> lines;
    EXPECT_TRUE(eventually([&] {
      for (std::string& line : watch.look(now)) lines.push_back(std::move(line));
      return !lines.empty();
    }));
    return lines;
  }

  static std::unique_ptr<SecurityFolder> made_;
  PeerWatch::Clock::time_point now_ = PeerWatch::Clock::now();

 private:
  ScratchFolder scratch_;
  std::string network_;
};
std::unique_ptr<SecurityFolder> PeerWatchTest::made_;

TEST_F(PeerWatchTest, APeerWithoutSecurityIsToldAtOnceAndOnce) {
  PeerWatch watch(join(kOwnDomain, made_->of("gyrod")));
  const Domain peer = join(kPeerDomain, "");
  EXPECT_THAT(told(watch, now_), ElementsAre(AllOf(HasSubstr("without DDS Security"), HasSubstr("pid "),
                                                   HasSubstr("127.0.0.1"))));
  EXPECT_THAT(watch.look(now_ + 2 * PeerWatch::kPatience), IsEmpty());
  EXPECT_EQ(watch.refused(), 1U);
}

TEST_F(PeerWatchTest, APeerThatIsLetInIsNotTold) {
  const Domain own = join(kOwnDomain, made_->of("gyrod"));
  PeerWatch watch(own);
  Ignore handler;
  const BusOptions options;
  const Subscriber reader(own, options, handler);
  RawWriter peer(join(kPeerDomain, made_->of("sensor")), options, 1);
  ASSERT_TRUE(peer.wait_for_subscriber(std::chrono::seconds{60}));
  ASSERT_TRUE(eventually([&] { return reader.matched_writers() == 1; }));
  EXPECT_THAT(watch.look(now_), IsEmpty());
  EXPECT_THAT(watch.look(now_ + 2 * PeerWatch::kPatience), IsEmpty());
  EXPECT_EQ(watch.refused(), 0U);
}

TEST_F(PeerWatchTest, APeerOfAnotherAuthorityIsToldAfterAWhile) {
  const SecurityFolder other({"--program", "stranger=sensor"});
  PeerWatch watch(join(kOwnDomain, made_->of("gyrod")));
  const Domain peer = join(kPeerDomain, other.of("stranger"));
  // The clock is ours: first seen now, looked at again when the patience is over.
  EXPECT_THAT(watch.look(now_), IsEmpty());
  const auto step = PeerWatch::kPatience + std::chrono::seconds{1};
  std::vector<std::string> lines;
  EXPECT_TRUE(eventually([&] {
    now_ += step;
    for (std::string& line : watch.look(now_)) lines.push_back(std::move(line));
    return !lines.empty();
  }));
  EXPECT_THAT(lines, ElementsAre(AllOf(HasSubstr("127.0.0.1"), HasSubstr("shown no topic for 10 s"))));
  EXPECT_EQ(watch.refused(), 1U);
}

TEST_F(PeerWatchTest, WhoseCertificateEndsIsGoneForOthersAndCanStillWriteAndLeave) {
  const std::string ending = made_->copy("sensor", "ending");
  made_->reissue(ending, -std::chrono::hours(1), std::chrono::seconds(8));
  const Domain own = join(kOwnDomain, made_->of("gyrod"));
  Ignore handler;
  const BusOptions options;
  const Subscriber reader(own, options, handler);
  RawWriter peer(join(kPeerDomain, ending), options, 1);
  ASSERT_TRUE(peer.wait_for_subscriber(std::chrono::seconds{60}));
  ASSERT_TRUE(eventually([&] { return reader.matched_writers() == 1; }));
  ASSERT_TRUE(eventually([&] { return reader.matched_writers() == 0; }));
  const stream::Sample sample{};
  EXPECT_EQ(peer.publish("imu", {&sample, 1}), 1U) << "nobody tells the writer";
}

TEST_F(PeerWatchTest, ADomainSaysWhoItIsAndOtherFilesForItAreRefusedInTheProcess) {
  const Domain domain = join(kOwnDomain, made_->of("gyrod"));
  ASSERT_TRUE(domain.identity());
  EXPECT_EQ(domain.identity()->subject, "CN=gyrod,O=gyrod TEST");
  EXPECT_THAT([&] { (void)join(kOwnDomain, made_->of("sensor")); },
              ::testing::ThrowsMessage<BusError>(
                  AllOf(HasSubstr(made_->of("gyrod")), HasSubstr(made_->of("sensor")))));
  EXPECT_FALSE(join(kPeerDomain, "").identity());
}

}  // namespace
}  // namespace gyrod::bus::test
