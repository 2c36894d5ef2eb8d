#include "flow/jitter.h"

#include "flow/delaunay_order.h"
#include "num/minmax.h"

namespace wireskin::flow {

double box_diagonal(Span<const Vec3> points) {
  if (points.empty()) return 0.0;
  Vec3 low = points[0];
  Vec3 high = points[0];
  for (const Vec3& p : points) {
    low = {smaller(low.x, p.x), smaller(low.y, p.y), smaller(low.z, p.z)};
    high = {larger(high.x, p.x), larger(high.y, p.y), larger(high.z, p.z)};
  }
  return length(high - low);
}

// Evenly drawn from [-1, 1).
static double draw(const Vec3& p, uint64_t seed) {
  return static_cast<double>(hash_place(p, seed) >> 11) * 0x1p-52 - 1.0;
}

// What is left of a coordinate next to the origin is noise, and could be too small for the exact
// predicates.
static double moved_coordinate(double x, double by, double diagonal) {
  const double sum = x + by;
  return std::fabs(sum) < 0x1p-60 * diagonal ? 0.0 : sum;
}

void jitter_points(Span<const Vec3> points, double amount, uint64_t seed, Span<Vec3> moved) {
  const double diagonal = box_diagonal(points);
  const double reach = amount * diagonal;
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points[i];
    moved[i] = {moved_coordinate(p.x, reach * draw(p, 3 * seed + 1), diagonal),
                moved_coordinate(p.y, reach * draw(p, 3 * seed + 2), diagonal),
                moved_coordinate(p.z, reach * draw(p, 3 * seed + 3), diagonal)};
  }
}

}  // namespace wireskin::flow
