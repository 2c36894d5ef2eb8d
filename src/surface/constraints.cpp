#include "surface/constraints.h"

#include "base/in_parts.h"

namespace wireskin {

// Half the length of the curve edges at each vertex: how much of its curve a vertex stands for.
static Status curve_shares(const Surface& surface, Array<double>* share) {
  TRY(assign_in_parts(surface.position.size(), 0.0, share));
  return in_parts(share->context(), surface.curve_edge_curve.size(), [&](size_t e) {
    const uint32_t a = surface.curve_edge[2 * e], b = surface.curve_edge[2 * e + 1];
    const double half = 0.5 * length(surface.position[b] - surface.position[a]);
    (*share)[a] += half;
    (*share)[b] += half;
  });
}

// In units of the spacing, and of the diagonal of the bounding box.
static constexpr double k_least_cutoff = 1e-3;
static constexpr double k_greatest_cutoff = 0.1;

Status check_cutoff(double cutoff, double size, uint32_t curve) {
  if (cutoff <= k_greatest_cutoff * size) return {};
  Place place;
  place.curve = curve;
  return fail(Code::bad_argument,
              "the cutoff length of soft constraints is more than a tenth of the diagonal", place);
}

Status constrain_curves(const CurveSet& set, uint32_t curve_vertices, const Surface& surface,
                        Constraints* constraints) {
  const size_t n = surface.position.size();
  TRY(constraints->on_curve.resize(n));
  TRY(constraints->held.resize(n));
  bool any = false;
  for (double cutoff : set.soft) any = any || cutoff > 0.0;
  Context& context = constraints->held.context();
  TRY(in_parts(context, n, [&](size_t v) {
    constraints->on_curve[v] = constraints->held[v] = v < curve_vertices;
  }));
  if (!any) return {};
  TRY(curve_shares(surface, &constraints->share));
  TRY(assign_in_parts(n, -1.0, &constraints->cutoff));
  TRY(in_parts(context, surface.curve_edge.size(), [&](size_t e) {
    double& cutoff = constraints->cutoff[surface.curve_edge[e]];
    const uint32_t curve = surface.curve_edge_curve[e / 2];
    const bool sharp = !set.sharp.empty() && set.sharp[curve];  // these hold in any case
    const bool holds = sharp || set.soft[curve] < k_least_cutoff * surface.counts.spacing;
    const double own = holds ? 0.0 : set.soft[curve];
    if (cutoff < 0.0 || own < cutoff) cutoff = own;
  }));
  return in_parts(context, n, [&](size_t v) {
    if (constraints->cutoff[v] < 0.0) constraints->cutoff[v] = 0.0;
    if (constraints->cutoff[v] > 0.0) constraints->held[v] = 0;
  });
}

Status constrain_vertices(const TriangleSet& set, double spacing, Constraints* constraints) {
  const size_t n = set.position.size();
  const bool soft = set.soft > k_least_cutoff * spacing;
  TRY(constraints->on_curve.copy(set.constrained));
  TRY(constraints->held.assign(n, 0));
  Context& context = constraints->share.context();
  TRY(in_parts(context, n,
               [&](size_t v) { constraints->held[v] = set.constrained[v] != 0 && !soft; }));
  if (!soft) return {};
  Array<double> all(context);
  Array<uint32_t> count(context);
  TRY(assign_in_parts(n, 0.0, &constraints->cutoff));
  TRY(assign_in_parts(n, 0.0, &constraints->share));
  TRY(assign_in_parts(n, 0.0, &all));
  TRY(assign_in_parts(n, 0, &count));
  TRY(in_parts(context, set.triangle.size(), [&](size_t h) {
    // Inner edges are met twice, those of a border once; a quarter and a half of a length is near
    // enough.
    const uint32_t a = set.triangle[h];
    const uint32_t b = set.triangle[mesh::next_half_edge(static_cast<uint32_t>(h))];
    const double edge = length(set.position[b] - set.position[a]);
    all[a] += edge;
    ++count[a];
    if (!set.constrained[a] || !set.constrained[b]) return;
    constraints->share[a] += 0.5 * edge;
    constraints->share[b] += 0.5 * edge;
  }));
  return in_parts(context, n, [&](size_t v) {
    if (!set.constrained[v]) return;
    constraints->cutoff[v] = set.soft;
    if (constraints->share[v] == 0.0)
      constraints->share[v] = all[v] / static_cast<double>(count[v]);
  });
}

}  // namespace wireskin
