#include "network/border.h"

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

// Fails where two edges without a common end touch, to within a millionth of the border's length.
static Status find_crossing(Context& context, Span<const Vec3> position, double perimeter) {
  constexpr double k_touch = 1e-6;
  const size_t n = position.size();
  for (size_t i = 0; i < n; ++i) {
    const Vec3 &a = position[i], &b = position[i + 1 < n ? i + 1 : 0];
    const double own = length(b - a);
    for (size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      const Vec3 &c = position[j], &d = position[j + 1 < n ? j + 1 : 0];
      if (length(c - a) > own + length(d - c) + k_touch * perimeter) continue;
      if (segment_distance2(a, b, c, d) <= k_touch * perimeter * (k_touch * perimeter)) {
        return fail(Code::patch_folded, "the border of the patch crosses itself");
      }
    }
    if (i % 64 == 63) TRY(context.checkpoint());
  }
  return {};
}

Status check_border(Context& context, Span<const Vec3> position, Span<const Vec3> normal) {
  const size_t n = position.size();
  Vec3 area, normals;
  double perimeter = 0.0;
  for (size_t i = 0; i < n; ++i) {
    const Vec3& next = position[i + 1 < n ? i + 1 : 0];
    area += 0.5 * cross(position[i] - position[0], next - position[0]);
    normals += (1.0 / static_cast<double>(n)) * normal[i];
    perimeter += length(next - position[i]);
  }
  // A disc of this perimeter has the area perimeter^2 / (4 pi); a fifth of that is no accident.
  const double clear_area = perimeter * perimeter / 60.0;
  const bool clear_normals = length(normals) > 0.5;
  if (clear_normals && dot(area, unit(normals)) < -clear_area) {
    return fail(
        Code::patch_without_plane,
        "the border runs clockwise round its normals: where a surface ends, its curves must be "
        "tagged as boundary");
  }
  return find_crossing(context, position, perimeter);
}

}  // namespace wireskin::network
