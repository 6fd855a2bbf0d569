/// The other daemons with the same output, as they come and leave.
#include "bus/other_daemons.hpp"

#include <array>
#include <optional>

#include "bus/qos.hpp"
#include "bus/topic_reader.hpp"
#include "bus/topic_writer.hpp"
#include "unit/bus/bus_test.hpp"

namespace gyrod::bus::test {
namespace {

class OtherDaemonsTest : public BusTest {
 protected:
  OtherDaemonsTest() { options_.ownership_strength = 1; }

  /// One that is stronger.
  void come() {
    BusOptions stronger = options_;
    stronger.ownership_strength = 5;
    writer_.emplace(there_.participant(), topic_, output_writer_qos(stronger));
    wait_until([this] {
      others_.look(reader_.get(), kCame_s);
      return others_.size() == 1;
    });
    ASSERT_EQ(dds_get_matched_publications(reader_.get(), &handle_, 1), 1);
  }
  void leave() {
    writer_.reset();
    wait_until([this] {
      others_.look(reader_.get(), kLeft_s);
      return others_.size() == 0;
    });
  }

  static constexpr double kCame_s = 100.0;
  static constexpr double kLeft_s = 200.0;
  dds_instance_handle_t handle_ = 0;
  OtherDaemons others_{1, 0.5, 0.0};

 private:
  std::string topic_ = options_.topics.denoised_batch;
  Domain here_ = reader_domain();
  Domain there_ = writer_domain();
  TopicReader<gyrod_DenoisedBatch> reader_{here_.participant(), topic_, standby_reader_qos(options_)};
  std::optional<TopicWriter<gyrod_DenoisedBatch>> writer_;
};

TEST_P(OtherDaemonsTest, AreKnownWithTheirStrengthWhileTheyAreThere) {
  come();
  EXPECT_TRUE(others_.knows(handle_));
  EXPECT_TRUE(others_.is_stronger(handle_));
  EXPECT_TRUE(others_.now(kCame_s).any);
  EXPECT_TRUE(others_.now(kCame_s).stronger);
  EXPECT_FALSE(others_.knows(handle_ + 1));
}

// What it sent last may be taken after discovery has told that it is gone, and would come twice if it did not count.
TEST_P(OtherDaemonsTest, OneThatHasLeftIsStillHeardAndCountsForATickMore) {
  come();
  leave();
  EXPECT_TRUE(others_.knows(handle_));
  EXPECT_TRUE(others_.is_stronger(handle_));
  EXPECT_TRUE(others_.now(kLeft_s + 0.019).any);
  EXPECT_TRUE(others_.now(kLeft_s + 0.019).stronger);
  EXPECT_FALSE(others_.now(kLeft_s + 0.021).any);
  EXPECT_FALSE(others_.now(kLeft_s + 0.021).stronger);
}

INSTANTIATE_TEST_SUITE_P(Bus, OtherDaemonsTest, testing::Values(Route::kInProcess, Route::kUdp), route_name);

}  // namespace
}  // namespace gyrod::bus::test
