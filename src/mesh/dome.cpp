#include "mesh/dome.h"

#include "mesh/curvature.h"
#include "mesh/operators.h"
#include "sparse/cholesky.h"
#include "sparse/ordering.h"
#include "sparse/product.h"

namespace wireskin::mesh {

// Half the lengths of both rim edges at each loop vertex times the conormal there.
static Status integrate_conormals(const Loops& loops, Span<Vec3> flux, Span<double> weight) {
  for (uint32_t l = 0; l < loops.count(); ++l) {
    for (uint32_t v = loops.start[l]; v < loops.start[l + 1]; ++v) {
      const Vec3 along = loops.position[loops.next(l, v)] - loops.position[v];
      const Vec3 back = loops.position[loops.previous(l, v)] - loops.position[v];
      const Vec3 conormal = unit(cross(loops.normal[v], unit(along) - unit(back)));
      flux[v] = 0.5 * (length(along) + length(back)) * conormal;
      if (loops.normal[v] == Vec3{}) weight[v] = 0.0;
    }
  }
  return {};
}

// Of the loops in the mean, positive where they bend away from their normals.
static double normal_curvature(const Loops& loops) {
  double turning = 0.0, total = 0.0;
  for (uint32_t l = 0; l < loops.count(); ++l) {
    for (uint32_t v = loops.start[l]; v < loops.start[l + 1]; ++v) {
      const Vec3 along = loops.position[loops.next(l, v)] - loops.position[v];
      const Vec3 back = loops.position[loops.previous(l, v)] - loops.position[v];
      if (loops.normal[v] == Vec3{}) continue;
      turning -= dot(unit(along) + unit(back), loops.normal[v]);
      total += 0.5 * (length(along) + length(back));
    }
  }
  return total > 0.0 ? turning / total : 0.0;
}

// y = A x for a symmetric matrix with both halves stored: column j is row j.
static void multiply_points(const sparse::Csc& a, Span<const Vec3> x, Span<Vec3> y) {
  for (uint32_t j = 0; j < a.cols; ++j) {
    Vec3 sum;
    for (uint32_t p = a.start[j]; p < a.start[j + 1]; ++p) sum += a.value[p] * x[a.row[p]];
    y[j] = sum;
  }
}

Status raise_dome(Context& context, const Loops& loops, Span<const uint32_t> triangle,
                  Span<Vec3> position) {
  const uint32_t n = static_cast<uint32_t>(position.size());
  const uint32_t rim = loops.start[loops.count()];
  if (rim == n) return {};
  Array<TriangleShape> shape(context);
  sparse::Csc laplacian(context), matrix(context);
  sparse::Cholesky factor(context);
  Array<double> weight(context), solution(context);
  Array<Vec3> rest(context), image(context), normal(context);
  Array<uint32_t> unknown(context), order(context);
  TRY(triangle_shapes(position, triangle, &shape));
  TRY(cotangent_laplacian(n, triangle, shape.span(), &laplacian));
  TRY(weight.resize(n));
  TRY(unknown.resize(n));
  TRY(rest.resize(n));
  TRY(image.assign(n, Vec3{}));
  TRY(solution.resize(3 * size_t{n - rim}));
  TRY(normal.resize(n));
  mixed_voronoi_areas(triangle, shape.span(), weight.span());
  vertex_normals(position, triangle, normal.span());
  const double curvature = normal_curvature(loops) * (loops.count() == 1 ? 1.0 : 0.5);
  for (uint32_t v = 0; v < n; ++v) {
    normal[v] = -2.0 * curvature * weight[v] * (v < rim ? loops.normal[v] : normal[v]);
    weight[v] = 1.0 / weight[v];
    unknown[v] = v < rim ? k_none : v - rim;
    rest[v] = v < rim ? position[v] : Vec3{};
  }
  multiply_points(laplacian, rest.span(), image.span());
  for (Vec3& p : rest) p = Vec3{};
  TRY(integrate_conormals(loops, rest.span(), weight.span()));
  // The integrated Laplacian of a loop vertex is that of the mesh less the flux through the loop.
  for (uint32_t v = 0; v < n; ++v) rest[v] = weight[v] * (rest[v] + normal[v] - image[v]);
  multiply_points(laplacian, rest.span(), image.span());
  TRY(sparse::weighted_product(laplacian, weight.span(), laplacian, unknown.span(), n - rim,
                               sparse::Part::lower, &matrix));
  TRY(sparse::minimum_degree(matrix, &order));
  TRY(factor.analyse(matrix, order.span()));
  Status factored = factor.factor(matrix);
  factored.place = {};
  TRY(factored);
  for (uint32_t v = rim; v < n; ++v) {
    double* row = &solution[3 * size_t{v - rim}];
    row[0] = image[v].x, row[1] = image[v].y, row[2] = image[v].z;
  }
  TRY(factor.solve(solution.span(), 3));
  for (uint32_t v = rim; v < n; ++v) {
    const double* row = &solution[3 * size_t{v - rim}];
    position[v] = {row[0], row[1], row[2]};
  }
  return {};
}

}  // namespace wireskin::mesh
