#include "architecture/include_rules.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>

namespace gyrod::architecture {
namespace {

using Words = std::vector<std::string_view>;

struct Room {
  std::string_view name;  ///< folder, relative to service/
  Words rooms;            ///< what it may include besides itself
  Words libraries;        ///< beginnings of <...> headers besides the standard library's
};

/// What every room may include of its lower neighbours is written out: the table is the drawing.
const std::vector<Room>& rooms() {
  static const std::vector<Room> table = {
      {"core/signal", {}, {"Eigen/", "unsupported/Eigen/"}},
      {"core/emd", {"core/signal"}, {"Eigen/", "emmintrin.h", "immintrin.h"}},
      {"core/denoise", {"core/signal", "core/emd"}, {"Eigen/"}},
      {"core/simulation", {"core/signal"}, {"Eigen/"}},
      {"core/allan", {"core/signal"}, {"Eigen/"}},
      {"core/inertial", {}, {"Eigen/"}},
      {"core/noise", {"core/signal"}, {"Eigen/"}},
      {"core/joint",
       {"core/signal", "core/emd", "core/denoise", "core/noise"},
       {"Eigen/", "immintrin.h", "emmintrin.h"}},
      {"core/evaluation", {}, {"Eigen/"}},
      {"stream", {"core/"}, {}},
      {"live", {"core/", "stream"}, {}},
      {"ros2", {}, {}},
      {"fleet", {}, {}},
      {"secrets", {}, {"sys/", "unistd.h"}},
      {"bus",
       {"core/", "stream", "ros2", "fleet", "secrets"},
       {"dds/", "gyrod.h", "sensor_msgs_imu.h", "openssl/", "sys/", "unistd.h"}},
      {"monitor",
       {"core/", "stream", "live", "secrets", "web"},
       {"prometheus/", "httplib.h", "nlohmann/", "openssl/", "crypt.h", "arpa/inet.h", "netdb.h", "netinet/",
        "poll.h", "sys/", "unistd.h"}},
      {"settings", {"core/", "stream", "ros2", "fleet"}, {"nlohmann/", "valijson/", "zlib.h"}},
      {"files", {"core/", "stream"}, {"zlib.h", "fcntl.h", "sys/", "unistd.h"}},
      {"web", {}, {}},
      {"report", {"core/", "web"}, {"nlohmann/"}},
      {"top", {"stream"}, {"httplib.h", "nlohmann/", "poll.h", "sys/", "termios.h", "unistd.h"}},
      {"app",
       {"core/", "stream", "live", "ros2", "fleet", "bus", "monitor", "settings", "files", "web", "report",
        "top"},
       {"CLI/", "Eigen/", "fcntl.h", "nlohmann/", "spdlog/", "systemd/", "sys/", "unistd.h"}}};
  return table;
}

/// Standard headers that bring threads, clocks, files or streams: numerics have no use for them.
constexpr std::array<std::string_view, 19> kNotInCore = {
    "thread",     "mutex",     "shared_mutex", "atomic",   "condition_variable",
    "future",     "semaphore", "latch",        "barrier",  "stop_token",
    "chrono",     "ctime",     "fstream",      "iostream", "sstream",
    "filesystem", "cstdio",    "csignal",      "random"};

bool in_folder(std::string_view path, std::string_view folder) {
  if (!path.starts_with(folder)) return false;
  return folder.ends_with('/') || path.substr(folder.size()).starts_with('/');
}

const Room* room_of(std::string_view path) {
  const auto found =
      std::ranges::find_if(rooms(), [&](const Room& room) { return in_folder(path, room.name); });
  return found == rooms().end() ? nullptr : &*found;
}

/// A C or C++ standard header has neither folder nor suffix; <stdint.h> and its kind are not used here.
bool is_standard(std::string_view header) { return header.find_first_of("./") == std::string_view::npos; }

std::string wrong_library(const Room& room, std::string_view header) {
  if (is_standard(header)) {
    const bool banned =
        room.name.starts_with("core/") && std::ranges::find(kNotInCore, header) != kNotInCore.end();
    return banned ? "core has no threads, clocks, files or streams, and random numbers of its own" : "";
  }
  const auto starts = [header](std::string_view library) { return header.starts_with(library); };
  if (std::ranges::any_of(room.libraries, starts)) return "";
  return std::string(room.name) + " does not use this library";
}

std::string wrong_room(const Room& room, std::string_view path) {
  if (room_of(path) == nullptr) return "not a path from service/ into one of its rooms";
  if (in_folder(path, room.name)) return "";
  const auto allowed = [path](std::string_view other) { return in_folder(path, other); };
  if (std::ranges::any_of(room.rooms, allowed)) return "";
  return std::string(room.name) + " does not depend on " + std::string(room_of(path)->name);
}

/// What stands behind #include on this line; nothing on any other line.
std::optional<std::string> included(std::string line) {
  std::erase_if(line, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
  constexpr std::string_view kDirective = "#include";
  if (!line.starts_with(kDirective)) return std::nullopt;
  line.erase(0, kDirective.size());
  const auto end = line.find_first_of("\">", 1);
  return end == std::string::npos ? line : line.substr(0, end + 1);
}

std::string what_is_wrong(const Room* room, std::string_view include) {
  if (room == nullptr) return "the file is in no room: give its folder a line in include_rules.cpp";
  if (include.size() < 2 || (include.front() != '<' && include.front() != '"')) {
    return "not a plain file name";
  }
  const std::string_view name = include.substr(1, include.size() - 2);
  return include.front() == '<' ? wrong_library(*room, name) : wrong_room(*room, name);
}

}  // namespace

std::vector<Violation> check_includes(std::string_view file, std::string_view text) {
  std::vector<Violation> violations;
  std::istringstream lines{std::string(text)};
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    const auto include = included(line);
    if (!include) continue;
    std::string reason = what_is_wrong(room_of(file), *include);
    if (!reason.empty()) violations.push_back({std::string(file), number, *include, std::move(reason)});
  }
  return violations;
}

}  // namespace gyrod::architecture
