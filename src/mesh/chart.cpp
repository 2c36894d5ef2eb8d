#include "mesh/chart.h"

#include "mesh/operators.h"
#include "num/minmax.h"
#include "num/predicates.h"
#include "sparse/cholesky.h"
#include "sparse/ordering.h"

namespace wireskin::mesh {

// Angles between 3 and 87 degrees count as they are.
static constexpr double k_least_cotangent = 0.05, k_greatest_cotangent = 20.0;
static constexpr double k_cotangent_of_fan = 0.577;

namespace {

// The mesh with its holes closed by fans, and which vertices the system moves.
struct ClosedChart {
  uint32_t vertices = 0;
  Array<uint32_t> triangle;
  Array<TriangleShape> shape;
  Array<uint32_t> unknown;
  uint32_t unknowns = 0;

  explicit ClosedChart(Context& context) : triangle(context), shape(context), unknown(context) {}
};

}  // namespace

static uint32_t next_of_loop(Span<const uint32_t> start, size_t loop, uint32_t v) {
  return v + 1 == start[loop + 1] ? start[loop] : v + 1;
}

static size_t longest_loop(Span<const uint32_t> start, Span<const Vec3> position) {
  size_t longest = 0;
  double greatest = -1.0;
  for (size_t l = 0; l + 1 < start.size(); ++l) {
    double sum = 0.0;
    for (uint32_t v = start[l]; v < start[l + 1]; ++v) {
      sum += length(position[next_of_loop(start, l, v)] - position[v]);
    }
    if (sum > greatest) {
      greatest = sum;
      longest = l;
    }
  }
  return longest;
}

// The point of the unit circle that is about this share of the way round: each quarter by its
// rational form.
static Vec2 on_circle(double share) {
  const double turn = 4.0 * share;
  const int quarter = turn < 1.0 ? 0 : turn < 2.0 ? 1 : turn < 3.0 ? 2 : 3;
  const double s = turn - quarter, scale = 1.0 / (1.0 + s * s);
  const double c = scale * (1.0 - s * s), d = scale * 2.0 * s;
  switch (quarter) {
    case 0:
      return {c, d};
    case 1:
      return {-d, c};
    case 2:
      return {-c, -d};
    default:
      return {d, -c};
  }
}

static void place_on_circle(Span<const uint32_t> start, size_t loop, Span<const Vec3> position,
                            Span<Vec2> flat) {
  const auto edge = [&](uint32_t v) {
    return length(position[next_of_loop(start, loop, v)] - position[v]);
  };
  double total = 0.0, passed = 0.0;
  for (uint32_t v = start[loop]; v < start[loop + 1]; ++v) total += edge(v);
  for (uint32_t v = start[loop]; v < start[loop + 1]; ++v) {
    flat[v] = on_circle(passed / total);
    passed += edge(v);
  }
}

static Status close_holes(Span<const uint32_t> start, size_t outer, Span<const Vec3> position,
                          Span<const uint32_t> triangle, ClosedChart* closed) {
  TRY(closed->triangle.copy(triangle));
  TRY(triangle_shapes(position, triangle, &closed->shape));
  for (TriangleShape& shape : closed->shape) {
    for (double& c : shape.cotangent) {
      c = smaller(larger(c, k_least_cotangent), k_greatest_cotangent);
    }
  }
  closed->vertices = static_cast<uint32_t>(position.size());
  TRY(closed->unknown.resize(position.size() + start.size() - 2));
  for (size_t l = 0; l + 1 < start.size(); ++l) {
    if (l == outer) continue;
    for (uint32_t v = start[l]; v < start[l + 1]; ++v) {
      TRY(closed->triangle.push(next_of_loop(start, l, v)));
      TRY(closed->triangle.push(v));
      TRY(closed->triangle.push(closed->vertices));
      constexpr double c = k_cotangent_of_fan;
      TRY(closed->shape.push({{c, c, c}, 1.0}));
    }
    ++closed->vertices;
  }
  for (uint32_t v = 0; v < closed->vertices; ++v) {
    const bool held = v >= start[outer] && v < start[outer + 1];
    closed->unknown[v] = held ? k_none : closed->unknowns++;
  }
  return {};
}

// The lower triangle of the system over the unknowns, and its two right-hand sides.
static Status chart_system(const sparse::Csc& laplacian, const ClosedChart& closed,
                           Span<const Vec2> flat, sparse::Csc* matrix, Array<double>* right) {
  matrix->rows = matrix->cols = closed.unknowns;
  TRY(right->assign(2 * size_t{closed.unknowns}, 0.0));
  TRY(matrix->start.push(0));
  for (uint32_t j = 0; j < closed.vertices; ++j) {
    const uint32_t column = closed.unknown[j];
    if (column == k_none) continue;
    for (uint32_t p = laplacian.start[j]; p < laplacian.start[j + 1]; ++p) {
      const uint32_t i = laplacian.row[p], row = closed.unknown[i];
      if (row == k_none) {
        (*right)[2 * size_t{column}] += laplacian.value[p] * flat[i].x;
        (*right)[2 * size_t{column} + 1] += laplacian.value[p] * flat[i].y;
      } else if (row >= column) {
        TRY(matrix->row.push(row));
        TRY(matrix->value.push(-laplacian.value[p]));
      }
    }
    TRY(matrix->start.push(static_cast<uint32_t>(matrix->row.size())));
  }
  return {};
}

static Status solve_chart(const ClosedChart& closed, Span<Vec2> flat) {
  Context& context = closed.triangle.context();
  sparse::Csc laplacian(context), matrix(context);
  sparse::Cholesky factor(context);
  Array<uint32_t> order(context);
  Array<double> right(context);
  TRY(cotangent_laplacian(closed.vertices, closed.triangle.span(), closed.shape.span(),
                          &laplacian));
  TRY(chart_system(laplacian, closed, flat, &matrix, &right));
  TRY(sparse::minimum_degree(matrix, &order));
  TRY(factor.analyse(matrix, order.span()));
  TRY(factor.factor(matrix));
  TRY(factor.solve(right.span(), 2));
  for (uint32_t v = 0; v < flat.size(); ++v) {
    const uint32_t u = closed.unknown[v];
    if (u != k_none) flat[v] = {right[2 * size_t{u}], right[2 * size_t{u} + 1]};
  }
  return {};
}

Status lay_flat(Context& context, Span<const uint32_t> start, Span<const Vec3> position,
                Span<const uint32_t> triangle, Array<Vec2>* flat) {
  ClosedChart closed(context);
  const size_t outer = longest_loop(start, position);
  TRY(flat->resize(position.size()));
  place_on_circle(start, outer, position, flat->span());
  TRY(close_holes(start, outer, position, triangle, &closed));
  if (closed.unknowns > 0) TRY(solve_chart(closed, flat->span()));
  for (size_t t = 0; t < triangle.size(); t += 3) {
    if (orient2d((*flat)[triangle[t]], (*flat)[triangle[t + 1]], (*flat)[triangle[t + 2]]) > 0.0)
      continue;
    return fail(Code::patch_folded,
                "no plane shows the patch without folds, and it is too long to be laid flat for "
                "the curves inside it");
  }
  return {};
}

}  // namespace wireskin::mesh
