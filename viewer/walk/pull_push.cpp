#include "viewer/walk/pull_push.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "viewer/rows.h"

namespace lumivec {
namespace {

// What another surface counts beside the same one: enough where there is nothing else.
constexpr float other_surface = 1e-4f;

struct Surface {
  std::int32_t object = -1;
  std::uint32_t normal = 0;  // packed

  bool same_as(const Surface& other) const {
    return object == other.object &&
           (normal == other.normal || normals_alike(normal, other.normal));
  }
};

struct Cell {
  Color mean{0.0f};     // of what is known
  float weight = 0.0f;  // [0, 1]: how much is known
  Surface surface;      // that the mean is of
  bool sure = false;    // all of the mean is of that surface
};

struct Level {
  int width = 0, height = 0;
  std::vector<Cell> cells;

  Level(int w, int h) : width(w), height(h), cells(std::size_t(w) * std::size_t(h)) {}

  const Cell& at(int x, int y) const {
    return cells[static_cast<std::size_t>(std::clamp(y, 0, height - 1)) *
                     static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(std::clamp(x, 0, width - 1))];
  }
};

// cell_at(x, y): of the finer picture.
template <typename CellAt>
Level half_of(int width, int height, const CellAt& cell_at) {
  Level coarse((width + 1) / 2, (height + 1) / 2);
  for_each_row(coarse.height, [&](int y) {
    for (int x = 0; x < coarse.width; ++x) {
      std::array<Cell, 4> fine;
      std::size_t count = 0, most = 0;
      for (int fy = 2 * y; fy < std::min(2 * y + 2, height); ++fy) {
        for (int fx = 2 * x; fx < std::min(2 * x + 2, width); ++fx) {
          fine[count] = cell_at(fx, fy);
          if (fine[count].weight > fine[most].weight) most = count;
          ++count;
        }
      }
      Cell& cell = coarse.cells[std::size_t(y) * std::size_t(coarse.width) + std::size_t(x)];
      cell.surface = fine[most].surface;
      float weight = 0.0f;
      for (std::size_t i = 0; i < count; ++i) {
        if (!(fine[i].weight > 0.0f) || !fine[i].surface.same_as(cell.surface)) continue;
        cell.mean += fine[i].mean * fine[i].weight;
        weight += fine[i].weight;
      }
      if (weight > 0.0f) cell.mean *= 1.0f / weight;
      cell.weight = std::min(1.0f, weight);
      cell.sure = weight > 0.0f;
    }
  });
  return coarse;
}

struct Filling {
  Color mean{0.0f};
  bool sure = false;
};

// Between the four cells of the coarse level around the middle of cell (x, y) of the finer one, by
// what is sure to be of the surface alone or by everything.
Filling between(const Level& coarse, int x, int y, const Surface& surface, bool sure) {
  constexpr float near = 0.75f, far = 0.25f;
  const int cx = x / 2, cy = y / 2, dx = x % 2 == 0 ? -1 : 1, dy = y % 2 == 0 ? -1 : 1;
  Color sum(0.0f);
  float total = 0.0f;
  for (int k = 0; k < 4; ++k) {
    const bool right = (k & 1) != 0, down = (k >> 1) != 0;
    const Cell& cell = coarse.at(right ? cx + dx : cx, down ? cy + dy : cy);
    const bool same = cell.surface.same_as(surface) && (cell.sure || !sure);
    if (sure && !same) continue;
    const float w =
        (right ? far : near) * (down ? far : near) * (same ? 1.0f : other_surface) * cell.weight;
    sum += cell.mean * w;
    total += w;
  }
  return {total > 0.0f ? sum * (1.0f / total) : Color(0.0f), sure && total > 0.0f};
}

// For cell (x, y) of the level below `coarse`, from the finest level that knows something of its
// surface: beside a lamp, all cells nearby may be the lamp's.
Filling fill(const std::vector<Level>& levels, std::size_t coarse, int x, int y,
             const Surface& surface) {
  for (std::size_t l = coarse; l < levels.size(); ++l) {
    const auto up = static_cast<int>(l - coarse);
    const Filling found = between(levels[l], x >> up, y >> up, surface, true);
    if (found.sure) return found;
  }
  return between(levels[coarse], x, y, surface, false);
}

}  // namespace

void pull_push(int width, int height, const std::vector<std::uint8_t>& known,
               const VisibleSurfaces& seen, std::vector<Color>& pixels) {
  const auto surface_of = [&](std::size_t i) { return Surface{seen.object[i], seen.normal[i]}; };
  std::vector<Level> levels;
  levels.push_back(half_of(width, height, [&](int x, int y) {
    const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
    return Cell{pixels[i], known[i] != 0 ? 1.0f : 0.0f, surface_of(i)};
  }));
  while (levels.back().width > 1 || levels.back().height > 1) {
    const Level& fine = levels.back();
    levels.push_back(half_of(fine.width, fine.height, [&](int x, int y) { return fine.at(x, y); }));
  }
  // The coarsest level knows if anything is known.
  for (std::size_t l = levels.size() - 1; l-- > 0;) {
    Level& fine = levels[l];
    for_each_row(fine.height, [&](int y) {
      for (int x = 0; x < fine.width; ++x) {
        Cell& cell = fine.cells[std::size_t(y) * std::size_t(fine.width) + std::size_t(x)];
        if (cell.weight >= 1.0f) continue;
        const Filling rest = fill(levels, l + 1, x, y, cell.surface);
        cell.sure = rest.sure && (cell.sure || !(cell.weight > 0.0f));
        cell.mean = cell.mean * cell.weight + rest.mean * (1.0f - cell.weight);
        cell.weight = 1.0f;
      }
    });
  }
  for_each_row(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
      if (known[i] == 0) pixels[i] = fill(levels, 0, x, y, surface_of(i)).mean;
    }
  });
}

}  // namespace lumivec
