#include "network/patch_domain.h"

#include "base/search.h"
#include "base/sort.h"

namespace wireskin::network {

static bool edge_before(const DomainEdge& x, const DomainEdge& y) {
  return x.a != y.a ? x.a < y.a : x.b < y.b;
}

void sort_edges(Span<DomainEdge> edges) {
  sort(edges, edge_before);
}

bool has_edge(Span<const DomainEdge> sorted, const DomainEdge& edge) {
  const size_t i = first_failing(size_t{0}, sorted.size(),
                                 [&](size_t k) { return edge_before(sorted[k], edge); });
  return i < sorted.size() && sorted[i].a == edge.a && sorted[i].b == edge.b;
}

static DomainEdge edge_of(uint32_t p, uint32_t q) {
  return p < q ? DomainEdge{p, q} : DomainEdge{q, p};
}

bool PatchDomain::is_curve_edge(uint32_t p, uint32_t q) const {
  return has_edge(curve_edge.span(), edge_of(p, q));
}

static Status add_vertex(uint32_t v, const CurveVertices& vertices, PatchDomain* domain,
                         uint32_t* local) {
  if (domain->local[v] == k_none) {
    domain->local[v] = domain->size();
    TRY(domain->vertex.push(v));
    TRY(domain->position.push(vertices.position[v]));
  }
  *local = domain->local[v];
  return {};
}

Status PatchDomain::take(const Network& network, const CurveVertices& vertices, uint32_t patch) {
  TRY(border_of_patch(network, vertices, patch, &border));
  for (uint32_t v : vertex) local[v] = k_none;
  vertex.clear();
  position.clear();
  inner_edge.clear();
  curve_edge.clear();
  TRY(loop.resize(border.size()));
  for (uint32_t i = 0; i < border.size(); ++i) {
    TRY(add_vertex(border.vertex[i], vertices, this, &loop[i]));
  }
  for (uint32_t l = 0; l < border.loops(); ++l) {
    for (uint32_t i = border.start[l]; i < border.start[l + 1]; ++i) {
      TRY(curve_edge.push(edge_of(loop[i], loop[next_on_border(border, l, i)])));
    }
  }
  for (uint32_t s : network.inner[patch]) {
    uint32_t last = k_none, at = k_none;
    for (uint32_t k = 0; k <= vertices.edges[s]; ++k, last = at) {
      TRY(add_vertex(segment_vertex(network, vertices, s, k), vertices, this, &at));
      if (k == 0) continue;
      TRY(inner_edge.push(last));
      TRY(inner_edge.push(at));
      TRY(curve_edge.push(edge_of(last, at)));
    }
  }
  for (uint32_t v : network.point[patch]) {
    uint32_t at = k_none;
    TRY(add_vertex(v, vertices, this, &at));
  }
  sort_edges(curve_edge.span());
  return {};
}

}  // namespace wireskin::network
