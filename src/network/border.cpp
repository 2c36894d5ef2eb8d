#include "network/border.h"

#include "network/side_normals.h"

namespace wireskin::network {

// Where a border begins must not depend on the order or the direction of the curves, or these would
// change the triangulation: at its least point, nodes (whose bits are the caller's) before others.
static bool begins_before(const CurveVertices& vertices, uint32_t a, uint32_t b) {
  if ((a < vertices.nodes) != (b < vertices.nodes)) return a < vertices.nodes;
  const Vec3 &p = vertices.position[a], &q = vertices.position[b];
  if (p.x != q.x) return p.x < q.x;
  return p.y != q.y ? p.y < q.y : p.z < q.z;
}

static Status append_loop(const Network& network, const CurveVertices& vertices, uint32_t loop,
                          Border* border) {
  const Span<const uint32_t> half = network.loop[loop];
  Array<uint32_t> vertex(border->vertex.context());
  Array<Vec3> normal(border->vertex.context());
  for (size_t i = 0; i < half.size(); ++i) {
    const uint32_t h = half[i], before = half[i == 0 ? half.size() - 1 : i - 1];
    const uint32_t s = h / 2, edges = vertices.edges[s];
    for (uint32_t k = 0; k < edges; ++k) {
      TRY(vertex.push(segment_vertex(network, vertices, s, h % 2 == 0 ? k : edges - k)));
      const Vec3 own = left_normal(network, vertices, h, k);
      if (k > 0 || vertices.side_start.empty()) {
        TRY(normal.push(own));
      } else {
        const Vec3 last = left_normal(network, vertices, before, vertices.edges[before / 2]);
        TRY(normal.push(unit(last + own)));
      }
    }
  }
  const size_t n = vertex.size();
  size_t first = 0;
  for (size_t i = 1; i < n; ++i) {
    if (begins_before(vertices, vertex[i], vertex[first])) first = i;
  }
  for (size_t i = 0; i < n; ++i) {
    const size_t k = (first + i) % n;
    TRY(border->vertex.push(vertex[k]));
    TRY(border->position.push(vertices.position[vertex[k]]));
    TRY(border->normal.push(normal[k]));
  }
  return border->start.push(static_cast<uint32_t>(border->vertex.size()));
}

Status border_of_patch(const Network& network, const CurveVertices& vertices, uint32_t patch,
                       Border* border) {
  border->start.clear();
  border->vertex.clear();
  border->position.clear();
  border->normal.clear();
  TRY(border->start.push(0));
  for (uint32_t l = network.patch_start[patch]; l < network.patch_start[patch + 1]; ++l) {
    TRY(append_loop(network, vertices, l, border));
  }
  return {};
}

uint32_t next_on_border(const Border& border, uint32_t loop, uint32_t i) {
  return i + 1 == border.start[loop + 1] ? border.start[loop] : i + 1;
}

Vec3 vector_area(const Border& border) {
  Vec3 area;
  const Vec3 base = border.position[0];
  for (uint32_t l = 0; l < border.loops(); ++l) {
    for (uint32_t i = border.start[l]; i < border.start[l + 1]; ++i) {
      const Vec3& next = border.position[next_on_border(border, l, i)];
      area += cross(border.position[i] - base, next - base);
    }
  }
  return area;
}

Vec3 mean_normal(const Border& border) {
  Vec3 sum;
  double known = 0.0;
  for (const Vec3& n : border.normal) {
    sum += n;
    known += n != Vec3{} ? 1.0 : 0.0;
  }
  return known > 0.0 ? (1.0 / known) * sum : Vec3{};
}

double border_length(const Border& border) {
  double sum = 0.0;
  for (uint32_t l = 0; l < border.loops(); ++l) {
    for (uint32_t i = border.start[l]; i < border.start[l + 1]; ++i) {
      sum += length(border.position[next_on_border(border, l, i)] - border.position[i]);
    }
  }
  return sum;
}

}  // namespace wireskin::network
