#include "network/border_check.h"

#include "base/sort.h"
#include "network/linking.h"

namespace wireskin::network {

static double clamp_to_unit(double t) {
  return t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
}

// The square of the distance between the segments a b and c d.
static double segment_distance2(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const double determinant = uu * vv - uv * uv;
  const double s = determinant > 0.0 ? clamp_to_unit((uv * vw - vv * uw) / determinant) : 0.0;
  const double t = clamp_to_unit((uv * s + vw) / vv);  // nearest on c d to that point of a b
  const double again = clamp_to_unit((uv * t - uw) / uu);
  const Vec3 gap = (a + again * u) - (c + t * v);
  return dot(gap, gap);
}

static uint32_t widest_axis(Span<const Vec3> position) {
  uint32_t widest = 0;
  double most = -1.0;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Vec3& p : position) {
      const double at = coordinate(p, axis);
      low = at < low ? at : low;
      high = at > high ? at : high;
    }
    if (!(high - low > most)) continue;
    most = high - low;
    widest = axis;
  }
  return widest;
}

// Fails where two edges without a common end touch, to within a millionth of the border's length.
static Status find_crossing(const Border& border, double perimeter) {
  constexpr double k_touch = 1e-6;
  const Span<const Vec3> position = border.position.span();
  Array<uint32_t> next(border.vertex.context());
  TRY(next.resize(border.size()));
  for (uint32_t l = 0; l < border.loops(); ++l) {
    for (uint32_t i = border.start[l]; i < border.start[l + 1]; ++i) {
      next[i] = next_on_border(border, l, i);
    }
  }
  // Along the axis in which the border is widest an edge meets few others.
  const uint32_t axis = widest_axis(position);
  Array<uint32_t> order(border.vertex.context());
  TRY(order.resize(border.size()));
  for (uint32_t i = 0; i < border.size(); ++i) order[i] = i;
  const auto low = [&](uint32_t i) {
    const double from = coordinate(position[i], axis), to = coordinate(position[next[i]], axis);
    return from < to ? from : to;
  };
  sort(order.span(),
       [&](uint32_t a, uint32_t b) { return low(a) != low(b) ? low(a) < low(b) : a < b; });
  for (uint32_t k = 0; k < order.size(); ++k) {
    const uint32_t i = order[k];
    const Vec3 &a = position[i], &b = position[next[i]];
    const double own = length(b - a), beyond = low(i) + own + k_touch * perimeter;
    for (uint32_t m = k + 1; m < order.size() && low(order[m]) <= beyond; ++m) {
      const uint32_t j = order[m];
      if (j == next[i] || next[j] == i) continue;
      const Vec3 &c = position[j], &d = position[next[j]];
      if (length(c - a) > own + length(d - c) + k_touch * perimeter) continue;
      if (segment_distance2(a, b, c, d) <= k_touch * perimeter * (k_touch * perimeter)) {
        return fail(Code::patch_folded, "the border of the patch crosses itself");
      }
    }
    if (k % 64 == 63) TRY(next.context().checkpoint());
  }
  return {};
}

bool runs_clockwise(const Border& border) {
  const Vec3 area = 0.5 * vector_area(border);
  const double perimeter = border_length(border);
  // A disc of this perimeter has the area perimeter^2 / (4 pi); a fifth of that is no accident. The
  // larger part of a sphere runs clockwise, too, but its normals lean outwards.
  constexpr double k_least_cosine = -0.55;
  const double clear_area = perimeter * perimeter / 60.0;
  return length(area) > clear_area && dot(unit(area), mean_normal(border)) < k_least_cosine;
}

Status check_border(const Border& border) {
  if (runs_clockwise(border)) {
    return fail(
        Code::patch_without_plane,
        "the border runs clockwise round its normals: where a surface ends, its curves must be "
        "tagged as boundary");
  }
  TRY(find_crossing(border, border_length(border)));
  // One turn is what a border that passes over itself asks for; a sound surface takes it up, though
  // not all of the normals.
  int32_t linked = 0;
  TRY(linking_number(border, &linked));
  if (linked >= -1 && linked <= 1) return {};
  return fail(Code::patch_folded,
              "no two-sided surface without crossings has this border with these normals: it is "
              "one-sided, knotted, or a curve is missing");
}

}  // namespace wireskin::network
