#include "api/input.h"

#include "num/minmax.h"

namespace wireskin::api {

static bool has_nan(const Vec3& a) {
  return a.x != a.x || a.y != a.y || a.z != a.z;
}
static bool finite(const Vec3& a) {
  return a.x - a.x == 0.0 && a.y - a.y == 0.0 && a.z - a.z == 0.0;
}

double greatest_component(const Vec3& a) {
  const double x = std::fabs(a.x), y = std::fabs(a.y), z = std::fabs(a.z);
  const double xy = x > y ? x : y;
  return xy > z ? xy : z;
}

static Status check_finite(const Vec3& a, const char* not_a_number, const char* infinite,
                           const Place& place) {
  if (has_nan(a)) return fail(Code::not_a_number, not_a_number, place);
  if (!finite(a)) return fail(Code::infinite, infinite, place);
  return {};
}

Status read_position(const Rows& rows, size_t i, const Place& place, Vec3* position) {
  *position = rows[i];
  return check_finite(*position, "the position is not a number", "the position is infinite", place);
}

Status read_normal(const Rows& rows, size_t i, const Place& place, Vec3* normal) {
  const Vec3 given = rows[i];
  TRY(check_finite(given, "the normal is not a number", "the normal is infinite", place));
  const double greatest = greatest_component(given);
  if (greatest == 0.0) return fail(Code::zero_normal, "the normal has zero length", place);
  // Near one first, or the squares of very long and very short normals overflow and underflow.
  *normal = unit(Scale(-binary_exponent(greatest))(given));
  return {};
}

Status find_scale(Span<const Vec3> points, int* exponent) {
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y, p.z < low.z ? p.z : low.z};
    high = {p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y, p.z > high.z ? p.z : high.z};
  }
  const Vec3 extent = high - low;
  if (!finite(extent)) {
    return fail(Code::infinite, "the positions span more than a double can hold");
  }
  // Points that are all one place have no extent; how far out they lie serves as well.
  double greatest = greatest_component(extent);
  if (greatest == 0.0) greatest = greatest_component(points[0]);
  *exponent = greatest > 0.0 ? binary_exponent(greatest) : 0;
  // Products of several coordinates must not overflow; where they could, rounding has left nothing
  // of the shape long since.
  constexpr int k_most_exponent = 100;
  const double farthest = larger(greatest_component(low), greatest_component(high));
  if (farthest > 0.0 && binary_exponent(farthest) - *exponent > k_most_exponent) {
    return fail(Code::infinite,
                "the network lies more than 2^100 times its size from the origin: move it to the "
                "origin");
  }
  return {};
}

Status explain_rounding(const Status& status, Span<const Vec3> positions, double spacing) {
  constexpr double k_rounding = 1.0 / 4503599627370496.0, k_most = 1.0 / 1024.0;  // of the spacing
  const bool geometric =
      status.code == Code::zero_length_curve || status.code == Code::duplicate_samples ||
      status.code == Code::node_mismatch || status.code == Code::tangent_normal ||
      status.code == Code::patch_without_plane || status.code == Code::patch_folded ||
      status.code == Code::bad_mesh || status.code == Code::not_positive_definite ||
      status.code == Code::bad_argument;  // of flow/: the points span no volume
  if (!geometric || spacing == 0.0) return status;
  double farthest = 0.0;
  for (const Vec3& p : positions) {
    const double here = greatest_component(p);
    farthest = here > farthest ? here : farthest;
  }
  if (!(farthest * k_rounding > k_most * spacing)) return status;
  return fail(status.code,
              "the network lies so far from the origin that its positions are rounded too "
              "coarsely: move it to the origin",
              status.place);
}

}  // namespace wireskin::api
