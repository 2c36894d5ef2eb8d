#include "network/linking.h"

#include "num/trig.h"

namespace wireskin::network {

// An edge of the border with the normal that it has, across it; `next`: the edge behind it.
namespace {

struct LinkedEdge {
  Vec3 from, to, tangent, normal;
  uint32_t next;
};

}  // namespace

// The angle of the corner between the planes x y and y z of a spherical quadrilateral, signed.
static double arc_sine(double s) {
  const double clamped = s < -1.0 ? -1.0 : s > 1.0 ? 1.0 : s;
  return arc_tangent(clamped, std::sqrt((1.0 - clamped) * (1.0 + clamped)));
}

// The signed solid angle over 4 pi from which two edges are seen to cross.
static double crossing_share(const LinkedEdge& e, const LinkedEdge& f) {
  const Vec3 ac = f.from - e.from, ad = f.to - e.from, bc = f.from - e.to, bd = f.to - e.to;
  const double side = dot(cross(f.to - f.from, e.to - e.from), ac);
  if (side == 0.0) return 0.0;
  const Vec3 n1 = unit(cross(ac, ad)), n2 = unit(cross(ad, bd));
  const Vec3 n3 = unit(cross(bd, bc)), n4 = unit(cross(bc, ac));
  const double angle =
      arc_sine(dot(n1, n2)) + arc_sine(dot(n2, n3)) + arc_sine(dot(n3, n4)) + arc_sine(dot(n4, n1));
  return (side > 0.0 ? angle : -angle) / (4.0 * k_pi);
}

// How far the normals turn about the curve from an edge to the next one, in radians, against the
// normal carried over by the least rotation.
static double twist_angle(const LinkedEdge& e, const LinkedEdge& f) {
  const Vec3 axis = cross(e.tangent, f.tangent);
  const double cosine = dot(e.tangent, f.tangent);
  const Vec3 carried =
      cosine * e.normal + cross(axis, e.normal) + (dot(axis, e.normal) / (1.0 + cosine)) * axis;
  return arc_tangent(dot(cross(carried, f.normal), f.tangent), dot(carried, f.normal));
}

static Status take_edges(const Border& border, Array<LinkedEdge>* edges, bool* known) {
  constexpr double k_least_sine = 0.05, k_turns_back = -0.98;
  *known = true;
  for (uint32_t l = 0; l < border.loops(); ++l) {
    for (uint32_t i = border.start[l]; i < border.start[l + 1]; ++i) {
      const uint32_t j = next_on_border(border, l, i);
      const Vec3 tangent = unit(border.position[j] - border.position[i]);
      const Vec3 mean = reject(border.normal[i] + border.normal[j], tangent);
      *known = *known && border.normal[i] != Vec3{} && length(mean) > k_least_sine;
      TRY(edges->push({border.position[i], border.position[j], tangent, unit(mean), j}));
    }
  }
  for (const LinkedEdge& e : *edges) {
    *known = *known && dot(e.tangent, (*edges)[e.next].tangent) > k_turns_back;
  }
  return {};
}

Status linking_number(const Border& border, int32_t* number) {
  constexpr double k_near = 0.2;
  Context& context = border.vertex.context();
  Array<LinkedEdge> edges(context);
  bool known = false;
  *number = 0;
  TRY(take_edges(border, &edges, &known));
  if (!known) return {};
  double sum = 0.0;
  for (uint32_t i = 0; i < edges.size(); ++i) {
    for (uint32_t j = i + 1; j < edges.size(); ++j) {
      if (edges[i].next == j || edges[j].next == i) continue;
      sum += 2.0 * crossing_share(edges[i], edges[j]);
    }
    sum += twist_angle(edges[i], edges[edges[i].next]) / (2.0 * k_pi);
    if (i % 64 == 63) TRY(context.checkpoint());
  }
  const int32_t nearest = static_cast<int32_t>(sum < 0.0 ? sum - 0.5 : sum + 0.5);
  if (std::fabs(sum - nearest) < k_near) *number = nearest;
  return {};
}

}  // namespace wireskin::network
