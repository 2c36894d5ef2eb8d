#include "mesh/nearest.h"

#include <cfloat>

namespace wireskin::mesh {

Vec2 nearest_weights(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 way = b - a;
  const double square = dot(way, way), t = square > 0.0 ? dot(p - a, way) / square : 0.0;
  const double at_b = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
  return {1.0 - at_b, at_b};
}

Vec3 nearest_weights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 across = cross(b - a, c - a);
  const double square = dot(across, across);
  const Vec3 inside = {dot(cross(b - p, c - p), across), dot(cross(c - p, a - p), across),
                       dot(cross(a - p, b - p), across)};
  if (square > 0.0 && inside.x >= 0.0 && inside.y >= 0.0 && inside.z >= 0.0) {
    return (1.0 / square) * inside;
  }
  const Vec2 ab = nearest_weights(p, a, b), bc = nearest_weights(p, b, c),
             ca = nearest_weights(p, c, a);
  const Vec3 best[3] = {{ab.x, ab.y, 0.0}, {0.0, bc.x, bc.y}, {ca.y, 0.0, ca.x}};
  Vec3 nearest;
  double least = DBL_MAX;
  for (const Vec3& w : best) {
    const Vec3 gap = w.x * a + w.y * b + w.z * c - p;
    if (!(dot(gap, gap) < least)) continue;
    least = dot(gap, gap);
    nearest = w;
  }
  return nearest;
}

bool is_on_border(const Vec3& weights, const uint32_t* triangle, uint32_t rim) {
  const double weight[3] = {weights.x, weights.y, weights.z};
  int held = 0, all = 0;
  for (int k = 0; k < 3; ++k) {
    if (weight[k] == 0.0) continue;
    ++all;
    held += triangle[k] < rim;
  }
  return held == all && all < 3;
}

}  // namespace wireskin::mesh
