#include "top/screen.hpp"

#include <algorithm>
#include <array>

#include "stream/health.hpp"

namespace gyrod::top {
namespace {

constexpr std::size_t kHeaderLines = 4;  // with the names of the columns
constexpr std::size_t kDetailLines = 5;  // a rule, three axes, one more fact
constexpr std::size_t kFooterLines = 1;
constexpr std::size_t kRowsForDetails = 16;
constexpr std::size_t kRowsForEvents = 28;

constexpr Look kBold{Weight::kBold};
constexpr Look kFaint{Weight::kFaint};

Look look_in(std::string_view health) { return {Weight::kBold, look_of(health).colour}; }

bool has_details(Size size) noexcept { return size.rows >= kRowsForDetails; }

std::size_t event_lines(Size size) noexcept { return size.rows >= kRowsForEvents ? kEventsShown : 0; }

Line title(const Picture& picture) {
  Line line;
  line.add("gyrod", kBold);
  if (!picture.status) return line.add(" at " + picture.url);
  const Status& status = *picture.status;
  line.add(" " + status.version + " at " + picture.url + "  up " + age(status.uptime_s) + "  ");
  if (status.ready) return line.add("ready", look_in("ok"));
  return line.add("not ready: " + status.ready_reason, look_in("stuck"));
}

std::string step_words(std::uint64_t step) {
  if (step == 0) return "";
  return step == 1 ? "  overload: hop widened" : "  overload: samples pass through undenoised";
}

Line own_health(const Status& status) {
  Line line;
  line.add("samples " + per_second(status.samples_per_s) + "  windows " + per_second(status.windows_per_s) +
           "  added latency p99 " + duration(status.latency_p99_s) + "  workers " +
           std::to_string(status.workers_busy) + "/" + std::to_string(status.workers) + " busy  queue " +
           std::to_string(status.queued_windows));
  return line;
}

/// "gyros 12: 1 silent, 11 ok", the worst first.
Line health_counts(const Status& status) {
  Line line;
  line.add("gyros " + std::to_string(status.open));
  const char* between = ": ";
  for (std::size_t n = stream::kHealthStates; n-- > 0;) {
    const std::string name(stream::name_of(static_cast<stream::Health>(n)));
    const auto found = status.by_health.find(name);
    if (found == status.by_health.end() || found->second == 0) continue;
    line.add(between).add(std::to_string(found->second) + " " + name, look_in(name));
    between = ", ";
  }
  return line.add(step_words(status.overload_step), look_in("degraded"));
}

/// Names of columns and their widths; the sensor's name takes what is left.
constexpr std::size_t kFixedColumns = 64;
constexpr std::size_t kNarrowestName = 12;
constexpr std::size_t kWidestName = 40;

std::size_t name_width(Size size) noexcept {
  const std::size_t left = size.columns > kFixedColumns ? size.columns - kFixedColumns : 0;
  return std::clamp(left, kNarrowestName, kWidestName);
}

Line column_names(const View& view, Size size) {
  const std::string unit = " " + std::string(name_of(view.unit));
  Line line;
  line.add_left("  gyro", name_width(size) + 2)
      .add_left("health", 11)
      .add_right("rate Hz", 9)
      .add_right("noise" + unit + " ->", 15)
      .add_right("out", 9)
      .add_right("reduced", 9)
      .add_right("lost %", 8)
      .add(std::string(size.columns, ' '));
  line.set_look({Weight::kInverse});
  return line;
}

Line sensor_line(const Sensor& sensor, const View& view, Size size, bool chosen) {
  constexpr double kPercent = 100.0;
  const Axis* axis = sensor.loudest();
  const Axis known = axis == nullptr ? Axis{} : *axis;
  const Figure lost = sensor.lost_share();
  Line line;
  line.add(std::string(1, look_of(sensor.health).letter), look_in(sensor.health));
  line.add(" ")
      .add_left(sensor.name, name_width(size), chosen ? kBold : Look{})
      .add_left(sensor.health, 11, look_in(sensor.health))
      .add_right(fixed(sensor.sample_rate_hz, 1), 9)
      .add_right(significant(in_unit(known.noise_in_radps, view.unit)), 12)
      .add(" ->")
      .add_right(significant(in_unit(known.noise_out_radps, view.unit)), 9)
      .add_right(known.reduction_db ? fixed(known.reduction_db, 1) + " dB" : "-", 9)
      .add_right(fixed(lost ? Figure(kPercent * *lost) : lost, 2), 8);
  if (chosen) line.add(" ").set_look({Weight::kInverse});
  return line;
}

Line axis_line(char name, const Axis& axis, RateUnit unit) {
  Line line;
  line.add(std::string("  ") + name + "  ")
      .add_left(axis.health, 11, look_in(axis.health))
      .add_right(significant(in_unit(axis.noise_in_radps, unit)), 9)
      .add(" -> ")
      .add_left(significant(in_unit(axis.noise_out_radps, unit)), 9)
      .add(std::string(name_of(unit)) + "  ")
      .add(axis.reduction_db ? fixed(axis.reduction_db, 1) + " dB" : "-");
  return line;
}

std::vector<Line> details(const Sensor& sensor, const View& view) {
  std::vector<Line> lines(1);
  const std::string rest = !sensor.at_rest ? "" : *sensor.at_rest ? ", at rest" : ", in motion";
  lines.back().add(sensor.name, kBold).add(rest + ", noise known from " + sensor.noise_source);
  constexpr std::string_view kNames = "xyz";
  for (std::size_t n = 0; n < std::min(sensor.axes.size(), kNames.size()); ++n)
    lines.push_back(axis_line(kNames[n], sensor.axes[n], view.unit));
  lines.emplace_back().add("  " + std::to_string(sensor.received) + " received, " +
                           std::to_string(sensor.published) + " published, " +
                           std::to_string(sensor.rejected) + " refused, " + std::to_string(sensor.missing) +
                           " missing" + step_words(sensor.overload_step));
  return lines;
}

/// What to do where there is no sensor to show.
std::vector<Line> nothing_to_show(const Picture& picture, const View& view) {
  std::vector<Line> lines(1);
  const Status& status = *picture.status;
  if (status.open > 0) {
    lines.emplace_back().add(view.search.empty() ? "  No gyro is in these states: t shows all."
                                                 : "  No gyro matches the search: Esc shows all.");
    return lines;
  }
  std::string topics;
  for (const std::string& topic : status.input_topics) topics += (topics.empty() ? "" : ", ") + topic;
  lines.emplace_back().add("  No gyro has sent anything yet; " + std::to_string(status.matched_writers) +
                           " writers are matched.");
  if (!topics.empty()) lines.emplace_back().add("  gyrod listens on " + topics);
  if (!status.simulate_hint.empty())
    lines.emplace_back().add("  A simulated one: ").add(status.simulate_hint, kBold);
  return lines;
}

Line footer(const Picture& picture, const View& view) {
  Line line;
  if (view.typing) return line.add("search: " + view.search + "_   Enter keeps it, Esc clears it", kBold);
  if (!picture.trouble.empty()) return line.add(picture.trouble, look_in("stuck"));
  line.add("q quit  / search  s sort: " + view.sort + "  t " +
               (view.health.empty() ? "troubled only" : "all states") + "  u unit  arrows choose",
           kFaint);
  if (!view.search.empty()) line.add("  search: " + view.search, kBold);
  if (picture.page)
    line.add("  " + std::to_string(picture.page->matching) + " of " + std::to_string(picture.page->total),
             kFaint);
  return line;
}

void append(std::vector<Line>& lines, std::vector<Line> more) {
  std::ranges::move(more, std::back_inserter(lines));
}

const Sensor* chosen_of(const SensorPage& page, const View& view) {
  if (view.chosen < page.offset || view.chosen - page.offset >= page.sensors.size()) return nullptr;
  return &page.sensors[view.chosen - page.offset];
}

void add_sensors(std::vector<Line>& lines, const SensorPage& page, const View& view, Size size) {
  const std::uint64_t end = std::min<std::uint64_t>(page.sensors.size(), sensor_rows(size));
  for (std::uint64_t n = 0; n < end; ++n)
    lines.push_back(sensor_line(page.sensors[n], view, size, page.offset + n == view.chosen));
  const Sensor* chosen = chosen_of(page, view);
  if (chosen == nullptr || !has_details(size)) return;
  lines.resize(size.rows - kFooterLines - event_lines(size) - kDetailLines);
  append(lines, details(*chosen, view));
}

}  // namespace

std::uint64_t sensor_rows(Size size) noexcept {
  const std::size_t taken =
      kHeaderLines + kFooterLines + event_lines(size) + (has_details(size) ? kDetailLines : 0);
  return size.rows > taken ? size.rows - taken : 1;
}

std::vector<Line> screen(const Picture& picture, const View& view, Size size) {
  std::vector<Line> lines{title(picture)};
  if (picture.status) {
    lines.push_back(own_health(*picture.status));
    lines.push_back(health_counts(*picture.status));
    lines.push_back(column_names(view, size));
    if (picture.page && !picture.page->sensors.empty())
      add_sensors(lines, *picture.page, view, size);
    else if (picture.page)
      append(lines, nothing_to_show(picture, view));
  }
  const std::size_t shown = std::min(event_lines(size), picture.events.size());
  lines.resize(size.rows > kFooterLines + shown ? size.rows - kFooterLines - shown : 0);
  for (std::size_t n = picture.events.size() - shown; n < picture.events.size(); ++n)
    lines.emplace_back().add(clock(picture.events[n].time_s) + "  " + picture.events[n].text, kFaint);
  lines.push_back(footer(picture, view));
  return lines;
}

std::string painted(const std::vector<Line>& lines, Size size, bool coloured) {
  std::string bytes = "\x1b[H";
  for (std::size_t n = 0; n < lines.size(); ++n)
    bytes += (n == 0 ? "" : "\r\n") + lines[n].painted(size.columns, coloured) + "\x1b[K";
  return bytes + "\x1b[J";
}

}  // namespace gyrod::top
