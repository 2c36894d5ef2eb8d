#include "network/size_limit.h"

#include "network/wires.h"
#include "num/trig.h"

namespace wireskin::network {

static constexpr const char* k_too_many =
    "the spacing is too small for the network: its surface would have more than 2^26 vertices";

// Vertices in a square of the size of an edge.
static constexpr double k_density = 0.8 * 1.1547;

static double length_of_segment(const curves::Curves& curves, const Segment& segment) {
  const curves::Curve curve = curves[segment.curve];
  return curve.arc[segment.last_knot] - curve.arc[segment.first_knot];
}

static double edges_of_segment(const curves::Curves& curves, const Segment& segment,
                               double spacing) {
  const double edges = length_of_segment(curves, segment) / spacing;
  return edges > 1.0 ? edges : 1.0;
}

// Vertices on curves alone.
static Status check_curves(const curves::Curves& curves, const Network& network, double spacing) {
  double sum = 0.0, most = 0.0;
  Place place;
  for (const Segment& segment : network.segment) {
    const double edges = edges_of_segment(curves, segment, spacing);
    sum += edges;
    if (!(edges > most)) continue;
    most = edges;
    place.curve = segment.curve;
  }
  if (!(sum < k_most_vertices)) return fail(Code::too_large, k_too_many, place);
  if (most < k_most_edges_of_segment) return {};
  return fail(Code::too_large,
              "the spacing is too small for the network: a curve would have more than 2^20 edges "
              "between two nodes",
              place);
}

// The component of each segment: segments that share a node are of one.
static Status find_components(const Network& network, DisjointSets* sets) {
  Array<uint32_t> at_node(network.segment.context());
  uint32_t nodes = 0;
  for (const Segment& s : network.segment) {
    if (s.from == k_none) continue;
    nodes = nodes > s.from ? nodes : s.from + 1;
    nodes = nodes > s.to ? nodes : s.to + 1;
  }
  TRY(at_node.assign(nodes, k_none));
  TRY(sets->reset(static_cast<uint32_t>(network.segment.size())));
  for (uint32_t s = 0; s < network.segment.size(); ++s) {
    if (network.segment[s].from == k_none) continue;
    const uint32_t ends[] = {network.segment[s].from, network.segment[s].to};
    for (const uint32_t node : ends) {
      if (at_node[node] == k_none) at_node[node] = s;
      sets->unite(at_node[node], s);
    }
  }
  return {};
}

// The vertices that a cycle needs.
static double vertices_of_patch(const curves::Curves& curves, const Network& network,
                                uint32_t patch, double spacing) {
  const Segment& first = network.segment[network.cycle(patch)[0] / 2];
  const Vec3 base = curves[first.curve].position.value[first.first_knot];
  Vec3 area;
  double border = 0.0, edges = 0.0;
  for (const uint32_t h : network.cycle(patch)) {
    const Segment& segment = network.segment[h / 2];
    const Span<const Vec3> value = curves[segment.curve].position.value;
    const double sign = h % 2 == 0 ? 0.5 : -0.5;
    for (uint32_t k = segment.first_knot; k < segment.last_knot; ++k) {
      area += sign * cross(value[k] - base, value[k + 1] - base);
    }
    border += length_of_segment(curves, segment);
    edges += edges_of_segment(curves, segment, spacing);
  }
  const double own = border / edges;
  return k_density * length(area) / (own * own);
}

Status check_vertex_count(const curves::Curves& curves, const Network& network, double spacing) {
  Context& context = network.segment.context();
  TRY(check_curves(curves, network, spacing));
  DisjointSets sets(context);
  Array<double> needed(context), of_component(context);
  TRY(find_components(network, &sets));
  TRY(needed.assign(network.patches(), 0.0));
  TRY(of_component.assign(network.segment.size(), 0.0));
  const auto component_of = [&](uint32_t p) { return sets.find(network.cycle(p)[0] / 2); };
  double all = 0.0;
  for (uint32_t p = 0; p < network.patches(); ++p) {
    needed[p] = vertices_of_patch(curves, network, p, spacing);
    of_component[component_of(p)] += needed[p];
    all += needed[p];
  }
  uint32_t worst = k_none;
  for (uint32_t p = 0; p < network.patches(); ++p) {
    const double here = of_component[component_of(p)];
    if (!(here - (all - here) >= k_most_vertices)) continue;
    if (worst == k_none || needed[p] > needed[worst]) worst = p;
  }
  if (worst == k_none) return {};
  Place place;
  place.patch = worst;
  place.curve = network.segment[network.cycle(worst)[0] / 2].curve;
  return fail(Code::too_large, k_too_many, place);
}

// Twice the vector area of one loop.
static Vec3 area_of_loop(const Border& border, uint32_t loop) {
  Vec3 area;
  const Vec3& base = border.position[border.start[loop]];
  for (uint32_t i = border.start[loop] + 1; i + 1 < border.start[loop + 1]; ++i) {
    area += cross(border.position[i] - base, border.position[i + 1] - base);
  }
  return area;
}

// How far a loop is from the others, seen at some thousand vertices of each; what lies between
// these is taken off.
static double clearance(const Border& border, uint32_t loop) {
  constexpr uint32_t k_looks = 2048;
  double least = HUGE_VAL, between = 0.0;
  const auto stride_of = [&](uint32_t l) {
    return 1 + (border.start[l + 1] - border.start[l]) / k_looks;
  };
  const auto widest = [&](uint32_t l) {
    double most = 0.0;
    for (uint32_t i = border.start[l]; i < border.start[l + 1]; ++i) {
      const uint32_t next = i + 1 < border.start[l + 1] ? i + 1 : border.start[l];
      const double edge = length(border.position[next] - border.position[i]);
      most = edge > most ? edge : most;
    }
    return most * stride_of(l);
  };
  const uint32_t step = stride_of(loop);
  for (uint32_t l = 0; l < border.loops(); ++l) {
    if (l == loop) continue;
    between = widest(l) > between ? widest(l) : between;
    for (uint32_t i = border.start[loop]; i < border.start[loop + 1]; i += step) {
      for (uint32_t k = border.start[l]; k < border.start[l + 1]; k += stride_of(l)) {
        const double away = length(border.position[i] - border.position[k]);
        least = away < least ? away : least;
      }
    }
  }
  return least - 0.5 * (between + widest(loop));
}

Status check_border_size(const Border& border, double spacing) {
  const Status too_many = fail(Code::too_large, k_too_many);
  if (border.size() >= k_longest_border_in_space) {
    return fail(Code::too_large,
                "the spacing is too small for the network: a patch that no plane shows would have "
                "more than 2^16 vertices on its border");
  }
  const double most = k_most_vertices / k_density * spacing * spacing;  // area
  if (0.5 * length(vector_area(border)) > most) return too_many;
  for (uint32_t l = 0; l < border.loops() && border.loops() > 1; ++l) {
    const double own = 0.5 * length(area_of_loop(border, l));
    if (!(0.5 * own > most)) continue;
    const double away = clearance(border, l);
    if (away > 0.0 && away * std::sqrt(2.0 * k_pi * own) > most) return too_many;
  }
  return {};
}

}  // namespace wireskin::network
