#include "mesh/measure.h"

#include "base/in_parts.h"
#include "mesh/curvature.h"
#include "mesh/operators.h"
#include "num/trig.h"

namespace wireskin::mesh {

static constexpr double k_degrees = 180.0 / k_pi;

namespace {

// A mean and a maximum under way.
struct AngleSum {
  double sum = 0.0;
  double greatest = 0.0;
  size_t count = 0;

  void add(double angle) {
    sum += angle;
    ++count;
    if (angle > greatest) greatest = angle;
  }
  AngleStatistics statistics() const {
    if (count == 0) return {};
    return {k_degrees * (sum / static_cast<double>(count)), k_degrees * greatest};
  }
};

}  // namespace

Status gaussian_curvature(Span<const Vec3> positions, Span<const uint32_t> triangles,
                          Span<const uint8_t> on_border, Array<double>* curvature) {
  Context& context = curvature->context();
  const size_t n = positions.size();
  Array<double> area(context);
  TRY(assign_in_parts(n, 2.0 * k_pi, curvature));
  TRY(assign_in_parts(n, 0.0, &area));
  TRY(in_parts(context, triangles.size() / 3, [&](size_t t) {
    const uint32_t* v = &triangles[3 * t];
    const TriangleShape shape = triangle_shape(positions[v[0]], positions[v[1]], positions[v[2]]);
    const CornerAreas shares = mixed_voronoi_shares(shape);
    for (int k = 0; k < 3; ++k) {
      area[v[k]] += shares.at[k];
      // The cotangent of the angle is known: arctan2(1, cot) is the angle.
      (*curvature)[v[k]] -= arc_tangent(1.0, shape.cotangent[k]);
    }
  }));
  TRY(in_parts(context, n, [&](size_t v) {
    (*curvature)[v] = !on_border[v] && area[v] > 0.0 ? (*curvature)[v] / area[v] : 0.0;
  }));
  return fill_border(context, triangles, on_border, curvature->span());
}

Status normal_deviation(Context& context, Span<const Vec3> normals, Span<const Vec3> given,
                        AngleStatistics* deviation) {
  AngleSum sum;
  TRY(in_parts(context, normals.size(), [&](size_t v) {
    if (dot(given[v], given[v]) > 0.0) sum.add(angle_between(normals[v], given[v]));
  }));
  *deviation = sum.statistics();
  return {};
}

Status dihedral_angles(Context& context, Span<const Vec3> positions, Span<const uint32_t> triangles,
                       Span<const uint32_t> patch, Span<const uint8_t> on_curve, bool divided,
                       AngleStatistics* dihedral) {
  // Edges of curves have both ends on curves, and so have their triangles: the others are left out.
  Array<uint32_t> twins(context), corner(context), own_patch(context);
  Pace pace(context);
  for (size_t t = 0; 3 * t < triangles.size(); ++t) {
    TRY(pace.after());
    const uint32_t* v = &triangles[3 * t];
    if (on_curve[v[0]] + on_curve[v[1]] + on_curve[v[2]] < 2) continue;
    for (size_t k = 0; k < 3; ++k) TRY(corner.push(v[k]));
    TRY(own_patch.push(patch[t]));
  }
  TRY(find_twins(static_cast<uint32_t>(positions.size()), corner.span(), &twins));
  const auto face = [&](uint32_t h) {
    const uint32_t* v = &corner[h / 3 * 3];
    return cross(positions[v[1]] - positions[v[0]], positions[v[2]] - positions[v[0]]);
  };
  AngleSum sum;
  for (uint32_t h = 0; h < twins.size(); ++h) {
    const uint32_t g = twins[h];
    if (g == k_none || g < h || (divided && own_patch[h / 3] == own_patch[g / 3])) continue;
    if (!on_curve[corner[h]] || !on_curve[corner[next_half_edge(h)]]) continue;
    sum.add(angle_between(face(h), face(g)));
  }
  *dihedral = sum.statistics();
  return {};
}

}  // namespace wireskin::mesh
