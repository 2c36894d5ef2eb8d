// A software rasteriser: triangles with a depth buffer and a colour for every pixel, and thick
// lines.
//
// Coordinates are pixels, x to the right and y down, the centre of the first pixel at 0.5; greater
// depth is nearer to the eye. Draw the lines last: they are tested against the depth but leave
// none.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "vec.h"

namespace wireskin_cli {

struct Rgb {
  uint8_t r = 255, g = 255, b = 255;
};

struct Canvas {
  int width;
  int height;
  std::vector<Rgb> colour;
  std::vector<float> depth;

  Canvas(int w, int h)
      : width(w),
        height(h),
        colour(static_cast<size_t>(w) * static_cast<size_t>(h)),
        depth(colour.size(), -std::numeric_limits<float>::infinity()) {}

  size_t at(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  }
};

struct ScreenPoint {
  double x = 0.0, y = 0.0, depth = 0.0;
};

// The pixels whose centres a box may hold.
struct PixelBox {
  int x0, y0, x1, y1;  // the last ones included
};

inline PixelBox clipped_box(const Canvas& canvas, double x0, double y0, double x1, double y1) {
  const auto clip = [](double v, int size) {
    return static_cast<int>(std::clamp(v, -1.0, static_cast<double>(size)));
  };
  return {std::max(0, clip(std::floor(x0), canvas.width)),
          std::max(0, clip(std::floor(y0), canvas.height)),
          std::min(canvas.width - 1, clip(std::ceil(x1), canvas.width)),
          std::min(canvas.height - 1, clip(std::ceil(y1), canvas.height))};
}

// Twice the signed area of a, b and (x, y).
inline double turn(const ScreenPoint& a, const ScreenPoint& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

// Both sides are drawn. shade(weights) gives the colour where the corners have the three weights.
template <typename Shade>
void fill_triangle(Canvas& canvas, const ScreenPoint (&p)[3], const Shade& shade) {
  const double area = turn(p[0], p[1], p[2].x, p[2].y);
  if (area == 0.0 || !std::isfinite(area)) return;
  const double one_over_area = 1.0 / area;
  const PixelBox box = clipped_box(
      canvas, std::min({p[0].x, p[1].x, p[2].x}) - 0.5, std::min({p[0].y, p[1].y, p[2].y}) - 0.5,
      std::max({p[0].x, p[1].x, p[2].x}), std::max({p[0].y, p[1].y, p[2].y}));
  for (int y = box.y0; y <= box.y1; ++y) {
    for (int x = box.x0; x <= box.x1; ++x) {
      const double cx = x + 0.5;
      const double cy = y + 0.5;
      const double w[3] = {one_over_area * turn(p[1], p[2], cx, cy),
                           one_over_area * turn(p[2], p[0], cx, cy),
                           one_over_area * turn(p[0], p[1], cx, cy)};
      if (w[0] < 0.0 || w[1] < 0.0 || w[2] < 0.0) continue;
      const float depth =
          static_cast<float>(w[0] * p[0].depth + w[1] * p[1].depth + w[2] * p[2].depth);
      const size_t i = canvas.at(x, y);
      if (depth <= canvas.depth[i]) continue;
      canvas.depth[i] = depth;
      canvas.colour[i] = shade(w);
    }
  }
}

// A line with round ends, hidden where the surface is more than `bias` nearer.
inline void draw_line(Canvas& canvas, const ScreenPoint& a, const ScreenPoint& b, double radius,
                      double bias, Rgb colour) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double square = dx * dx + dy * dy;
  if (!std::isfinite(square)) return;
  const PixelBox box =
      clipped_box(canvas, std::min(a.x, b.x) - radius - 0.5, std::min(a.y, b.y) - radius - 0.5,
                  std::max(a.x, b.x) + radius, std::max(a.y, b.y) + radius);
  for (int y = box.y0; y <= box.y1; ++y) {
    for (int x = box.x0; x <= box.x1; ++x) {
      const double px = x + 0.5 - a.x;
      const double py = y + 0.5 - a.y;
      const double t = square > 0.0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0.0;
      const double off_x = px - t * dx;
      const double off_y = py - t * dy;
      if (off_x * off_x + off_y * off_y > radius * radius) continue;
      const double depth = a.depth + t * (b.depth - a.depth) + bias;
      const size_t i = canvas.at(x, y);
      if (depth >= static_cast<double>(canvas.depth[i])) canvas.colour[i] = colour;
    }
  }
}

}  // namespace wireskin_cli
