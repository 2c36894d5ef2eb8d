#include "flow/curve_edges.h"

#include "base/in_parts.h"

namespace wireskin::flow {

Status find_curve_edges(const Complex& complex, const Samples& samples, CurveEdges* curves) {
  TRY(curves->segment.assign(complex.edge_count(), k_none));
  TRY(curves->chord_middle.assign(complex.edge_count(), k_none));
  TRY(curves->edge_of.assign(samples.at.size(), k_none));
  curves->missing = 0;
  for (uint32_t a = 0; a + 1 < samples.start.size(); ++a) {
    for (uint32_t i = samples.start[a]; i + 1 < samples.start[a + 1]; ++i) {
      const uint32_t u = complex.same_as[samples.at[i]], v = complex.same_as[samples.at[i + 1]];
      if (u == v) continue;
      const uint32_t e = find_edge(complex, u, v);
      curves->edge_of[i] = e;
      if (e == k_none) {
        ++curves->missing;
      } else if (curves->segment[e] == k_none) {
        curves->segment[e] = i;
      }
    }
  }
  return in_parts(curves->segment.context(), complex.triangle_count(), [&](size_t t) {
    const uint32_t* const edge = &complex.triangle_edge[3 * t];
    for (uint32_t k = 0; k < 3; ++k) {
      if (curves->on_curve(edge[k])) continue;
      if (!curves->on_curve(edge[(k + 1) % 3]) || !curves->on_curve(edge[(k + 2) % 3])) continue;
      curves->chord_middle[edge[k]] = complex.triangle[3 * t + k];
    }
  });
}

}  // namespace wireskin::flow
