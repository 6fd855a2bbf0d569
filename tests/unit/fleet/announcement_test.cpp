#include "fleet/announcement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyrod::fleet {
namespace {

using ::testing::SizeIs;

TEST(Announcement, IsReadBackAsItWasTold) {
  for (const Announcement& told :
       {Announcement{{2, 3}, true, {"a1", "b2"}, {"c3"}, {"d4"}, 7}, Announcement{{1, 1}, false, {}}})
    EXPECT_EQ(parse_announcement(text_of(told)), told);
}

TEST(Announcement, IsTextThatOthersCanRead) {
  EXPECT_EQ(text_of(Announcement{{2, 3}, true, {"a1", "b2"}, {"c3"}, {"d4", "e5"}}),
            "gyrod.shard=2/3;gyrod.state=active;gyrod.yields=a1,b2;gyrod.greets=c3;gyrod.awaits=d4,e5;");
}

TEST(Announcement, SaysHowManyHandOversWereToldAlsoByADaemonThatHasLeft) {
  EXPECT_TRUE(text_of(Announcement{{1, 1}, true, {}, {}, {}, 7}).ends_with(";gyrod.awaits=;gyrod.handed=7;"));
  EXPECT_EQ(text_of_leaving(8), "gyrod.handed=8;");
  EXPECT_EQ(parse_announcement(text_of_leaving(8)), std::nullopt);
  EXPECT_EQ(parse_handed(text_of_leaving(8)), 8U);
  EXPECT_EQ(parse_handed("typehash=RIHS01_7d9a;gyrod.handed=18446744073709551615"), UINT64_MAX);
  for (const char* text :
       {"", "gyrod.handed=", "gyrod.handed=-1;", "gyrod.handed=2x;", "gyrod.handed=18446744073709551616;"})
    EXPECT_EQ(parse_handed(text), std::nullopt) << text;
}

TEST(Announcement, LeavesRoomForWhatOthersWriteBesides) {
  const auto read = parse_announcement("typehash=RIHS01_7d9a;gyrod.shard=1/2;gyrod.state=active;later=1;");
  EXPECT_EQ(read, (Announcement{{1, 2}, true, {}}));
}

TEST(Announcement, IsNoneWithoutAShardOrWithAnythingMalformed) {
  for (const char* text :
       {"", ";", "typehash=RIHS01_7d9a;", "gyrod.state=active;", "gyrod.shard=3/2;gyrod.state=active;",
        "gyrod.shard=;", "gyrod.shard=1/2;gyrod.state=dancing;"}) {
    EXPECT_EQ(parse_announcement(text), std::nullopt) << text;
  }
}

TEST(Announcement, OfAStrangerIsBounded) {
  std::string text = "gyrod.shard=1/2;gyrod.state=active";
  for (const char* key : {";gyrod.yields=", ";gyrod.greets=", ";gyrod.awaits="}) {
    text += key;
    for (int i = 0; i < 100000; ++i) text += "x,";
  }
  const auto read = parse_announcement(text);
  ASSERT_TRUE(read.has_value());
  EXPECT_THAT(read->yields_to, SizeIs(kMostPeers));
  EXPECT_THAT(read->greets, SizeIs(kMostPeers));
  EXPECT_THAT(read->awaits, SizeIs(kMostPeers));
}

}  // namespace
}  // namespace gyrod::fleet
