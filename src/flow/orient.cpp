#include "flow/orient.h"

#include "base/in_parts.h"

namespace wireskin::flow {

Status find_sides(const Complex& complex, const Persistence& persistence, const Topology3& topology,
                  Array<uint32_t>* side) {
  const uint32_t outside = complex.tet_count();
  Array<uint32_t> number(side->context());
  TRY(number.assign(size_t{outside} + 1, 0));
  for (uint32_t i = 0; i < topology.chosen.size(); ++i) {
    const uint32_t label = topology.label[persistence.voids[topology.chosen[i]].maximum];
    if (label != topology.label[outside]) number[label] = i + 1;
  }
  TRY(side->resize(2 * size_t{complex.triangle_count()}));
  return in_parts(side->context(), side->size(), [&](size_t i) {
    const uint32_t t = complex.triangle_side[i];
    (*side)[i] = number[topology.label[t == k_none ? outside : t]];
  });
}

// Whether a triangle's stored order passes edge number k from its lesser vertex to its greater.
static bool runs_up(const Complex& complex, uint32_t triangle, uint32_t k) {
  const uint32_t* const v = &complex.triangle[3 * size_t{triangle}];
  return v[(k + 1) % 3] < v[(k + 2) % 3];
}

static uint32_t place_of_edge(const Complex& complex, uint32_t triangle, uint32_t e) {
  const uint32_t* const edge = &complex.triangle_edge[3 * size_t{triangle}];
  return edge[0] == e ? 0 : edge[1] == e ? 1 : 2;
}

Status orient_walls(Context& context, const Complex& complex, const Sheet& walls,
                    Span<const uint32_t> side, Array<uint8_t>* turned) {
  constexpr uint8_t k_open = 2;
  const uint32_t triangles = complex.triangle_count();
  Array<uint32_t> queue(context);
  TRY(queue.reserve(triangles));
  TRY(turned->assign(triangles, k_open));
  TRY(in_parts(context, triangles, [&](size_t t) {
    // It is counter-clockwise seen from its second side; the lesser void is in front.
    const uint32_t first = side[2 * t], second = side[2 * t + 1];
    if (walls.in[t] == 0 || first == second) return;
    (*turned)[t] = first < second;
    queue.push_reserved(static_cast<uint32_t>(t));
  }));
  Pace pace(context);
  size_t head = 0;
  for (uint32_t seed = 0; seed <= triangles; ++seed) {
    for (; head < queue.size(); ++head) {
      const uint32_t t = queue[head];
      TRY(pace.after());
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t e = complex.triangle_edge[3 * size_t{t} + k];
        if (walls.degree[e] != 2) continue;
        for (const uint32_t u : complex.triangles_of(e)) {
          if (walls.in[u] == 0 || (*turned)[u] != k_open) continue;
          const bool same =
              runs_up(complex, t, k) == runs_up(complex, u, place_of_edge(complex, u, e));
          (*turned)[u] = same ? 1 - (*turned)[t] : (*turned)[t];
          queue.push_reserved(u);
        }
      }
    }
    if (seed == triangles || walls.in[seed] == 0 || (*turned)[seed] != k_open) continue;
    (*turned)[seed] = 0;
    queue.push_reserved(seed);
  }
  for (uint8_t& flag : *turned) flag = flag == 1;
  return {};
}

}  // namespace wireskin::flow
