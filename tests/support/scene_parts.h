// Pieces of the reference scenes: circles, sections of ellipsoids and straight lines, of sqrt and
// the four operations alone.
#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "support/scenes.h"

namespace scenes {

struct Point2 {
  double x, y;
};

// `segments` (a power of two) equal steps of the quarter from (1, 0) to (0, 1), both ends included.
inline std::vector<Point2> quarter(size_t segments) {
  std::vector<Point2> points(segments + 1);
  points[0] = {1.0, 0.0};
  points[segments] = {0.0, 1.0};
  for (size_t step = segments; step > 1; step /= 2) {
    for (size_t i = 0; i < segments; i += step) {
      const Point2 a = points[i], b = points[i + step];
      const double x = a.x + b.x, y = a.y + b.y, norm = std::sqrt(x * x + y * y);
      points[i + step / 2] = {x / norm, y / norm};
    }
  }
  return points;
}

// The whole circle, without repeating its first point; exact under quarter turns.
inline std::vector<Point2> circle(size_t segments_per_quarter) {
  const std::vector<Point2> first = quarter(segments_per_quarter);
  std::vector<Point2> points;
  for (int turn = 0; turn < 4; ++turn) {
    for (size_t i = 0; i < segments_per_quarter; ++i) {
      Point2 p = first[i];
      for (int t = 0; t < turn; ++t) p = {-p.y, p.x};
      points.push_back(p);
    }
  }
  return points;
}

inline void add_sample(Curve& curve, const std::array<double, 3>& position,
                       const std::array<double, 3>& normal, uint32_t node) {
  curve.positions.insert(curve.positions.end(), position.begin(), position.end());
  curve.normals.insert(curve.normals.end(), normal.begin(), normal.end());
  curve.nodes.push_back(node);
}

// The section of the ellipsoid with the plane of axes a and b. Nodes are numbered +x -x +y -y +z
// -z.
inline Curve section(const std::vector<Point2>& unit_circle, size_t a, size_t b,
                     const std::array<double, 3>& radii) {
  const uint32_t node_at_quarter[4] = {static_cast<uint32_t>(2 * a), static_cast<uint32_t>(2 * b),
                                       static_cast<uint32_t>(2 * a + 1),
                                       static_cast<uint32_t>(2 * b + 1)};
  const size_t quarter_size = unit_circle.size() / 4;
  Curve curve;
  curve.closed = true;
  for (size_t i = 0; i < unit_circle.size(); ++i) {
    std::array<double, 3> position = {}, normal = {};
    position[a] = radii[a] * unit_circle[i].x;
    position[b] = radii[b] * unit_circle[i].y;
    normal[a] = unit_circle[i].x / radii[a];
    normal[b] = unit_circle[i].y / radii[b];
    const bool at_node = i % quarter_size == 0;
    add_sample(curve, position, normal, at_node ? node_at_quarter[i / quarter_size] : WSK_NONE);
  }
  return curve;
}

// `segments` even steps from a to b between two nodes, with the same normal all along.
inline Curve straight(const std::array<double, 3>& a, const std::array<double, 3>& b, uint32_t from,
                      uint32_t to, const std::array<double, 3>& normal, int segments) {
  Curve curve;
  for (int i = 0; i <= segments; ++i) {
    const double t = static_cast<double>(i) / segments;
    std::array<double, 3> position;
    for (size_t k = 0; k < 3; ++k) position[k] = a[k] + t * (b[k] - a[k]);
    add_sample(curve, position, normal, i == 0 ? from : i == segments ? to : WSK_NONE);
  }
  return curve;
}

}  // namespace scenes
