/// docs/api.md against the answers: neither has a field that the other has not.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "unit/monitor/api_fixture.hpp"

namespace gyrod::monitor::test {
namespace {

std::string manual() {
  const char* project = std::getenv("GYROD_SOURCE_DIR");
  std::ifstream file(std::string(project == nullptr ? "." : project) + "/docs/api.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Keys of objects, however deep; names that are data (states, reasons) are not fields.
void collect(const nlohmann::json& value, std::set<std::string>& fields) {
  static const std::set<std::string> kByName = {"rejected", "by_health"};
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) {
      fields.insert(key);
      if (!kByName.contains(key)) collect(member, fields);
    }
  } else if (value.is_array()) {
    for (const auto& member : value) collect(member, fields);
  }
}

bool is_field(const std::string& word) {
  return !word.empty() && std::ranges::all_of(word, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

/// What stands in backquotes in the rows of tables of fields, and in sentences.
std::set<std::string> words_of(const std::string& text) {
  std::set<std::string> words;
  for (std::size_t begin = text.find('`'); begin != std::string::npos; begin = text.find('`', begin + 1)) {
    const std::size_t end = text.find('`', begin + 1);
    if (end == std::string::npos) break;
    if (const std::string word = text.substr(begin + 1, end - begin - 1); is_field(word)) words.insert(word);
    begin = end;
  }
  return words;
}

/// The first words of the rows of tables of fields.
std::set<std::string> rows_of_fields(const std::string& text) {
  std::set<std::string> fields;
  const std::string head = "| field | meaning |\n|---|---|\n";
  for (std::size_t at = text.find(head); at != std::string::npos; at = text.find(head, at)) {
    at += head.size();
    while (text[at] == '|') {
      const std::size_t end = text.find('\n', at);
      const auto row = words_of(text.substr(at, text.find(" | ", at) - at));
      fields.insert(row.begin(), row.end());
      at = end + 1;
    }
  }
  return fields;
}

class ApiManual : public ApiTest {
 protected:
  /// Of every answer there is.
  std::set<std::string> answered() {
    stream::ChannelSnapshot& sensor = shown_.channels[0];
    sensor.last_report.axis[0].imf[0].model.family = core::ModelFamily::kAr;
    live_.noise.note(sensor);
    live_.events.add(1.0, "", "Stopping.");
    std::set<std::string> fields;
    for (const char* target : {"status", "channels?history=1", "channels/imu_front",
                               "channels/imu_front/samples", "channels/imu_front/spectrum", "events"})
      collect(get(target), fields);
    const Answer answer = ask("/api/v1/stream?channels=1");
    std::string text;
    answer.events->append(text);
    const std::size_t data = text.find("event: channels\ndata: ") + 22;
    collect(json::parse(text.substr(data, text.find('\n', data) - data)), fields);
    return fields;
  }
};

TEST_F(ApiManual, EveryFieldThatIsAnsweredIsExplained) {
  const auto words = words_of(manual());
  for (const std::string& field : answered()) EXPECT_TRUE(words.contains(field)) << field;
}

TEST_F(ApiManual, EveryFieldThatIsExplainedIsAnswered) {
  const auto fields = answered();
  const auto rows = rows_of_fields(manual());
  EXPECT_GT(rows.size(), 50U);
  for (const std::string& field : rows) EXPECT_TRUE(fields.contains(field)) << field;
}

}  // namespace
}  // namespace gyrod::monitor::test
