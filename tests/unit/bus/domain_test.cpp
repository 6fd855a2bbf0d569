/// Domains: which network, and what is said about a bad one.
#include "bus/domain.hpp"

#include <optional>

#include <gmock/gmock.h>

#include "bus/bus_error.hpp"
#include "bus/log.hpp"
#include "bus/publisher.hpp"
#include "bus/topic_reader.hpp"
#include "unit/bus/bus_test.hpp"

namespace gyrod::bus::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string error_of(const auto& action) {
  try {
    action();
  } catch (const BusError& error) {
    return error.what();
  }
  return "";
}

std::string write_file(const std::string& name, const std::string& text) {
  const std::string path = testing::TempDir() + name + std::to_string(getpid()) + ".xml";
  std::ofstream(path) << text;
  return path;
}

TEST(DomainTest, ObjectsOfOneIdAndNetworkShareTheDomain) {
  std::optional<Domain> first(std::in_place, kReaderDomain, "loopback");
  const Domain second(kReaderDomain, "loopback");
  EXPECT_NE(first->participant(), second.participant());
  first.reset();
  EXPECT_GT(second.participant(), 0);
}

TEST(DomainTest, AnotherNetworkForAnOpenDomainIsRefusedAndBothAreNamed) {
  const Domain open(kReaderDomain, "loopback");
  EXPECT_THAT(error_of([] { const Domain refused(kReaderDomain, "default"); }),
              AllOf(HasSubstr("71"), HasSubstr("'loopback'"), HasSubstr("'default'")));
}

TEST(DomainTest, ADomainCanBeOpenedAgainOnAnotherNetwork) {
  { const Domain closed(kReaderDomain, "loopback"); }
  EXPECT_GT(Domain(kReaderDomain, udp_network_file()).participant(), 0);
}

TEST(DomainTest, ObjectsOutliveTheDomainTheyWereMadeFrom) {
  std::optional<Domain> domain(std::in_place, kReaderDomain, "loopback");
  Publisher publisher(*domain, test_options());
  domain.reset();
  publisher.publish_report("gyro", stream::NoiseReport{});
  EXPECT_EQ(publisher.write_errors(), 0U);
}

TEST(DomainTest, AMissingNetworkFileIsNamed) {
  EXPECT_THAT(error_of([] { const Domain domain(kReaderDomain, "/no/such/file.xml"); }),
              HasSubstr("/no/such/file.xml"));
}

TEST(DomainTest, ANetworkFileThatIsNotXmlIsNamed) {
  const std::string path = write_file("gyrod_not_xml_", "loopback\n");
  EXPECT_THAT(error_of([&] { const Domain domain(kReaderDomain, path); }),
              AllOf(HasSubstr(path), HasSubstr("not XML")));
}

TEST(DomainTest, ABadElementIsNamedWithItsFile) {
  const std::string path = write_file(
      "gyrod_bad_element_",
      "<CycloneDDS><Domain Id=\"any\"><General><Nonsense>1</Nonsense></General></Domain></CycloneDDS>");
  EXPECT_THAT(error_of([&] { const Domain domain(kReaderDomain, path); }),
              AllOf(HasSubstr(path), HasSubstr("Nonsense")));
}

TEST(DomainTest, AMissingInterfaceIsNamedWithItsFile) {
  const std::string path = write_file(
      "gyrod_bad_interface_",
      "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"nosuch0\"/></Interfaces>"
      "</General></Domain></CycloneDDS>");
  EXPECT_THAT(error_of([&] { const Domain domain(kReaderDomain, path); }),
              AllOf(HasSubstr(path), HasSubstr("nosuch0")));
}

TEST(DomainTest, AnIdBeyondThePortsIsRefused) {
  EXPECT_THAT(error_of([] { const Domain domain(231, "loopback"); }),
              AllOf(HasSubstr("231"), HasSubstr("0..230")));
}

TEST(DomainTest, TheVehicleConfigurationOfTheRepositoryIsValid) {
  const char* source_dir = std::getenv("GYROD_SOURCE_DIR");
  const std::string path =
      std::string(source_dir == nullptr ? "." : source_dir) + "/config/cyclonedds/default.xml";
  std::ifstream file(path);
  std::string xml{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  // Tests stay on the loopback interface.
  const std::string any = "autodetermine=\"true\"";
  ASSERT_NE(xml.find(any), std::string::npos);
  xml.replace(xml.find(any), any.size(), "name=\"lo\"");
  const std::string spdp = "<AllowMulticast>spdp";
  ASSERT_NE(xml.find(spdp), std::string::npos);
  xml.replace(xml.find(spdp), spdp.size(), "<AllowMulticast>false");
  const std::string copy = write_file("gyrod_default_", xml);
  EXPECT_EQ(error_of([&] { const Domain domain(kReaderDomain, copy); }), "");
}

TEST(DomainTest, ATopicNameThatDdsRefusesIsNamed) {
  BusOptions options = test_options();
  options.topics.denoised = "not a topic name";
  EXPECT_THAT(error_of([&] { const Publisher publisher(Domain(kReaderDomain, "loopback"), options); }),
              HasSubstr("'not a topic name'"));
}

TEST(DomainTest, AQosThatDdsRefusesIsNamedWithItsTopic) {
  const Domain domain(kReaderDomain, "loopback");
  Qos qos;
  qos.reliable(0).keep_last(0);
  EXPECT_THAT(
      error_of([&] { const TopicReader<gyrod_GyroSample> reader(domain.participant(), "some/topic", qos); }),
      AllOf(HasSubstr("'some/topic'"), HasSubstr("keep last 0")));
}

TEST(LogTest, TheMiddlewaresMessagesReachTheHandler) {
  std::string errors;
  set_log_handler([&](LogLevel level, std::string_view message) {
    if (level == LogLevel::kError) errors += message;
  });
  const std::string path =
      write_file("gyrod_log_", "<CycloneDDS><Domain Id=\"any\"><Nonsense>1</Nonsense></Domain></CycloneDDS>");
  EXPECT_NE(error_of([&] { const Domain domain(kReaderDomain, path); }), "");
  set_log_handler({});
  EXPECT_THAT(errors, HasSubstr("Nonsense"));
}

}  // namespace
}  // namespace gyrod::bus::test
