#include "smooth/displace.h"

#include "mesh/curvature.h"
#include "sparse/cholesky.h"
#include "sparse/ordering.h"
#include "sparse/product.h"

namespace wireskin::smooth {

namespace {

// The mesh cut open along the curves: held vertices have a copy in every patch.
struct SplitMesh {
  uint32_t vertices = 0;
  Array<uint32_t> triangle;
  Array<uint32_t> origin;  // the vertex that each split vertex is a copy of
  Array<Vec3> position;
  Array<Vec3> normal;
  Array<Vec3> conormal;  // integrated along the rim of each patch
  Array<double> area;
  sparse::Csc laplacian;

  explicit SplitMesh(Context& context)
      : triangle(context),
        origin(context),
        position(context),
        normal(context),
        conormal(context),
        area(context),
        laplacian(context) {}
};

// Columns of the least squares problem: the displacement (if free) and the curvature of each vertex
// stand together.
struct Unknowns {
  uint32_t count = 0;
  Array<uint32_t> displacement;  // k_none where held
  Array<uint32_t> curvature;

  explicit Unknowns(Context& context) : displacement(context), curvature(context) {}
};

}  // namespace

// Gives every corner its split vertex: free vertices keep theirs, the corners of a held vertex
// share one in each patch.
static Status split_along_curves(const DisplaceInput& input, SplitMesh* split) {
  Context& context = split->origin.context();
  const uint32_t n = static_cast<uint32_t>(input.position.size());
  Array<uint32_t> start(context), corner(context);
  TRY(mesh::find_corners(n, input.triangle, &start, &corner));
  TRY(split->triangle.resize(input.triangle.size()));
  TRY(split->origin.reserve(input.triangle.size()));
  for (uint32_t v = 0; v < n; ++v) {
    for (uint32_t k = start[v]; k < start[v + 1]; ++k) {
      const uint32_t patch = input.patch[corner[k] / 3];
      uint32_t copy = k_none;
      for (uint32_t j = start[v]; j < k && copy == k_none; ++j) {
        const bool same = !input.held[v] || input.patch[corner[j] / 3] == patch;
        if (same) copy = split->triangle[corner[j]];
      }
      if (copy == k_none) {
        copy = static_cast<uint32_t>(split->origin.size());
        split->origin.push_reserved(v);
      }
      split->triangle[corner[k]] = copy;
    }
  }
  split->vertices = static_cast<uint32_t>(split->origin.size());
  return {};
}

static Status add_rim_conormals(SplitMesh* split) {
  Array<uint32_t> twins(split->origin.context());
  TRY(mesh::find_twins(split->vertices, split->triangle.span(), &twins));
  TRY(split->conormal.assign(split->vertices, Vec3{}));
  for (uint32_t h = 0; h < twins.size(); ++h) {
    if (twins[h] != k_none) continue;
    const uint32_t a = split->triangle[h], b = split->triangle[mesh::next_half_edge(h)];
    const Vec3 edge = split->position[b] - split->position[a];
    const Vec3 half = 0.5 * cross(edge, unit(split->normal[a] + split->normal[b]));
    split->conormal[a] += half;
    split->conormal[b] += half;
  }
  return {};
}

static Status make_split_mesh(const DisplaceInput& input, Span<const Vec3> normal,
                              Span<const mesh::TriangleShape> shapes, SplitMesh* split) {
  TRY(split_along_curves(input, split));
  TRY(split->position.resize(split->vertices));
  TRY(split->normal.resize(split->vertices));
  TRY(split->area.resize(split->vertices));
  for (uint32_t r = 0; r < split->vertices; ++r) {
    split->position[r] = input.position[split->origin[r]];
    split->normal[r] = normal[split->origin[r]];
  }
  TRY(add_rim_conormals(split));
  mesh::mixed_voronoi_areas(split->triangle.span(), shapes, split->area.span());
  return mesh::cotangent_laplacian(split->vertices, split->triangle.span(), shapes,
                                   &split->laplacian);
}

static Status number_unknowns(Span<const uint8_t> held, Unknowns* unknowns) {
  TRY(unknowns->displacement.resize(held.size()));
  TRY(unknowns->curvature.resize(held.size()));
  for (size_t v = 0; v < held.size(); ++v) {
    unknowns->displacement[v] = held[v] ? k_none : unknowns->count++;
    unknowns->curvature[v] = unknowns->count++;
  }
  return {};
}

// The matrix of the least squares problem: first the rows of the split mesh, then one row a vertex
// for the Laplacian of h.
static Status make_rows(const SplitMesh& split, const sparse::Csc& laplacian,
                        const Unknowns& unknowns, sparse::Csc* rows) {
  Context& context = rows->start.context();
  const uint32_t n = laplacian.cols;
  Array<uint32_t> copies(context), first_copy(context);
  TRY(first_copy.assign(size_t{n} + 1, 0));
  for (uint32_t v : split.origin) ++first_copy[v];
  starts_from_counts(first_copy.span());
  rows->rows = split.vertices + n;
  rows->cols = unknowns.count;
  const size_t most = split.laplacian.row.size() + laplacian.row.size() + split.vertices;
  if (most >= k_none) return fail(Code::too_large, "the mesh is too large for 32-bit indices");
  TRY(rows->start.resize(size_t{unknowns.count} + 1));
  TRY(rows->row.reserve(most));
  TRY(rows->value.reserve(most));
  uint32_t column = 0;
  const auto add = [&](uint32_t row, double value) {
    rows->row.push_reserved(row);
    rows->value.push_reserved(value);
  };
  // Split vertices are numbered along with their origins, so those of v stand together.
  for (uint32_t v = 0; v < n; ++v) {
    const uint32_t r = first_copy[v];
    if (unknowns.displacement[v] != k_none) {
      rows->start[column++] = static_cast<uint32_t>(rows->row.size());
      for (uint32_t p = split.laplacian.start[r]; p < split.laplacian.start[r + 1]; ++p) {
        add(split.laplacian.row[p], split.laplacian.value[p]);
      }
    }
    rows->start[column++] = static_cast<uint32_t>(rows->row.size());
    for (uint32_t copy = r; copy < first_copy[v + 1]; ++copy) add(copy, 2.0 * split.area[copy]);
    for (uint32_t p = laplacian.start[v]; p < laplacian.start[v + 1]; ++p) {
      add(split.vertices + laplacian.row[p], laplacian.value[p]);
    }
  }
  rows->start[column] = static_cast<uint32_t>(rows->row.size());
  return {};
}

// Row weights and right-hand side, g in the header.
static void make_targets(const DisplaceInput& input, const SplitMesh& split,
                         Span<const double> area, Span<double> weight, Span<double> target) {
  const double length2 = input.smoothing_length * input.smoothing_length;
  for (uint32_t r = 0; r < split.vertices; ++r) {
    Vec3 sum = split.conormal[r];
    for (uint32_t p = split.laplacian.start[r]; p < split.laplacian.start[r + 1]; ++p) {
      sum += split.laplacian.value[p] * split.position[split.laplacian.row[p]];
    }
    weight[r] = 1.0 / split.area[r];
    target[r] = -dot(sum, split.normal[r]);
  }
  for (uint32_t v = 0; v < area.size(); ++v) {
    weight[split.vertices + v] = input.on_border[v] ? 0.0 : length2 * length2 / area[v];
    target[split.vertices + v] = 0.0;
  }
}

// Minimises sum_r weight_r (target_r - (rows x)_r)^2.
static Status least_squares(Context& context, const sparse::Csc& rows, Span<const double> weight,
                            Span<const double> target, Array<double>* solution, double* residual) {
  sparse::Csc transposed(context), matrix(context);
  sparse::Cholesky factor(context);
  Array<uint32_t> all(context), order(context);
  Array<double> rhs(context), left(context);
  TRY(sparse::transpose(rows, &transposed));
  TRY(all.resize(rows.cols));
  TRY(rhs.resize(rows.cols));
  TRY(left.resize(rows.cols));
  for (uint32_t j = 0; j < rows.cols; ++j) {
    all[j] = j;
    rhs[j] = 0.0;
    for (uint32_t p = rows.start[j]; p < rows.start[j + 1]; ++p) {
      rhs[j] += rows.value[p] * (weight[rows.row[p]] * target[rows.row[p]]);
    }
  }
  TRY(sparse::weighted_product(transposed, weight, rows, all.span(), rows.cols, sparse::Part::lower,
                               &matrix));
  TRY(context.enter(Stage::factor));
  TRY(sparse::minimum_degree(matrix, &order));
  TRY(factor.analyse(matrix, order.span()));
  TRY(factor.factor(matrix));
  TRY(context.enter(Stage::solve));
  TRY(solution->copy(rhs.span()));
  TRY(factor.solve(solution->span(), 1));
  for (int refinement = 0; refinement < 2; ++refinement) {
    sparse::multiply_symmetric(matrix, solution->span(), left.span(), 1);
    double whole = 0.0, missing = 0.0;
    for (uint32_t j = 0; j < rows.cols; ++j) {
      left[j] = rhs[j] - left[j];
      whole += rhs[j] * rhs[j];
      missing += left[j] * left[j];
    }
    *residual = whole > 0.0 ? std::sqrt(missing / whole) : 0.0;
    if (refinement == 1) break;
    TRY(factor.solve(left.span(), 1));
    for (uint32_t j = 0; j < rows.cols; ++j) (*solution)[j] += left[j];
  }
  return {};
}

Status displacements(Context& context, const DisplaceInput& input, Span<Vec3> normal,
                     Span<double> step, double* residual) {
  TRY(context.enter(Stage::operators));
  const uint32_t n = static_cast<uint32_t>(input.position.size());
  Array<mesh::TriangleShape> shapes(context);
  Array<double> area(context), weight(context), target(context), solution(context);
  sparse::Csc laplacian(context), rows(context);
  SplitMesh split(context);
  Unknowns unknowns(context);
  mesh::vertex_normals(input.position, input.triangle, normal);
  for (uint32_t v = 0; v < n; ++v) {
    if (input.held[v]) normal[v] = input.held_normal[v];
  }
  TRY(mesh::triangle_shapes(input.position, input.triangle, &shapes));
  TRY(make_split_mesh(input, normal, shapes.span(), &split));
  TRY(area.resize(n));
  mesh::mixed_voronoi_areas(input.triangle, shapes.span(), area.span());
  TRY(mesh::cotangent_laplacian(n, input.triangle, shapes.span(), &laplacian));
  TRY(number_unknowns(input.held, &unknowns));
  TRY(make_rows(split, laplacian, unknowns, &rows));
  TRY(weight.resize(rows.rows));
  TRY(target.resize(rows.rows));
  make_targets(input, split, area.span(), weight.span(), target.span());
  TRY(least_squares(context, rows, weight.span(), target.span(), &solution, residual));
  for (uint32_t v = 0; v < n; ++v) {
    step[v] = input.held[v] ? 0.0 : solution[unknowns.displacement[v]];
  }
  return {};
}

}  // namespace wireskin::smooth
