/// The checker sees planted includes, and lets pass what is right.
#include "architecture/include_rules.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyrod::architecture {
namespace {

using ::testing::HasSubstr;

struct Planted {
  std::string file;
  std::string include;
};

void PrintTo(const Planted& planted, std::ostream* out) { *out << planted.file << " " << planted.include; }

class Forbidden : public testing::TestWithParam<Planted> {};
class Allowed : public testing::TestWithParam<Planted> {};

TEST_P(Forbidden, IsSeenWithFileLineAndInclude) {
  const auto& [file, include] = GetParam();
  const auto violations = check_includes(file, "#pragma once\n\n#include " + include + "\n");
  ASSERT_EQ(violations.size(), 1U);
  EXPECT_EQ(violations[0].file, file);
  EXPECT_EQ(violations[0].line, 3U);
  EXPECT_EQ(violations[0].include, include);
  EXPECT_FALSE(violations[0].reason.empty());
}

TEST_P(Allowed, PassesInSilence) {
  const auto& [file, include] = GetParam();
  EXPECT_TRUE(check_includes(file, "#include " + include + "\n").empty());
}

INSTANTIATE_TEST_SUITE_P(Upwards, Forbidden,
                         testing::Values(Planted{"core/emd/emd.cpp", "\"stream/sample.hpp\""},
                                         Planted{"stream/engine.cpp", "\"bus/wire.hpp\""},
                                         Planted{"stream/engine.hpp", "\"settings/settings.hpp\""},
                                         Planted{"files/line_reader.cpp", "\"app/service.hpp\""}));

INSTANTIATE_TEST_SUITE_P(Siblings, Forbidden,
                         testing::Values(Planted{"bus/publisher.hpp", "\"monitor/view.hpp\""},
                                         Planted{"monitor/view.hpp", "\"bus/subscriber.hpp\""},
                                         Planted{"settings/settings.hpp", "\"bus/bus_options.hpp\""},
                                         Planted{"files/csv_row.cpp", "\"settings/load.hpp\""}));

INSTANTIATE_TEST_SUITE_P(InsideCore, Forbidden,
                         testing::Values(Planted{"core/signal/moments.cpp", "\"core/emd/emd.hpp\""},
                                         Planted{"core/emd/emd.hpp", "\"core/denoise/screening.hpp\""},
                                         Planted{"core/denoise/denoiser.cpp",
                                                 "\"core/simulation/random.hpp\""},
                                         Planted{"core/simulation/random.cpp", "\"core/emd/emd.hpp\""}));

INSTANTIATE_TEST_SUITE_P(NotForNumerics, Forbidden,
                         testing::Values(Planted{"core/emd/emd.cpp", "<thread>"},
                                         Planted{"core/emd/emd.cpp", "<mutex>"},
                                         Planted{"core/signal/moments.cpp", "<atomic>"},
                                         Planted{"core/signal/moments.cpp", "<chrono>"},
                                         Planted{"core/denoise/denoiser.cpp", "<fstream>"},
                                         Planted{"core/denoise/denoiser.cpp", "<iostream>"},
                                         Planted{"core/denoise/denoiser.cpp", "<filesystem>"},
                                         Planted{"core/denoise/denoiser.cpp", "<nlohmann/json.hpp>"},
                                         Planted{"core/simulation/random.cpp", "<random>"}));

INSTANTIATE_TEST_SUITE_P(LibraryInTheWrongRoom, Forbidden,
                         testing::Values(Planted{"stream/engine.cpp", "<dds/dds.h>"},
                                         Planted{"app/service.cpp", "<dds/dds.h>"},
                                         Planted{"bus/log.cpp", "<spdlog/spdlog.h>"},
                                         Planted{"live/live.cpp", "<nlohmann/json.hpp>"},
                                         Planted{"files/csv_row.cpp", "<Eigen/Core>"}));

INSTANTIATE_TEST_SUITE_P(NotAPathFromService, Forbidden,
                         testing::Values(Planted{"bus/log.cpp", "\"log.hpp\""},
                                         Planted{"bus/log.cpp", "\"../stream/engine.hpp\""},
                                         Planted{"bus/log.cpp", "\"tests/support/samples.hpp\""},
                                         Planted{"bus/log.cpp", "GYROD_HEADER"},
                                         Planted{"attic/new.cpp", "\"core/emd/emd.hpp\""}));

INSTANTIATE_TEST_SUITE_P(Rules, Allowed,
                         testing::Values(Planted{"core/emd/emd.cpp", "\"core/signal/moments.hpp\""},
                                         Planted{"core/denoise/denoiser.hpp", "\"core/emd/emd.hpp\""},
                                         Planted{"core/denoise/ar_model.cpp", "<Eigen/Core>"},
                                         Planted{"core/emd/emd.cpp", "<algorithm>"},
                                         Planted{"stream/engine.cpp", "<thread>"},
                                         Planted{"stream/engine.cpp", "\"core/denoise/denoiser.hpp\""},
                                         Planted{"bus/wire.hpp", "\"stream/sample.hpp\""},
                                         Planted{"bus/wire.hpp", "<dds/dds.h>"},
                                         Planted{"app/service.cpp", "\"files/recording_reader.hpp\""}));

TEST(IncludeRules, SpacesAndCommentsBehindAnIncludeDoNotHideIt) {
  const auto violations = check_includes("core/emd/emd.cpp", "  #  include <thread>  // why not\n");
  ASSERT_EQ(violations.size(), 1U);
  EXPECT_EQ(violations[0].include, "<thread>");
}

TEST(IncludeRules, EveryViolationOfAFileIsListed) {
  EXPECT_EQ(check_includes("stream/engine.cpp", "#include \"bus/log.hpp\"\n#include <zlib.h>\n").size(), 2U);
}

TEST(IncludeRules, AnIncludeInACommentIsNone) {
  EXPECT_TRUE(check_includes("core/emd/emd.cpp", "// #include <thread>\n").empty());
}

TEST(IncludeRules, TheReasonNamesBothRooms) {
  const auto violations = check_includes("stream/engine.cpp", "#include \"bus/log.hpp\"\n");
  ASSERT_EQ(violations.size(), 1U);
  EXPECT_THAT(violations[0].reason, HasSubstr("stream does not depend on bus"));
}

}  // namespace
}  // namespace gyrod::architecture
