#include "viewer/walk/visibility.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>

#include "viewer/rows.h"

namespace lumivec {
namespace {

constexpr int cell = 4;  // pixels between those that are traced anyway
// Normals of a smooth surface differ by less than three degrees between these, and the points lie
// in one another's tangent planes up to this many pixels.
constexpr float smooth_cosine = 0.9986f;
constexpr float most_off_plane = 0.5f;
// Of projected points: one that is this share deeper than the mean of those around it is behind
// them, and one of another depth than that which a ray finds is another one.
constexpr float most_depth_share = 0.1f;
// Background among so many of eight neighbours is seen through a surface.
constexpr int most_surfaces_around = 5;

// Packed normals are only nearly of the same length.
bool nearly_parallel(std::uint32_t a, std::uint32_t b) {
  if (a == b) return true;
  const V3f u = unpack_normal(a), v = unpack_normal(b);
  const float cosine = u.dot(v);
  return cosine > 0.0f &&
         cosine * cosine >= smooth_cosine * smooth_cosine * u.length2() * v.length2();
}

}  // namespace

Visibility::Visibility(int width, int height)
    : width_(width), height_(height), state_(std::size_t(width) * std::size_t(height)) {
  for (VisibleSurfaces* s : {&now_, &last_}) {
    s->resize(state_.size());
    std::fill(s->object.begin(), s->object.end(), -1);
  }
}

void Visibility::see_all(LiveTracer& tracer) {
  std::swap(now_, last_);
  tracer.see(now_);
  std::fill(state_.begin(), state_.end(), std::uint8_t{traced});
  ray_count_ = state_.size();
}

void Visibility::see_next(LiveTracer& tracer) {
  std::swap(now_, last_);
  ray_count_ = 0;
  std::fill(state_.begin(), state_.end(), std::uint8_t{unknown});
  constexpr unsigned stride = 7;  // odd: all places of a cell have their turn
  phase_ = (phase_ + stride) % unsigned{cell * cell};
  std::vector<std::uint32_t> pixels;
  mark_edges(tracer);
  choose_cells(pixels);
  trace(tracer, pixels);
  fill_cells(tracer, pixels);
  trace(tracer, pixels);
}

void Visibility::see_again(LiveTracer& tracer, std::vector<std::uint32_t>& others) {
  std::vector<std::uint32_t> pixels;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    if (guessed(i)) pixels.push_back(static_cast<std::uint32_t>(i));
  }
  verify(tracer, pixels, others);
}

void Visibility::verify(LiveTracer& tracer, const std::vector<std::uint32_t>& pixels,
                        std::vector<std::uint32_t>& others) {
  struct Surface {
    float depth;
    std::uint32_t normal;
    std::int32_t object;
  };
  std::vector<std::uint32_t> untraced;
  std::vector<Surface> before;
  for (const std::uint32_t i : pixels) {
    if (state_[i] == traced) continue;
    untraced.push_back(i);
    before.push_back({now_.depth[i], now_.normal[i], now_.object[i]});
  }
  settle(tracer, untraced);
  others.clear();
  for (std::size_t k = 0; k < untraced.size(); ++k) {
    const std::uint32_t i = untraced[k];
    const Surface& b = before[k];
    const bool same =
        now_.object[i] == b.object &&
        (b.object < 0 || (normals_alike(now_.normal[i], b.normal) &&
                          std::abs(now_.depth[i] - b.depth) <= most_depth_share * now_.depth[i]));
    if (!same) others.push_back(i);
  }
}

void Visibility::see_projected(const LiveTracer& tracer) {
  std::swap(now_, last_);
  ray_count_ = 0;
  const PictureRays then = tracer.view(1).rays();
  const PicturePlane plane = tracer.view(0).plane();
  // Depth, and the last view's pixel: the least is the nearest, and the same in whatever order.
  constexpr std::uint64_t empty = ~std::uint64_t{0};
  std::vector<std::uint64_t> nearest(state_.size(), empty);
  constexpr float far_away = 1e12f;  // where background is seen, so that only its direction counts
  for_each_row(height_, [&](int y) {
    for (int x = 0; x < width_; ++x) {
      const std::size_t i = at(x, y);
      if (last_.object[i] == VisibleSurfaces::unknown) continue;
      const bool surface = last_.object[i] >= 0;
      const V3f p = then.point(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f,
                               surface ? last_.depth[i] : far_away) -
                    plane.eye;
      const float depth = p.dot(plane.forward);
      if (!(depth > 0.0f)) continue;
      const float scale = plane.perspective ? 1.0f / depth : 1.0f;
      const float fx = p.dot(plane.x_axis) * scale + plane.center.x,
                  fy = p.dot(plane.y_axis) * scale + plane.center.y;
      if (!(fx >= 0.0f && fy >= 0.0f && fx < static_cast<float>(width_) &&
            fy < static_cast<float>(height_))) {
        continue;
      }
      const float key_depth = surface ? depth : VisibleSurfaces::nothing;
      const std::uint64_t key =
          std::uint64_t{std::bit_cast<std::uint32_t>(key_depth)} << 32 | std::uint64_t{i};
      std::atomic_ref<std::uint64_t> place(nearest[at(static_cast<int>(fx), static_cast<int>(fy))]);
      std::uint64_t there = place.load(std::memory_order_relaxed);
      while (key < there && !place.compare_exchange_weak(there, key, std::memory_order_relaxed)) {
      }
    }
  });
  source_.resize(state_.size());
  for_each_row(height_, [&](int y) {
    for (std::size_t i = at(0, y); i < at(0, y + 1); ++i) {
      const bool found = nearest[i] != empty;
      source_[i] = found ? static_cast<std::uint32_t>(nearest[i]) : no_source;
      state_[i] = interpolated;
      now_.depth[i] = found ? std::bit_cast<float>(static_cast<std::uint32_t>(nearest[i] >> 32))
                            : VisibleSurfaces::nothing;
      now_.normal[i] = found ? last_.normal[source_[i]] : 0;
      now_.object[i] = found ? last_.object[source_[i]] : VisibleSurfaces::unknown;
    }
  });
  cull_hidden();
}

