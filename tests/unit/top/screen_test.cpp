#include "top/screen.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/api_answers.hpp"

namespace gyrod::top {
namespace {

using gyrod::testing::events_json;
using gyrod::testing::sensor_json;
using gyrod::testing::sensors_json;
using gyrod::testing::status_json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Picture picture_of(const std::string& rows, int count) {
  return {.url = "http://car7:9464",
          .status = parse_status(status_json()),
          .page = parse_sensors(sensors_json(rows, count)),
          .events = parse_events(events_json()),
          .trouble = {}};
}

std::string text_of(const Picture& picture, const View& view = {}, Size size = {100, 24}) {
  std::string text;
  for (const Line& line : screen(picture, view, size)) text += line.plain(size.columns) + "\n";
  return text;
}

TEST(Screen, ShowsGyrodAndItsSensors) {
  const std::string text =
      text_of(picture_of(sensor_json("front", "noisy") + "," + sensor_json("rear", "ok"), 2));
  EXPECT_THAT(text,
              AllOf(HasSubstr("gyrod 0.1.0 at http://car7:9464  up 2 h 5 min  ready"),
                    HasSubstr("samples 12.3 k/s  windows -  added latency p99 12.3 ms  workers 1/2 busy"),
                    HasSubstr("overload: hop widened"), HasSubstr("gyros 2: 1 noisy, 1 ok")));
  EXPECT_THAT(text, HasSubstr("N front"));
  EXPECT_THAT(text, HasSubstr("noisy          100.0       0.573 ->   0.0286  20.0 dB    1.50"));
  EXPECT_THAT(text, HasSubstr("O rear"));
  EXPECT_THAT(text, HasSubstr("z  ok                 - -> 0.0286")) << "an axis of which nothing is known";
}

TEST(Screen, FitsAnyTerminal) {
  const Picture picture = picture_of(sensor_json("front", "noisy"), 1);
  for (std::size_t rows = 1; rows < 40; ++rows) {
    for (const std::size_t columns : {1U, 20U, 80U, 200U}) {
      const Size size{columns, rows};
      const auto lines = screen(picture, {}, size);
      EXPECT_LE(lines.size(), rows);
      for (const Line& line : lines) EXPECT_LE(line.plain(columns).size(), columns);
    }
  }
}

TEST(Screen, SaysWhatToDoWhereThereIsNoSensor) {
  Picture picture = picture_of("", 0);
  picture.status->open = 0;
  EXPECT_THAT(text_of(picture), AllOf(HasSubstr("No gyro has sent anything yet; 2 writers are matched"),
                                      HasSubstr("gyro/raw, gyro/raw_batch"), HasSubstr("gyrod simulate")));
  picture.status->open = 3;
  View view;
  view.search = "imu";
  EXPECT_THAT(text_of(picture, view), HasSubstr("No gyro matches the search"));
}

TEST(Screen, KeepsWhatWasKnownBesideTheTrouble) {
  Picture picture = picture_of(sensor_json("front", "ok"), 1);
  picture.trouble = "http://car7:9464: no connection within 3 s";
  EXPECT_THAT(text_of(picture), AllOf(HasSubstr("front"), HasSubstr("no connection within 3 s")));
  EXPECT_THAT(
      text_of({.url = "http://car7:9464", .status = {}, .page = {}, .events = {}, .trouble = "nobody there"}),
      AllOf(HasSubstr("gyrod at http://car7:9464"), HasSubstr("nobody there")));
}

TEST(Screen, TellsWhatHappenedWhereThereIsRoom) {
  const Picture picture = picture_of(sensor_json("front", "ok"), 1);
  EXPECT_THAT(text_of(picture, {}, {80, 28}),
              AllOf(HasSubstr("\n01:01:01Z  front is noisy?[2J\nq quit"), HasSubstr("z  ok")));
  EXPECT_THAT(text_of(picture, {}, {80, 27}), Not(HasSubstr("is noisy")));
}

TEST(Screen, ChangesItsUnit) {
  View view;
  view.unit = RateUnit::kRadPerS;
  EXPECT_THAT(text_of(picture_of(sensor_json("front", "ok"), 1), view), HasSubstr("0.0100 -> 0.000500"));
}

TEST(Screen, PaintsWithColourOrWithout) {
  const Size size{80, 24};
  const auto lines = screen(picture_of(sensor_json("front", "stuck"), 1), {}, size);
  EXPECT_THAT(painted(lines, size, true), HasSubstr("\x1b[0;1;38;5;196m"));
  EXPECT_THAT(painted(lines, size, false), Not(HasSubstr("38;5")));
  EXPECT_THAT(painted(lines, size, false),
              AllOf(::testing::StartsWith("\x1b[H"), ::testing::EndsWith("\x1b[J")));
}

TEST(Line, IsCutAtItsWidthAndHoldsNoCodesOfOthers) {
  Line line;
  line.add("a\x1b[31m").add_left("name", 6).add_right("longer than", 4);
  EXPECT_EQ(line.plain(80), "a?[31mname  long");
  EXPECT_EQ(line.plain(7), "a?[31mn");
  EXPECT_EQ(line.painted(7, true), "\x1b[0ma?[31m\x1b[0mn\x1b[0m");
}

}  // namespace
}  // namespace gyrod::top
