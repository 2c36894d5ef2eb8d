#include "network/plane.h"

#include "num/scale.h"

namespace wireskin::network {

// The mean of unit normals must be at least this long for its direction to mean anything.
static constexpr double k_least_mean_normal = 0.05;

Plane plane_across(const Border& border, const Vec3& normal) {
  Plane plane;
  const double share = 1.0 / static_cast<double>(border.size());
  for (const Vec3& p : border.position) plane.origin += share * p;
  plane.normal = normal;
  // What is left of a vector nearly along the normal is rounding and may point anywhere.
  constexpr double k_least_sine = 1e-3;
  const Vec3 first = border.position[0] - plane.origin;
  Vec3 axis = reject(first, normal);
  if (!(dot(axis, axis) > k_least_sine * k_least_sine * dot(first, first))) {
    axis = reject(std::fabs(normal.x) > 0.8 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, normal);
  }
  plane.u = unit(axis);
  plane.v = cross(normal, plane.u);
  return plane;
}

Status fit_plane(const Border& border, Plane* plane) {
  Vec3 normal;
  const double share = 1.0 / static_cast<double>(border.size());
  size_t count = 0;
  for (const Vec3& n : border.normal) {
    normal += share * n;
    count += n != Vec3{};
  }
  if (count == 0) {
    normal = unit(vector_area(border));
    count = border.size();
  }
  if (!(length(normal) >= k_least_mean_normal * share * static_cast<double>(count))) {
    return fail(Code::patch_without_plane,
                "the normals of the patch's border cancel out, so it has no plane");
  }
  *plane = plane_across(border, unit(normal));
  return {};
}

static double nearest_multiple(double x, const Scale& to_grid, const Scale& from_grid) {
  const double steps = to_grid(x);
  return from_grid(
      static_cast<double>(static_cast<int64_t>(steps < 0.0 ? steps - 0.5 : steps + 0.5)));
}

void round_to_grid(Span<Vec2> polygon, double* spacing) {
  constexpr int k_bits = 32;
  double extent = 0.0;
  for (const Vec2& p : polygon) {
    const double x = std::fabs(p.x), y = std::fabs(p.y);
    extent = x > extent ? x : extent;
    extent = y > extent ? y : extent;
  }
  if (!(extent > 0.0) || !(*spacing < 16.0 * extent)) return;
  const int exponent = binary_exponent(extent);
  const Scale to_grid(k_bits - exponent), from_grid(exponent - k_bits);
  for (Vec2& p : polygon) {
    p = {nearest_multiple(p.x, to_grid, from_grid), nearest_multiple(p.y, to_grid, from_grid)};
  }
  const double rounded = nearest_multiple(*spacing, to_grid, from_grid);
  if (rounded > 0.0) *spacing = rounded;
}

}  // namespace wireskin::network
