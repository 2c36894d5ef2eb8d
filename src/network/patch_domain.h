// What the mesh of one patch must have: the vertices of the curves at it and the edges between
// them.
//
// In: the network, the vertices on the curves, a patch. Out: its border; its vertices numbered from
// zero, those of the loops first, then those of curves and points inside; the edges of the curves.
// The memory serves one patch after the other. O(n log n) in the vertices of the patch.
#pragma once

#include "network/border.h"

namespace wireskin::network {

// Local vertices, a < b.
struct DomainEdge {
  uint32_t a, b;
};

struct PatchDomain {
  Border border;
  Array<uint32_t> local;         // of each curve vertex, k_none between patches
  Array<uint32_t> vertex;        // of each local one the curve vertex
  Array<Vec3> position;          // of the local vertices
  Array<uint32_t> loop;          // local, in the order of the border
  Array<uint32_t> inner_edge;    // two local ones each
  Array<DomainEdge> curve_edge;  // sorted: loops' and inner edges

  explicit PatchDomain(Context& context)
      : border(context),
        local(context),
        vertex(context),
        position(context),
        loop(context),
        inner_edge(context),
        curve_edge(context) {}

  Status start(const CurveVertices& vertices) {
    return local.assign(vertices.position.size(), k_none);
  }
  Status take(const Network& network, const CurveVertices& vertices, uint32_t patch);

  uint32_t size() const { return static_cast<uint32_t>(vertex.size()); }
  bool is_curve_edge(uint32_t p, uint32_t q) const;
};

void sort_edges(Span<DomainEdge> edges);
bool has_edge(Span<const DomainEdge> sorted, const DomainEdge& edge);

}  // namespace wireskin::network
