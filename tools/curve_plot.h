// Curves of error against cost as a drawing (SVG), on logarithmic axes.
#pragma once

#include <string>
#include <vector>

#include "tools/error_curve.h"

namespace lumivec {

struct PlotLine {
  std::string name;
  std::vector<CurvePoint> points;  // those that are not above 0 are left out
};

struct PlotPanel {
  std::string title, x_label, y_label;
  std::vector<PlotLine> lines;
  double target = 0.0;  // a dashed level; 0: none
  double noise = 0.0;   // a dotted level; 0: none
};

// Panels in rows of so many columns, one legend below them. Lines of one name look alike in all
// panels.
std::string plot_svg(const std::vector<PlotPanel>& panels, int columns);

}  // namespace lumivec
