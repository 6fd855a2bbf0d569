#include "bus/network_config.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "bus/bus_error.hpp"
#include "bus/loopback_xml.hpp"

namespace gyrod::bus {
namespace {

std::string read_xml(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file) {
    throw BusError(
        "network '" + path +
        "': cannot be read; expected \"loopback\", \"default\" or the path of a Cyclone DDS XML file");
  }
  // Cyclone would take any other text for a list of file names.
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  if (start == std::string::npos || text[start] != '<') {
    throw BusError("network '" + path + "': not XML; expected a Cyclone DDS configuration, <CycloneDDS>...");
  }
  return text;
}

/// Of several texts the later ones hold.
constexpr const char* kCallOften =
    R"(<CycloneDDS><Domain Id="any"><Discovery><SPDPInterval>250ms</SPDPInterval></Discovery></Domain></CycloneDDS>,)";

std::string chosen_config(const std::string& network) {
  if (network != "default") return read_xml(network);
  const char* uri = std::getenv("CYCLONEDDS_URI");
  return uri == nullptr ? "" : uri;
}

}  // namespace

std::string network_config(const std::string& network, Calling calling) {
  if (network == "loopback") return kLoopbackXml;
  return (calling == Calling::kOften ? kCallOften : "") + chosen_config(network);
}

}  // namespace gyrod::bus
