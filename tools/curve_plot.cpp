#include "tools/curve_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "viewer/text_format.h"

namespace lumivec {
namespace {

// Pixels.
constexpr double panel_width = 420.0, panel_height = 320.0;
constexpr double left = 70.0, right = 16.0, top = 34.0, bottom = 52.0;  // margins of a panel
constexpr double legend_height = 40.0;
constexpr double legend_step = 200.0;
// Okabe and Ito's colours, which people tell apart whatever their sight.
constexpr std::array<const char*, 6> colors = {"#000000", "#d55e00", "#0072b2",
                                               "#009e73", "#cc79a7", "#e69f00"};

std::string number(double value) {
  return format_fixed(value, 1);
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text,
                    const std::string& more = "") {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\"" +
         more + ">" + escaped(text) + "</text>\n";
}

std::string line_between(double x0, double y0, double x1, double y1, const std::string& style) {
  return "<line x1=\"" + number(x0) + "\" y1=\"" + number(y0) + "\" x2=\"" + number(x1) +
         "\" y2=\"" + number(y1) + "\" " + style + "/>\n";
}

std::string marker(double x, double y, const std::string& color) {
  return "<circle cx=\"" + number(x) + "\" cy=\"" + number(y) + "\" r=\"3\" fill=\"" + color +
         "\"/>\n";
}

std::string stroke(const std::string& color, double width, const std::string& dashes = "") {
  return "fill=\"none\" stroke=\"" + color + "\" stroke-width=\"" + number(width) + "\"" +
         (dashes.empty() ? "" : " stroke-dasharray=\"" + dashes + "\"");
}

bool is_drawn(const CurvePoint& p) {
  return p.cost > 0.0 && p.error > 0.0 && std::isfinite(p.cost) && std::isfinite(p.error);
}

// A logarithmic axis from a decade, or 2 or 5 of one, to another.
class Axis {
 public:
  Axis(double pixel_begin, double pixel_end) : begin_(pixel_begin), end_(pixel_end) {}

  void include(double value) {
    least_ = std::min(least_, value);
    most_ = std::max(most_, value);
  }
  void settle() {
    if (!(least_ <= most_)) least_ = most_ = 1.0;
    least_ = neighbour(least_, false);
    most_ = neighbour(most_, true);
  }
  double pixel(double value) const {
    return begin_ + (end_ - begin_) * std::log(value / least_) / std::log(most_ / least_);
  }
  std::vector<double> ticks() const {
    constexpr std::size_t many = 9;
    std::vector<double> all, decades;
    for (int exponent = -30; exponent <= 30; ++exponent) {
      for (const double digit : {1.0, 2.0, 5.0}) {
        const double value = digit * std::pow(10.0, exponent);
        if (value < least_ * 0.999 || value > most_ * 1.001) continue;
        all.push_back(value);
        if (digit == 1.0) decades.push_back(value);
      }
    }
    return all.size() > many ? decades : all;
  }

 private:
  // The next of 1, 2 and 5 times a power of ten, strictly above or below.
  static double neighbour(double value, bool above) {
    double best = above ? std::numeric_limits<double>::max() : 0.0;
    const int exponent = static_cast<int>(std::floor(std::log10(value)));
    for (int e = exponent - 1; e <= exponent + 1; ++e) {
      for (const double digit : {1.0, 2.0, 5.0}) {
        const double v = digit * std::pow(10.0, e);
        if (above && v > value * 1.001) best = std::min(best, v);
        if (!above && v < value * 0.999) best = std::max(best, v);
      }
    }
    return best;
  }