void Visibility::cull_hidden() {
  std::vector<std::vector<std::uint32_t>> rows(static_cast<std::size_t>(height_));
  for_each_row(height_, [&](int y) {
    for (int x = 0; x < width_; ++x) {
      const std::size_t i = at(x, y);
      if (source_[i] == no_source) continue;
      float sum = 0.0f;
      int count = 0;
      for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, height_ - 1); ++ny) {
        for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, width_ - 1); ++nx) {
          if (now_.object[at(nx, ny)] < 0) continue;
          sum += now_.depth[at(nx, ny)];
          ++count;
        }
      }
      const bool hidden = now_.object[i] < 0 ? count >= most_surfaces_around
                                             : now_.depth[i] > (1.0f + most_depth_share) * sum /
                                                                   static_cast<float>(count);
      if (hidden) rows[static_cast<std::size_t>(y)].push_back(static_cast<std::uint32_t>(i));
    }
  });
  std::vector<std::uint32_t> hidden;
  join_lists(rows, hidden);
  for (const std::uint32_t i : hidden) {
    source_[i] = no_source;
    now_.object[i] = VisibleSurfaces::unknown;
    now_.depth[i] = VisibleSurfaces::nothing;
  }
}

void Visibility::settle(LiveTracer& tracer, const std::vector<std::uint32_t>& pixels) {
  for (const std::uint32_t i : pixels) state_[i] = traced;
  trace(tracer, pixels);
}

void Visibility::trace(LiveTracer& tracer, const std::vector<std::uint32_t>& pixels) {
  tracer.see(pixels, now_);
  ray_count_ += pixels.size();
}

// Pixels next to one of another surface, and all around the place where they are now.
void Visibility::mark_edges(const LiveTracer& tracer) {
  const PictureRays then = tracer.view(1).rays();
  const PicturePlane plane = tracer.view(0).plane();
  const auto differ = [&](std::size_t a, std::size_t b) {
    return last_.object[a] != last_.object[b] ||
           (last_.normal[a] != last_.normal[b] && !normals_alike(last_.normal[a], last_.normal[b]));
  };
  for_each_row(height_, [&](int y) {
    for (int x = 0; x < width_; ++x) {
      const std::size_t i = at(x, y);
      if (last_.object[i] < 0) continue;
      const bool edge = (x > 0 && differ(i, i - 1)) || (x + 1 < width_ && differ(i, i + 1)) ||
                        (y > 0 && differ(i, at(x, y - 1))) ||
                        (y + 1 < height_ && differ(i, at(x, y + 1)));
      if (!edge) continue;
      const V3f p =
          then.point(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, last_.depth[i]) -
          plane.eye;
      const float depth = p.dot(plane.forward);
      if (!(depth > 0.0f)) continue;
      const float scale = plane.perspective ? 1.0f / depth : 1.0f;
      const float fx = p.dot(plane.x_axis) * scale + plane.center.x,
                  fy = p.dot(plane.y_axis) * scale + plane.center.y;
      if (!(fx > -1.0f && fy > -1.0f && fx < static_cast<float>(width_) + 1.0f &&
            fy < static_cast<float>(height_) + 1.0f)) {
        continue;
      }
      const int cx = static_cast<int>(std::floor(fx)), cy = static_cast<int>(std::floor(fy));
      for (int ny = std::max(cy - 1, 0); ny <= std::min(cy + 1, height_ - 1); ++ny) {
        for (int nx = std::max(cx - 1, 0); nx <= std::min(cx + 1, width_ - 1); ++nx) {
          std::atomic_ref<std::uint8_t>(state_[at(nx, ny)])
              .store(wanted, std::memory_order_relaxed);
        }
      }
    }
  });
}

