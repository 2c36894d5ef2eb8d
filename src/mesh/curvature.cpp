#include "mesh/curvature.h"

#include "base/in_parts.h"

namespace wireskin::mesh {

Status vertex_normals(Context& context, Span<const Vec3> positions, Span<const uint32_t> triangles,
                      Span<Vec3> normals) {
  for (Vec3& n : normals) n = Vec3{};
  TRY(in_parts(context, triangles.size() / 3, [&](size_t t) {
    const uint32_t* v = &triangles[3 * t];
    // Edge k runs from corner k to the next one.
    const Vec3 edge[3] = {positions[v[1]] - positions[v[0]], positions[v[2]] - positions[v[1]],
                          positions[v[0]] - positions[v[2]]};
    const double square[3] = {dot(edge[0], edge[0]), dot(edge[1], edge[1]), dot(edge[2], edge[2])};
    for (int k = 0; k < 3; ++k) {
      const int last = k == 0 ? 2 : k - 1;
      const double squares = square[k] * square[last];
      if (squares > 0.0) normals[v[k]] += (1.0 / squares) * cross(edge[k], -edge[last]);
    }
  }));
  return in_parts(context, normals.size(), [&](size_t v) { normals[v] = unit(normals[v]); });
}

namespace {

// What border vertices gather from their neighbours.
struct Mean {
  double sum;
  uint32_t count;
};

}  // namespace

// One pass over the edges: vertices without a value take the mean of those neighbours that have
// one.
static Status fill_from_neighbours(Context& context, Span<const uint32_t> triangles,
                                   Span<uint8_t> known, Span<Mean> mean, Span<double> values) {
  for (size_t v = 0; v < values.size(); ++v) {
    if (!known[v]) mean[v] = {0.0, 0};
  }
  TRY(in_parts(context, triangles.size() / 3, [&](size_t t) {
    const uint32_t* v = &triangles[3 * t];
    if (known[v[0]] == known[v[1]] && known[v[1]] == known[v[2]]) return;  // nearly all
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = v[k], b = v[k == 2 ? 0 : k + 1];
      if (known[a] == known[b]) continue;
      const uint32_t from = known[a] ? a : b, to = known[a] ? b : a;
      mean[to].sum += values[from];
      ++mean[to].count;
    }
  }));
  for (size_t v = 0; v < values.size(); ++v) {
    if (known[v] || mean[v].count == 0) continue;
    values[v] = mean[v].sum / static_cast<double>(mean[v].count);
    known[v] = 1;
  }
  return {};
}

Status fill_border(Context& context, Span<const uint32_t> triangles, Span<const uint8_t> on_border,
                   Span<double> values) {
  bool any = false;
  for (uint8_t border : on_border) any = any || border != 0;
  if (!any) return {};
  Array<uint8_t> known(context);
  Array<Mean> mean(context);
  TRY(known.resize(values.size()));
  TRY(mean.resize(values.size()));
  for (size_t v = 0; v < values.size(); ++v) known[v] = on_border[v] == 0;
  TRY(fill_from_neighbours(context, triangles, known.span(), mean.span(), values));
  return fill_from_neighbours(context, triangles, known.span(), mean.span(), values);
}

Status mean_curvature(Span<const Vec3> positions, Span<const Vec3> normals,
                      Span<const uint32_t> triangles, Span<const uint8_t> on_border,
                      Array<double>* curvature) {
  Context& context = curvature->context();
  const size_t n = positions.size();
  Array<double> area(context);
  TRY(assign_in_parts(n, 0.0, curvature));
  TRY(assign_in_parts(n, 0.0, &area));
  TRY(in_parts(context, triangles.size() / 3, [&](size_t t) {
    const uint32_t* v = &triangles[3 * t];
    const Vec3 normal = unit(normals[v[0]] + normals[v[1]] + normals[v[2]]);
    const Vec3 cross_edges =
        cross(positions[v[1]] - positions[v[0]], positions[v[2]] - positions[v[0]]);
    const double third = length(cross_edges) / 6.0;
    for (uint32_t k = 0; k < 3; ++k) {
      const Vec3 edge = positions[v[(k + 2) % 3]] - positions[v[(k + 1) % 3]];
      (*curvature)[v[k]] += dot(cross(normal, edge), normals[v[k]]);
      area[v[k]] += third;
    }
  }));
  TRY(in_parts(context, n, [&](size_t v) {
    const bool known = !on_border[v] && area[v] > 0.0;
    (*curvature)[v] = known ? (*curvature)[v] / (4.0 * area[v]) : 0.0;
  }));
  return fill_border(context, triangles, on_border, curvature->span());
}

}  // namespace wireskin::mesh
