#include "mesh/cut.h"

#include "base/in_parts.h"

namespace wireskin::mesh {

// The clockwise-most corner of the sector of corner h, a half-edge that leaves its vertex: cuts and
// borders end the walk, or else it comes back to h.
static uint32_t first_of_sector(Span<const uint32_t> twins, Span<const uint8_t> marked,
                                uint32_t h) {
  uint32_t g = h;
  while (!marked[g] && twins[g] != k_none) {
    g = next_half_edge(twins[g]);
    if (g == h) break;
  }
  return g;
}

Status cut_open(uint32_t vertices, Span<const uint32_t> triangles, Span<const uint32_t> twins,
                Span<const uint8_t> marked, Cut* cut) {
  Array<uint8_t> taken(cut->origin.context());
  TRY(assign_in_parts(vertices, 0, &taken));
  TRY(assign_in_parts(triangles.size(), k_none, &cut->triangle));
  TRY(cut->origin.resize(vertices));
  TRY(in_parts<k_light_steps_per_checkpoint>(cut->origin.context(), vertices, [&](size_t v) {
    cut->origin[v] = static_cast<uint32_t>(v);
  }));
  Pace pace(cut->origin.context());
  for (uint32_t h = 0; h < triangles.size(); ++h) {
    TRY(pace.after());
    if (cut->triangle[h] != k_none) continue;
    const uint32_t v = triangles[h];
    uint32_t copy = v;
    if (taken[v]) {
      copy = cut->vertices();
      TRY(cut->origin.push(v));
    }
    taken[v] = 1;
    const uint32_t first = first_of_sector(twins, marked, h);
    for (uint32_t g = first; g != k_none;) {
      cut->triangle[g] = copy;
      const uint32_t across = previous_half_edge(g);
      g = marked[across] ? k_none : twins[across];
      if (g == first) break;
    }
  }
  return {};
}

}  // namespace wireskin::mesh
