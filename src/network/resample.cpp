#include "network/resample.h"

#include "base/in_parts.h"
#include "base/sort.h"
#include "curves/sides.h"
#include "network/side_normals.h"

namespace wireskin::network {

static double segment_length(const curves::Curves& curves, const Segment& segment) {
  const curves::Curve curve = curves[segment.curve];
  return curve.arc[segment.last_knot] - curve.arc[segment.first_knot];
}

// Marks with 3 the segments that return to their node, with 2 those that join the same two nodes as
// another one, all others with 1.
static Status least_edges(Span<const Segment> segments, Array<uint32_t>* least) {
  Array<uint32_t> order(least->context());
  TRY(order.resize(segments.size()));
  TRY(least->assign(segments.size(), 1));
  const auto low = [&](uint32_t s) {
    return segments[s].from < segments[s].to ? segments[s].from : segments[s].to;
  };
  const auto high = [&](uint32_t s) {
    return segments[s].from < segments[s].to ? segments[s].to : segments[s].from;
  };
  for (uint32_t s = 0; s < segments.size(); ++s) order[s] = s;
  sort(order.span(), [&](uint32_t a, uint32_t b) {
    if (low(a) != low(b)) return low(a) < low(b);
    return high(a) != high(b) ? high(a) < high(b) : a < b;
  });
  for (size_t i = 0; i < order.size(); ++i) {
    const uint32_t s = order[i];
    const auto joins_the_same = [&](size_t k) {
      return low(order[k]) == low(s) && high(order[k]) == high(s);
    };
    if (segments[s].from == segments[s].to) {
      (*least)[s] = 3;
    } else if ((i > 0 && joins_the_same(i - 1)) ||
               (i + 1 < order.size() && joins_the_same(i + 1))) {
      (*least)[s] = 2;
    }
  }
  return {};
}

// Chooses the number of edges of each segment and counts the vertices.
static Status count_edges(const curves::Curves& curves, const Network& network, size_t nodes,
                          double spacing, CurveVertices* vertices) {
  TRY(least_edges(network.segment.span(), &vertices->edges));
  TRY(vertices->first.resize(network.segment.size()));
  uint64_t next = nodes;
  for (size_t s = 0; s < network.segment.size(); ++s) {
    const double length = segment_length(curves, network.segment[s]);
    vertices->length += length;
    const double wished = length / spacing + 0.5;
    if (!(wished < 1e9)) return fail(Code::too_large, "the spacing is too small for the network");
    if (wished > vertices->edges[s]) vertices->edges[s] = static_cast<uint32_t>(wished);
    vertices->first[s] = static_cast<uint32_t>(next);
    next += vertices->edges[s] - 1 + (network.segment[s].from == k_none);
    if (next > 0x7fffffff) return fail(Code::too_large, "the spacing is too small for the network");
  }
  TRY(vertices->position.resize(static_cast<size_t>(next)));
  TRY(vertices->normal.resize(static_cast<size_t>(next)));
  return vertices->curve.assign(static_cast<size_t>(next), k_none);
}

uint32_t segment_vertex(const Network& network, const CurveVertices& vertices, uint32_t s,
                        uint32_t k) {
  const Segment& segment = network.segment[s];
  if (segment.from == k_none) return vertices.first[s] + k % vertices.edges[s];
  if (k == 0) return segment.from;
  return k == vertices.edges[s] ? segment.to : vertices.first[s] + k - 1;
}

static Status place_vertices(const curves::Curves& curves, const Network& network, uint32_t s,
                             Pace* pace, CurveVertices* vertices) {
  const Segment& segment = network.segment[s];
  const curves::Curve curve = curves[segment.curve];
  const double from = curve.arc[segment.first_knot];
  const double length = curve.arc[segment.last_knot] - from;
  const uint32_t edges = vertices->edges[s];
  for (uint32_t k = 0; k <= edges; ++k) {
    TRY(pace->after(curves::k_steps_of_point));
    const uint32_t v = segment_vertex(network, *vertices, s, k);
    if (vertices->curve[v] > segment.curve) vertices->curve[v] = segment.curve;
    if (segment.from != k_none && (k == 0 || k == edges)) continue;  // nodes are there already
    const double part = static_cast<double>(k) / static_cast<double>(edges);
    const curves::CurvePoint point =
        point_at(curve, segment.first_knot, segment.last_knot, from + part * length);
    if (has_normals(curve) && !(dot(point.normal, point.normal) > 0.5)) {
      return fail_at_sample(Code::inconsistent_normals,
                            "the normals of neighbouring samples cancel out", segment.curve,
                            curve.sample[segment.first_knot]);
    }
    if (k == edges) break;  // the closed curve's first vertex again
    vertices->position[v] = point.position;
    vertices->normal[v] = point.normal;
  }
  return {};
}

Status resample(const curves::Curves& curves, Span<const Node> nodes, const Network& network,
                double spacing, CurveVertices* vertices) {
  vertices->nodes = static_cast<uint32_t>(nodes.size());
  TRY(count_edges(curves, network, nodes.size(), spacing, vertices));
  for (size_t i = 0; i < nodes.size(); ++i) {
    vertices->position[i] = nodes[i].position;
    vertices->normal[i] = nodes[i].normal;
  }
  Pace pace(vertices->position.context());
  for (uint32_t s = 0; s < network.segment.size(); ++s) {
    TRY(place_vertices(curves, network, s, &pace, vertices));
  }
  // The curves' own numbers of nodes would not do: they hold before patches are dropped.
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (vertices->curve[i] > nodes[i].point_curve) vertices->curve[i] = nodes[i].point_curve;
  }
  return curves.right.empty() ? Status{} : resample_sides(curves, network, vertices);
}

}  // namespace wireskin::network
