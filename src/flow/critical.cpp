#include "flow/critical.h"

#include "base/in_parts.h"
#include "flow/gabriel.h"

namespace wireskin::flow {

// A maximum: the centre of the ball lies inside the tetrahedron, that is, no corner lies inside the
// smallest ball of the opposite face.
static bool critical_tet(const Complex& c, uint32_t t) {
  const uint32_t* v = c.tet.data() + 4 * static_cast<size_t>(t);
  for (uint32_t i = 0; i < 4; ++i) {
    const Vec3& p = c.point[v[(i + 1) & 3]];
    const Vec3& q = c.point[v[(i + 2) & 3]];
    const Vec3& r = c.point[v[(i + 3) & 3]];
    if (inside_triangle_ball(p, q, r, c.point[v[i]])) return false;
  }
  return true;
}

// Gabriel and acute.
static bool critical_triangle(const Complex& c, uint32_t t) {
  if (c.triangle_gabriel[t] == 0) return false;
  const uint32_t* v = c.triangle.data() + 3 * static_cast<size_t>(t);
  for (uint32_t i = 0; i < 3; ++i) {
    const Vec3& p = c.point[v[(i + 1) % 3]];
    const Vec3& q = c.point[v[(i + 2) % 3]];
    if (inside_edge_ball(p, q, c.point[v[i]])) return false;
  }
  return true;
}

Status find_critical_points(const Complex& complex, CriticalPoints* critical) {
  Pace pace(critical->edge.context());
  critical->points = 0;
  critical->edge.clear();
  critical->triangle.clear();
  critical->tet.clear();
  for (uint32_t i = 0; i < complex.same_as.size(); ++i) {
    if (complex.same_as[i] == i) ++critical->points;
  }
  for (uint32_t e = 0; e < complex.edge_count(); ++e) {
    TRY(pace.after());
    if (complex.edge_gabriel[e] != 0) TRY(critical->edge.push(e));
  }
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    TRY(pace.after());
    if (critical_triangle(complex, t)) TRY(critical->triangle.push(t));
  }
  for (uint32_t t = 0; t < complex.tet_count(); ++t) {
    TRY(pace.after());
    if (critical_tet(complex, t)) TRY(critical->tet.push(t));
  }
  return {};
}

}  // namespace wireskin::flow
