#include "top/address.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyrod::top {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Address, IsAHostAnAddressOrAUrl) {
  EXPECT_EQ(parse_address("car7").url(), "http://car7:9464");
  EXPECT_EQ(parse_address("10.0.0.7:80").url(), "http://10.0.0.7:80");
  EXPECT_EQ(parse_address("[::1]:9000").url(), "http://[::1]:9000");
  EXPECT_EQ(parse_address("[::1]").host, "::1");
  EXPECT_EQ(parse_address("http://car7").url(), "http://car7:80")
      << "a URL is what a browser would take it for";
  EXPECT_EQ(parse_address("https://car7/").url(), "https://car7:443");
}

TEST(Address, KeepsThePathThatAProxyHasInFront) {
  const Address address = parse_address("https://fleet.example:8443/car7/gyrod/");
  EXPECT_EQ(address.origin(), "https://fleet.example:8443");
  EXPECT_EQ(address.prefix, "/car7/gyrod");
}

TEST(Address, NamesWhatIsWrong) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      return "taken: " + parse_address(text).url();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  EXPECT_THAT(refusal("ftp://car7"), AllOf(HasSubstr("'ftp://car7'"), HasSubstr("neither http nor https")));
  EXPECT_THAT(refusal("car7:0"), HasSubstr("not 1 to 65535"));
  EXPECT_THAT(refusal("car7:99999"), HasSubstr("not 1 to 65535"));
  EXPECT_THAT(refusal("car7:"), HasSubstr("its port is ''"));
  EXPECT_THAT(refusal(""), HasSubstr("its host is ''"));
  EXPECT_THAT(refusal("[::1"), HasSubstr("no ']'"));
  EXPECT_THAT(refusal("[::1]x"), HasSubstr("more after ']'"));
  EXPECT_THAT(refusal("user@car7"), HasSubstr("its host"));
  EXPECT_THAT(refusal("car7/?a=b"), HasSubstr("a query"));
  EXPECT_THAT(refusal("car7\x1b[2J"), ::testing::Not(HasSubstr("\x1b")));
}

}  // namespace
}  // namespace gyrod::top