// What is marked, the corners of all cells, and the picture's border, which closes those there.
void Visibility::choose_cells(std::vector<std::uint32_t>& pixels) {
  const int px = static_cast<int>(phase_) % cell, py = static_cast<int>(phase_) / cell;
  std::vector<std::vector<std::uint32_t>> rows(static_cast<std::size_t>(height_));
  for_each_row(height_, [&](int y) {
    std::vector<std::uint32_t>& row = rows[static_cast<std::size_t>(y)];
    const bool corner_row = y % cell == py || y == 0 || y == height_ - 1;
    for (int x = 0; x < width_; ++x) {
      const std::size_t i = at(x, y);
      const bool corner = corner_row && (x % cell == px || x == 0 || x == width_ - 1);
      const bool last = x == width_ - 1 || y == height_ - 1;
      if (state_[i] != wanted && !corner && !last) continue;
      state_[i] = traced;
      row.push_back(static_cast<std::uint32_t>(i));
    }
  });
  join_lists(rows, pixels);
}

// Four corners on one smooth surface.
bool Visibility::smooth(const PictureRays& rays, float tolerance_per_depth, float tolerance, int x0,
                        int y0, int x1, int y1) const {
  const std::size_t first = at(x0, y0);
  const std::int32_t object = now_.object[first];
  const std::array<std::size_t, 3> others = {at(x1, y0), at(x0, y1), at(x1, y1)};
  if (object < 0) {
    return std::all_of(others.begin(), others.end(),
                       [&](std::size_t i) { return now_.object[i] < 0; });
  }
  const std::uint32_t normal = now_.normal[first];
  for (const std::size_t i : others) {
    if (now_.object[i] != object || !nearly_parallel(now_.normal[i], normal)) return false;
  }
  const auto point = [&](int x, int y) {
    return rays.point(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f,
                      now_.depth[at(x, y)]);
  };
  const V3f a = point(x0, y0), n = unpack_normal(normal);
  // Half way across, the surface is about a quarter as far off as the corner.
  constexpr float corner_share = 4.0f;
  const float bound =
      corner_share * most_off_plane * (tolerance + tolerance_per_depth * now_.depth[first]);
  return std::abs((point(x1, y0) - a).dot(n)) <= bound &&
         std::abs((point(x0, y1) - a).dot(n)) <= bound &&
         std::abs((point(x1, y1) - a).dot(n)) <= bound;
}

void Visibility::fill_cells(const LiveTracer& tracer, std::vector<std::uint32_t>& pixels) {
  const PictureRays rays = tracer.view(0).rays();
  const bool perspective = tracer.view(0).plane().perspective;
  const float size = tracer.view(0).footprint(0.0f);
  const float size_per_depth = tracer.view(0).footprint(1.0f) - size;
  // Where cells begin along a side; the last entry is where the last one ends.
  const auto borders = [](int length, int phase) {
    std::vector<int> all = {0};
    for (int i = phase; i < length - 1; i += cell) {
      if (i > 0) all.push_back(i);
    }
    if (length > 1) all.push_back(length - 1);
    return all;
  };
  const std::vector<int> columns = borders(width_, static_cast<int>(phase_) % cell),
                         lines = borders(height_, static_cast<int>(phase_) / cell);
  std::vector<std::vector<std::uint32_t>> rows(lines.size());
  for_each_row(static_cast<int>(lines.size()) - 1, [&](int r) {
    const auto line = static_cast<std::size_t>(r);
    std::vector<std::uint32_t>& left_over = rows[line];
    const int y0 = lines[line], y1 = lines[line + 1];
    for (std::size_t c = 0; c + 1 < columns.size(); ++c) {
      const int x0 = columns[c], x1 = columns[c + 1];
      const bool one = smooth(rays, size_per_depth, size, x0, y0, x1, y1);
      const std::size_t corner = at(x0, y0);
      const float d00 = now_.depth[corner], d10 = now_.depth[at(x1, y0)],
                  d01 = now_.depth[at(x0, y1)], d11 = now_.depth[at(x1, y1)];
      // A cell has its upper and left sides; the picture's lower and right sides are traced.
      for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
          const std::size_t i = at(x, y);
          if (state_[i] == traced) continue;
          if (!one) {
            left_over.push_back(static_cast<std::uint32_t>(i));
            state_[i] = traced;
            continue;
          }
          const float u = static_cast<float>(x - x0) / static_cast<float>(x1 - x0),
                      v = static_cast<float>(y - y0) / static_cast<float>(y1 - y0);
          const auto between = [&](float a, float b, float e, float f) {
            return (a * (1.0f - u) + b * u) * (1.0f - v) + (e * (1.0f - u) + f * u) * v;
          };
          // In perspective the inverse of the depth is linear over a plane.
          now_.depth[i] = now_.object[corner] < 0 ? VisibleSurfaces::nothing
                          : perspective
                              ? 1.0f / between(1.0f / d00, 1.0f / d10, 1.0f / d01, 1.0f / d11)
                              : between(d00, d10, d01, d11);
          now_.object[i] = now_.object[corner];
          now_.normal[i] = now_.normal[corner];
          state_[i] = interpolated;
        }
      }
    }
  });
  join_lists(rows, pixels);
}

}  // namespace lumivec
