#include "mesh/dome.h"

#include "mesh/curvature.h"
#include "mesh/operators.h"
#include "num/minmax.h"
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

namespace {

// A mesh's Laplacian and the systems of least bending made from it.
struct Bending {
  sparse::Csc laplacian;
  Array<double> weight;     // of each vertex, the inverse of its area
  Array<uint32_t> unknown;  // of each vertex, k_none where held
  Array<Vec3> target;       // of each vertex: what its integrated Laplacian should be

  explicit Bending(Context& context)
      : laplacian(context), weight(context), unknown(context), target(context) {}
};

}  // namespace

static Status take_mesh(Span<const Vec3> position, Span<const uint32_t> triangle, uint32_t held,
                        Bending* bending) {
  const uint32_t n = static_cast<uint32_t>(position.size());
  Context& context = bending->weight.context();
  Array<TriangleShape> shape(context);
  TRY(triangle_shapes(position, triangle, &shape));
  TRY(cotangent_laplacian(n, triangle, shape.span(), &bending->laplacian));
  TRY(bending->weight.resize(n));
  TRY(bending->unknown.resize(n));
  TRY(bending->target.assign(n, Vec3{}));
  TRY(mixed_voronoi_areas(context, triangle, shape.span(), bending->weight.span()));
  for (uint32_t v = 0; v < n; ++v) bending->unknown[v] = v < held ? k_none : v - held;
  return {};
}

// Solves for the field whose Laplacian comes nearest to the target; `field` is given where held.
static Status bend_least(const Bending& bending, uint32_t held, Span<Vec3> field) {
  Context& context = bending.weight.context();
  const uint32_t n = static_cast<uint32_t>(field.size());
  sparse::Csc matrix(context);
  sparse::Cholesky factor(context);
  Array<double> solution(context);
  Array<Vec3> rest(context), image(context);
  Array<uint32_t> order(context);
  TRY(rest.assign(n, Vec3{}));
  TRY(image.resize(n));
  TRY(solution.resize(3 * size_t{n - held}));
  for (uint32_t v = 0; v < held; ++v) rest[v] = field[v];
  multiply_points(bending.laplacian, rest.span(), image.span());
  for (uint32_t v = 0; v < n; ++v) rest[v] = bending.weight[v] * (bending.target[v] - image[v]);
  multiply_points(bending.laplacian, rest.span(), image.span());
  TRY(sparse::weighted_product(bending.laplacian, bending.weight.span(), bending.laplacian,
                               bending.unknown.span(), n - held, sparse::Part::lower, &matrix));
  TRY(sparse::minimum_degree(matrix, &order));
  TRY(factor.analyse(matrix, order.span()));
  Status factored = factor.factor(matrix);
  factored.place = {};
  TRY(factored);
  for (uint32_t v = held; v < n; ++v) {
    double* row = &solution[3 * size_t{v - held}];
    row[0] = image[v].x, row[1] = image[v].y, row[2] = image[v].z;
  }
  TRY(factor.solve(solution.span(), 3));
  for (uint32_t v = held; v < n; ++v) {
    const double* row = &solution[3 * size_t{v - held}];
    field[v] = {row[0], row[1], row[2]};
  }
  return {};
}

Status raise_dome(Context& context, const Loops& loops, uint32_t held,
                  Span<const uint32_t> triangle, Span<Vec3> position) {
  const uint32_t n = static_cast<uint32_t>(position.size());
  const uint32_t rim = loops.start[loops.count()];
  if (held == n) return {};
  Bending bending(context);
  Array<Vec3> normal(context);
  TRY(take_mesh(position, triangle, held, &bending));
  TRY(normal.resize(n));
  TRY(vertex_normals(context, position, triangle, normal.span()));
  const double curvature = normal_curvature(loops) * (loops.count() == 1 ? 1.0 : 0.5);
  for (uint32_t v = 0; v < n; ++v) {
    normal[v] = -2.0 * curvature * bending.weight[v] * (v < rim ? loops.normal[v] : normal[v]);
    bending.weight[v] = 1.0 / bending.weight[v];
  }
  // The integrated Laplacian of a loop vertex is that of the mesh less the flux through the loop.
  TRY(integrate_conormals(loops, bending.target.span(), bending.weight.span()));
  for (uint32_t v = 0; v < n; ++v) bending.target[v] += normal[v];
  return bend_least(bending, held, position);
}

// Takes back a field that grew to many times what it spreads from: that is no shape, but needles
// over which second differences are next to nothing.
static void take_back_overgrown(uint32_t held, Span<Vec3> shift) {
  constexpr double k_most_growth = 100.0;
  double given = 0.0, spread = 0.0;
  for (uint32_t v = 0; v < shift.size(); ++v) {
    double& greatest = v < held ? given : spread;
    greatest = larger(greatest, length(shift[v]));
  }
  if (spread <= k_most_growth * given) return;
  for (uint32_t v = held; v < shift.size(); ++v) shift[v] = Vec3{};
}

Status spread_shift(Context& context, uint32_t held, Span<const Vec3> position,
                    Span<const uint32_t> triangle, Span<Vec3> shift) {
  if (held == position.size()) return {};
  Bending bending(context);
  TRY(take_mesh(position, triangle, held, &bending));
  for (double& weight : bending.weight) weight = 1.0 / weight;
  const Status status = bend_least(bending, held, shift);
  if (status.code == Code::not_positive_definite) return {};
  TRY(status);
  take_back_overgrown(held, shift);
  return {};
}

}  // namespace wireskin::mesh
