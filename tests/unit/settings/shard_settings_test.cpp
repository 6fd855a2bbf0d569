#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "settings/load.hpp"

namespace gyrod::settings {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(ShardSettings, IndexAndCountAreTaken) {
  for (const std::string shard : {"", "1/1", "2/3", "64/64"}) {
    const Outcome outcome = read_settings(R"({"bus": {"shard": ")" + shard + R"("}})", ".");
    EXPECT_THAT(outcome.issues, IsEmpty()) << shard;
    EXPECT_EQ(outcome.settings.bus.shard, shard);
  }
}

TEST(ShardSettings, AnythingElseIsNamedWithWhatIsExpected) {
  for (const std::string shard : {"0/3", "4/3", "2", "1/65", "a/b"}) {
    const Outcome outcome = read_settings(R"({"bus": {"shard": ")" + shard + R"("}})", ".");
    ASSERT_THAT(outcome.issues, SizeIs(1)) << shard;
    EXPECT_EQ(outcome.issues[0].message,
              "bus.shard is \"" + shard +
                  "\"; expected \"\", or INDEX/COUNT with 1 <= INDEX <= COUNT <= 64, e.g. \"2/3\"");
  }
}

}  // namespace
}  // namespace gyrod::settings
