#include "flow/critical.h"

namespace wireskin::flow {

// A simplex that is swallowed together with another has a copy of its value, so equality of doubles
// is the right question.
static bool critical_tet(const Complex& c, uint32_t t) {
  for (uint32_t i = 0; i < 4; ++i) {
    if (c.triangle_value[c.tet_triangle[4 * t + i]] == c.tet_value[t]) return false;
  }
  return true;
}

static bool critical_triangle(const Complex& c, uint32_t t) {
  const double value = c.triangle_value[t];
  for (uint32_t k = 0; k < 2; ++k) {
    if (c.tet_value_of(c.triangle_side[2 * t + k]) == value) return false;
  }
  for (uint32_t k = 0; k < 3; ++k) {
    if (c.edge_value[c.triangle_edge[3 * t + k]] == value) return false;
  }
  return true;
}

static bool critical_edge(const Complex& c, uint32_t e) {
  for (const uint32_t t : c.triangles_of(e)) {
    if (c.triangle_value[t] == c.edge_value[e]) return false;
  }
  return true;
}

Status find_critical_points(const Complex& complex, CriticalPoints* critical) {
  critical->points = 0;
  critical->edge.clear();
  critical->triangle.clear();
  critical->tet.clear();
  for (uint32_t i = 0; i < complex.same_as.size(); ++i) {
    if (complex.same_as[i] == i) ++critical->points;
  }
  for (uint32_t e = 0; e < complex.edge_count(); ++e) {
    if (critical_edge(complex, e)) TRY(critical->edge.push(e));
  }
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    if (critical_triangle(complex, t)) TRY(critical->triangle.push(t));
  }
  for (uint32_t t = 0; t < complex.tet_count(); ++t) {
    if (critical_tet(complex, t)) TRY(critical->tet.push(t));
  }
  return {};
}

}  // namespace wireskin::flow
