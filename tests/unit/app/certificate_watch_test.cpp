#include "app/certificate_watch.hpp"

#include <gmock/gmock.h>

namespace gyrod::app {
namespace {

using std::chrono::days;
using std::chrono::hours;
using std::chrono::seconds;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::chrono::sys_seconds kEnd{seconds(1'800'000'000)};

CertificateWatch watch() {
  return {{.subject = "CN=gyrod", .expires_at = kEnd, .expiring_file = "/etc/gyrod/cert.pem"}, days(30)};
}

TEST(CertificateWatch, SaysNothingUntilTheEndIsNear) {
  auto watched = watch();
  EXPECT_FALSE(watched.look(kEnd - days(31)));
  EXPECT_FALSE(watched.look(kEnd - days(30) - seconds(1)));
}

TEST(CertificateWatch, WarnsOnceADayWithTheFileAndTheDaysThatAreLeft) {
  auto watched = watch();
  const auto first = watched.look(kEnd - days(30));
  ASSERT_TRUE(first);
  EXPECT_FALSE(first->expired);
  EXPECT_THAT(first->line, AllOf(HasSubstr("'/etc/gyrod/cert.pem'"), HasSubstr("30 days")));
  EXPECT_FALSE(watched.look(kEnd - days(30) + seconds(1)));
  EXPECT_FALSE(watched.look(kEnd - days(29) - seconds(1)));
  const auto second = watched.look(kEnd - days(29));
  ASSERT_TRUE(second);
  EXPECT_THAT(second->line, HasSubstr("29 days"));
}

TEST(CertificateWatch, SaysAtOnceThatItHasEndedAndThenOnceADay) {
  auto watched = watch();
  EXPECT_TRUE(watched.look(kEnd - hours(1)));
  EXPECT_FALSE(watched.look(kEnd - seconds(1)));
  const auto end = watched.look(kEnd);
  ASSERT_TRUE(end);
  EXPECT_TRUE(end->expired);
  EXPECT_THAT(end->line, HasSubstr("has expired"));
  EXPECT_FALSE(watched.look(kEnd + seconds(1)));
  EXPECT_TRUE(watched.look(kEnd + days(1)));
}

}  // namespace
}  // namespace gyrod::app