  double begin_, end_;
  double least_ = std::numeric_limits<double>::infinity();
  double most_ = -std::numeric_limits<double>::infinity();
};

std::string panel_svg(const PlotPanel& panel, double x0, double y0,
                      const std::vector<std::string>& names) {
  const double inner_left = x0 + left, inner_right = x0 + panel_width - right;
  const double inner_top = y0 + top, inner_bottom = y0 + panel_height - bottom;
  Axis x(inner_left, inner_right), y(inner_bottom, inner_top);
  for (const PlotLine& line : panel.lines) {
    for (const CurvePoint& p : line.points) {
      if (!is_drawn(p)) continue;
      x.include(p.cost);
      y.include(p.error);
    }
  }
  for (const double level : {panel.target, panel.noise}) {
    if (level > 0.0) y.include(level);
  }
  x.settle();
  y.settle();

  const std::string center = number(0.5 * (inner_top + inner_bottom));
  std::string svg =
      text_at(0.5 * (inner_left + inner_right), y0 + 20.0, "middle", panel.title,
              " font-weight=\"bold\"") +
      text_at(0.5 * (inner_left + inner_right), inner_bottom + 38.0, "middle", panel.x_label) +
      text_at(x0 + 16.0, 0.5 * (inner_top + inner_bottom), "middle", panel.y_label,
              " transform=\"rotate(-90 " + number(x0 + 16.0) + " " + center + ")\"");
  for (const double tick : x.ticks()) {
    svg += line_between(x.pixel(tick), inner_top, x.pixel(tick), inner_bottom, stroke("#ddd", 1.0));
    svg += text_at(x.pixel(tick), inner_bottom + 16.0, "middle", format_number(tick));
  }
  for (const double tick : y.ticks()) {
    svg += line_between(inner_left, y.pixel(tick), inner_right, y.pixel(tick), stroke("#ddd", 1.0));
    svg += text_at(inner_left - 6.0, y.pixel(tick) + 4.0, "end", format_number(tick));
  }
  svg += "<rect x=\"" + number(inner_left) + "\" y=\"" + number(inner_top) + "\" width=\"" +
         number(inner_right - inner_left) + "\" height=\"" + number(inner_bottom - inner_top) +
         "\" " + stroke("#444", 1.0) + "/>\n";
  // Names at opposite ends, since levels may be close to each other.
  const auto level = [&](double value, const std::string& dashes, const std::string& name,
                         double x_of_name, const std::string& anchor) {
    if (!(value > 0.0)) return;
    svg += line_between(inner_left, y.pixel(value), inner_right, y.pixel(value),
                        stroke("#777", 1.0, dashes));
    svg += text_at(x_of_name, y.pixel(value) - 4.0, anchor, name, " fill=\"#777\"");
  };
  level(panel.target, "6 4", "target", inner_left + 4.0, "start");
  level(panel.noise, "1 3", "noise of the reference", inner_right - 4.0, "end");
  for (const PlotLine& line : panel.lines) {
    const auto name = std::find(names.begin(), names.end(), line.name) - names.begin();
    const std::string color = colors[static_cast<std::size_t>(name) % colors.size()];
    std::string points, markers;
    for (const CurvePoint& p : line.points) {
      if (!is_drawn(p)) continue;
      points += number(x.pixel(p.cost)) + "," + number(y.pixel(p.error)) + " ";
      markers += marker(x.pixel(p.cost), y.pixel(p.error), color);
    }
    svg += "<polyline points=\"" + points + "\" " + stroke(color, 2.0) + "/>\n" + markers;
  }
  return svg;
}

}  // namespace

std::string plot_svg(const std::vector<PlotPanel>& panels, int columns) {
  std::vector<std::string> names;
  for (const PlotPanel& panel : panels) {
    for (const PlotLine& line : panel.lines) {
      if (std::find(names.begin(), names.end(), line.name) == names.end()) {
        names.push_back(line.name);
      }
    }
  }
  const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
  const double width = std::max(columns * panel_width, left + legend_step * double(names.size()));
  const double height = rows * panel_height + legend_height;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(width) +
                    "\" height=\"" + number(height) + "\" viewBox=\"0 0 " + number(width) + " " +
                    number(height) + "\" font-family=\"sans-serif\" font-size=\"12\">\n" +
                    "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const int place = static_cast<int>(i);
    svg +=
        panel_svg(panels[i], place % columns * panel_width, place / columns * panel_height, names);
  }
  const double y = rows * panel_height + 0.5 * legend_height;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double x = left + legend_step * double(i);
    const std::string color = colors[i % colors.size()];
    svg += line_between(x, y, x + 24.0, y, stroke(color, 2.0)) + marker(x + 12.0, y, color) +
           text_at(x + 30.0, y + 4.0, "start", names[i]);
  }
  return svg + "</svg>\n";
}

}  // namespace lumivec
