#include "app/allan_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "app/allan_units.hpp"

namespace gyrod::app {
namespace {

using Channels = std::vector<const AllanChannel*>;

// Pixels.
constexpr double kWidth = 900.0;
constexpr double kPanelHeight = 600.0;
constexpr double kLeft = 84.0;
constexpr double kRight = 24.0;
constexpr double kTop = 118.0;
constexpr double kBottom = 58.0;

/// Colours of Okabe and Ito, which colour-blind people can tell apart, lighter in the dark.
constexpr const char* kStyle = R"(<style>
svg{background:#fff;max-width:100%;height:auto;font:14px system-ui,sans-serif}
text{fill:#222}.quiet{fill:#555}.title{font-size:17px;font-weight:600}
.frame{fill:none;stroke:#888}.decade{stroke:#ccc}.minor{stroke:#eee}
.x{--c:#0072b2}.y{--c:#d55e00}.z{--c:#009e73}
.curve{fill:none;stroke:var(--c);stroke-width:2}.fit{fill:none;stroke:var(--c);stroke-width:1.5;stroke-dasharray:6 5}
.band{fill:var(--c);opacity:.18}.sample{fill:none;stroke-width:1.5;stroke:#666}
@media(prefers-color-scheme:dark){
svg{background:#16181c}text{fill:#eee}.quiet{fill:#aaa}.decade{stroke:#444}.minor{stroke:#26292e}.sample{stroke:#aaa}
.x{--c:#56b4e9}.y{--c:#ff9248}.z{--c:#3fd0a4}}
</style>
)";

/// Whole decades of one axis of the picture, on a stretch of pixels.
struct LogScale {
  int first = 0;
  int last = 1;
  double from = 0.0;  ///< pixel of 10^first
  double to = 1.0;    ///< pixel of 10^last

  void hold(double least, double most) {
    first = static_cast<int>(std::floor(std::log10(least)));
    last = std::max(first + 1, static_cast<int>(std::ceil(std::log10(most))));
  }
  [[nodiscard]] double operator()(double value) const {
    return from + (to - from) * (std::log10(value) - first) / (last - first);
  }
};

/// One panel: scales, and the unit of its deviation.
struct Panel {
  LogScale tau;
  LogScale deviation;
  DeviationUnit unit;
  double top = 0.0;  ///< of the whole panel

  /// "x,y" of a point; nothing for what has no logarithm.
  [[nodiscard]] std::string at(double tau_s, double deviation_si) const {
    if (!(deviation_si > 0.0)) return "";
    return fmt::format("{:.1f},{:.1f} ", tau(tau_s), deviation(deviation_si / unit.si));
  }
};

Panel panel_for(const Channels& channels, const DeviationUnit& unit, double top) {
  Panel panel;
  panel.unit = unit;
  panel.top = top;
  panel.tau.from = kLeft;
  panel.tau.to = kWidth - kRight;
  panel.deviation.from = top + kPanelHeight - kBottom;
  panel.deviation.to = top + kTop;
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (const AllanChannel* channel : channels) {
    for (const core::AllanPoint& point : channel->points) {
      if (!(point.deviation > 0.0)) continue;
      least = std::min(least, point.lower / unit.si);
      most = std::max(most, point.upper / unit.si);
    }
  }
  const auto& points = channels.front()->points;
  panel.tau.hold(points.front().tau_s, points.back().tau_s);
  if (most > 0.0) panel.deviation.hold(least, most);
  return panel;
}

std::string power_of_ten(int exponent) {
  return fmt::format("10<tspan dy=\"-7\" font-size=\"10\">{}</tspan>", exponent);
}

std::string grid_line(const char* kind, double x1, double y1, double x2, double y2) {
  return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", kind,
                     x1, y1, x2, y2);
}

std::string vertical_grid(const Panel& panel) {
  std::string svg;
  for (int decade = panel.tau.first; decade <= panel.tau.last; ++decade) {
    for (int digit = 1; digit <= 9 && (digit == 1 || decade < panel.tau.last); ++digit) {
      const double x = panel.tau(digit * std::pow(10.0, decade));
      svg += grid_line(digit == 1 ? "decade" : "minor", x, panel.deviation.from, x, panel.deviation.to);
    }
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                       panel.tau(std::pow(10.0, decade)), panel.deviation.from + 22.0, power_of_ten(decade));
  }
  return svg;
}

std::string horizontal_grid(const Panel& panel) {
  std::string svg;
  for (int decade = panel.deviation.first; decade <= panel.deviation.last; ++decade) {
    for (int digit = 1; digit <= 9 && (digit == 1 || decade < panel.deviation.last); ++digit) {
      const double y = panel.deviation(digit * std::pow(10.0, decade));
      svg += grid_line(digit == 1 ? "decade" : "minor", panel.tau.from, y, panel.tau.to, y);
    }
    svg +=
        fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", panel.tau.from - 8.0,
                    panel.deviation(std::pow(10.0, decade)) + 5.0, power_of_ten(decade));
  }
  return svg;
}

std::string frame(const Panel& panel) {
  const double middle_y = 0.5 * (panel.deviation.from + panel.deviation.to);
  return fmt::format("<rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
                     panel.tau.from, panel.deviation.to, panel.tau.to - panel.tau.from,
                     panel.deviation.from - panel.deviation.to) +
         fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">cluster time tau, s</text>\n",
                     0.5 * (panel.tau.from + panel.tau.to), panel.deviation.from + 46.0) +
         fmt::format(
             "<text transform=\"translate(24 {:.1f}) rotate(-90)\" text-anchor=\"middle\">Allan deviation, "
             "{}</text>\n",
             middle_y, panel.unit.title);
}

std::string curves(const Panel& panel, const AllanChannel& channel) {
  std::string curve;
  std::string band;
  std::string back;
  std::string fit;
  for (const core::AllanPoint& point : channel.points) {
    curve += panel.at(point.tau_s, point.deviation);
    band += panel.at(point.tau_s, point.upper);
    back.insert(0, panel.at(point.tau_s, point.lower));
    const double model = core::model_deviation(channel.fit, point.tau_s);
    const bool inside = model / panel.unit.si >= std::pow(10.0, panel.deviation.first) &&
                        model / panel.unit.si <= std::pow(10.0, panel.deviation.last);
    if (inside) fit += panel.at(point.tau_s, model);
  }
  return fmt::format(
      "<g class=\"{}\"><polygon class=\"band\" points=\"{}{}\"/><polyline class=\"fit\" "
      "points=\"{}\"/><polyline "
      "class=\"curve\" points=\"{}\"/></g>\n",
      channel.axis, band, back, fit, curve);
}

/// "x   N 2.38 deg/sqrt(h)   B 32.1 deg/h": what the fit found.
std::string findings(const AllanChannel& channel) {
  std::string text;
  for (const CoefficientUnit& unit : coefficient_units(channel.sensor)) {
    const core::Coefficient& coefficient = channel.fit[unit.term];
    if (!coefficient.observable) continue;
    text += fmt::format("{}{} {:.3g} {}", text.empty() ? "" : ",  ", unit.letter,
                        in_sheet_unit(channel.sensor, unit.term, coefficient.value), unit.sheet);
  }
  return text.empty() ? "no coefficient observable" : text;
}

std::string legend(const Panel& panel, const Channels& channels, double confidence) {
  std::string svg;
  double y = panel.top + 54.0;
  for (const AllanChannel* channel : channels) {
    svg += fmt::format(
        "<g class=\"{0}\"><line class=\"curve\" x1=\"{1}\" y1=\"{2}\" x2=\"{3}\" y2=\"{2}\"/></g>\n",
        channel->axis, kLeft, y - 5.0, kLeft + 30.0);
    svg +=
        fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n<text class=\"quiet\" x=\"{}\" y=\"{}\">{}</text>\n",
                    kLeft + 40.0, y, channel->axis, kLeft + 60.0, y, findings(*channel));
    y += 21.0;
  }
  const double right = kWidth - kRight;
  y = panel.top + 54.0;
  svg += fmt::format(
      "<line class=\"sample\" x1=\"{0}\" y1=\"{1}\" x2=\"{2}\" y2=\"{1}\" stroke-dasharray=\"6 5\"/>\n",
      right - 190.0, y - 5.0, right - 160.0);
  svg += fmt::format("<text class=\"quiet\" x=\"{}\" y=\"{}\">fitted model</text>\n", right - 150.0, y);
  svg += fmt::format("<text class=\"quiet\" x=\"{}\" y=\"{}\">band: {:.4g} % confidence</text>\n",
                     right - 190.0, y + 21.0, 100.0 * confidence);
  return svg;
}

/// Text that may stand in XML.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<') {
      result += "&lt;";
    } else if (c == '&') {
      result += "&amp;";
    } else {
      result += c;
    }
  }
  return result;
}

/// The file's name without its folders, and its beginning where it is long.
std::string short_name(const std::string& path) {
  constexpr std::size_t kMost = 44;
  const std::string name = path.substr(path.find_last_of('/') + 1);
  return name.size() <= kMost ? name : name.substr(0, kMost - 3) + "...";
}

std::string panel_svg(const AllanAnalysis& analysis, const Channels& channels, const DeviationUnit& unit,
                      double top) {
  const Panel panel = panel_for(channels, unit, top);
  const bool gyro = channels.front()->sensor == SensorKind::kGyro;
  std::string svg = fmt::format(
      "<text class=\"title\" x=\"{}\" y=\"{}\">{}</text>\n", kLeft, top + 28.0,
      escaped(fmt::format("{}, {}: {} samples at {:.4g} Hz", gyro ? "Gyro" : "Accelerometer",
                          short_name(analysis.input), analysis.samples, analysis.sample_rate_hz)));
  svg += legend(panel, channels, analysis.options.confidence);
  svg += vertical_grid(panel) + horizontal_grid(panel) + frame(panel);
  for (const AllanChannel* channel : channels) svg += curves(panel, *channel);
  return svg;
}

}  // namespace

std::string allan_svg(const AllanAnalysis& analysis, files::RateUnit unit) {
  std::string panels;
  double height = 0.0;
  for (const SensorKind sensor : {SensorKind::kGyro, SensorKind::kAccelerometer}) {
    Channels channels;
    for (const AllanChannel& channel : analysis.channels) {
      if (channel.sensor == sensor) channels.push_back(&channel);
    }
    if (channels.empty()) continue;
    panels += panel_svg(analysis, channels, deviation_unit(sensor, unit), height);
    height += kPanelHeight;
  }
  return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\">\n",
                     kWidth, height) +
         kStyle + panels + "</svg>\n";
}

}  // namespace gyrod::app
