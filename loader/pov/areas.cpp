#include "loader/pov/areas.h"

#include <algorithm>
#include <cmath>

namespace lumivec::pov {
namespace {

struct Edge {
  Point2 low;  // the end of smaller y
  Point2 high;
  double at(double y) const {
    return low[0] + (high[0] - low[0]) * (y - low[1]) / (high[1] - low[1]);
  }
};

std::vector<Edge> edges_of(const std::vector<Outline>& outlines) {
  std::vector<Edge> edges;
  for (const Outline& outline : outlines) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      Edge edge{outline[i], outline[(i + 1) % outline.size()]};
      if (edge.low[1] > edge.high[1]) std::swap(edge.low, edge.high);
      if (edge.low[1] < edge.high[1]) edges.push_back(edge);
    }
  }
  return edges;
}

// Where edges begin, end or cross: between these heights they keep their order.
std::vector<double> heights_of(const std::vector<Edge>& edges) {
  std::vector<double> heights;
  for (const Edge& edge : edges) {
    heights.push_back(edge.low[1]);
    heights.push_back(edge.high[1]);
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      const double low = std::max(edges[i].low[1], edges[j].low[1]);
      const double high = std::min(edges[i].high[1], edges[j].high[1]);
      if (!(low < high)) continue;
      const double before = edges[i].at(low) - edges[j].at(low);
      const double after = edges[i].at(high) - edges[j].at(high);
      if (before * after < 0.0) heights.push_back(low + (high - low) * before / (before - after));
    }
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  return heights;
}

}  // namespace

std::vector<AreaTriangle> fill_area(const std::vector<Outline>& outlines) {
  std::vector<AreaTriangle> triangles;
  const std::vector<Edge> edges = edges_of(outlines);
  const std::vector<double> heights = heights_of(edges);
  std::vector<const Edge*> crossing;
  for (std::size_t h = 0; h + 1 < heights.size(); ++h) {
    const double low = heights[h], high = heights[h + 1], middle = 0.5 * (low + high);
    crossing.clear();
    for (const Edge& edge : edges) {
      if (edge.low[1] < middle && edge.high[1] > middle) crossing.push_back(&edge);
    }
    std::sort(crossing.begin(), crossing.end(),
              [&](const Edge* a, const Edge* b) { return a->at(middle) < b->at(middle); });
    for (std::size_t i = 0; i + 1 < crossing.size(); i += 2) {
      const Point2 a{crossing[i]->at(low), low}, b{crossing[i + 1]->at(low), low};
      const Point2 c{crossing[i + 1]->at(high), high}, d{crossing[i]->at(high), high};
      if (b[0] > a[0]) triangles.push_back({a, b, c});
      if (c[0] > d[0]) triangles.push_back({a, c, d});
    }
  }
  return triangles;
}

}  // namespace lumivec::pov
