/// The tree as it is obeys the drawing in service/CMakeLists.txt.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "architecture/include_rules.hpp"

namespace gyrod::architecture {
namespace {

namespace fs = std::filesystem;

constexpr std::ptrdiff_t kMaxLines = 300;

struct SourceFile {
  std::string path;  ///< relative to service/
  std::string text;
};

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Every C++ file of a folder, also those that CMake fills in (*.hpp.in).
std::vector<SourceFile> sources_below(const fs::path& folder) {
  std::vector<SourceFile> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool is_code = name.find(".cpp") != std::string::npos || name.find(".hpp") != std::string::npos;
    if (!entry.is_regular_file() || !is_code) continue;
    found.push_back({entry.path().lexically_relative(folder).generic_string(), text_of(entry.path())});
  }
  std::ranges::sort(found, {}, &SourceFile::path);
  return found;
}

std::vector<SourceFile> service_sources() {
  const char* project = std::getenv("GYROD_SOURCE_DIR");
  return sources_below(fs::path(project == nullptr ? "." : project) / "service");
}

TEST(Architecture, EveryRoomIsFoundAndRead) {
  const auto sources = service_sources();
  for (const std::string room : {"core/", "stream/", "bus/", "monitor/", "settings/", "files/", "app/"}) {
    EXPECT_TRUE(std::ranges::any_of(sources, [&](const SourceFile& file) {
      return file.path.starts_with(room) && file.text.find("#include") != std::string::npos;
    })) << room;
  }
}

TEST(Architecture, EveryIncludeFollowsTheDirectionOfDependency) {
  for (const SourceFile& file : service_sources()) {
    for (const Violation& wrong : check_includes(file.path, file.text)) {
      ADD_FAILURE() << "service/" << wrong.file << ":" << wrong.line << ": #include " << wrong.include << ": "
                    << wrong.reason;
    }
  }
}

TEST(Architecture, NoFileIsLongerThanThreeHundredLines) {
  for (const SourceFile& file : service_sources()) {
    EXPECT_LE(std::ranges::count(file.text, '\n'), kMaxLines) << "service/" << file.path;
  }
}

}  // namespace
}  // namespace gyrod::architecture
