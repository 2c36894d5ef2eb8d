// A curve network as plain data, and the few operations on points that its makers need.
//
// Curves are runs of vertices; where two curves, or two passes of one, use the same vertex, there
// is a node. Normals are unit and point to the outer side. A closed curve does not repeat its first
// vertex. `boundary` says that the surface ends at this curve.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace networks {

using Point = std::array<double, 3>;

struct Network {
  struct Curve {
    std::vector<uint32_t> vertices;
    bool closed = false;
    bool boundary = false;
  };
  std::vector<Point> positions;
  std::vector<Point> normals;
  std::vector<Curve> curves;
};

inline Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator*(double s, const Point& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Point& a) {
  return std::sqrt(dot(a, a));
}
inline double distance(const Point& a, const Point& b) {
  return length(a - b);
}

// The zero vector stays zero.
inline Point unit(const Point& a) {
  const double norm = length(a);
  return norm > 0.0 ? (1.0 / norm) * a : Point{0.0, 0.0, 0.0};
}

// Two unit vectors that make a right-handed frame with the unit vector n: (first, second, n).
inline std::array<Point, 2> tangent_frame(const Point& n) {
  const bool along_x = std::fabs(n[0]) > 0.8;
  const Point first = unit(cross(along_x ? Point{0.0, 1.0, 0.0} : Point{1.0, 0.0, 0.0}, n));
  return {first, cross(n, first)};
}

}  // namespace networks
