#include "smooth/displace.h"

#include "base/in_parts.h"
#include "mesh/curvature.h"
#include "mesh/mesh.h"
#include "sparse/conjugate_gradients.h"
#include "sparse/nested_dissection.h"
#include "sparse/product.h"

namespace wireskin::smooth {

// The weight of the pull of h towards zero at bare vertices.
static constexpr double k_bare_pull = 1e-6;

// Row weights and right-hand side of the least squares problem.
struct MinimumVariation::WeightedRows {
  const sparse::Csc& rows;
  Span<const double> weight;
  Span<const double> rhs;
};

namespace {

// The mesh cut open along the curves: vertices on curves have a copy in every patch.
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

// The least squares problem min sum_r weight_r (target_r - (rows x)_r)^2, as an operator.
struct NormalEquations {
  const sparse::Csc& rows;
  Span<const double> weight;
  Array<double> image;  // of each row

  NormalEquations(Context& context, const sparse::Csc& r, Span<const double> w)
      : rows(r), weight(w), image(context) {}
};

}  // namespace

namespace {

// The edges of curves inside patches, as the other ends of those at each vertex.
struct InnerEdges {
  Array<uint32_t> start, other;

  explicit InnerEdges(Context& context) : start(context), other(context) {}
  Span<const uint32_t> operator[](uint32_t v) const {
    return start.empty() ? Span<const uint32_t>{}
                         : other.span().part(start[v], start[v + 1] - start[v]);
  }
};

}  // namespace

static Status list_inner_edges(const DisplaceInput& input, InnerEdges* edges) {
  const Span<const uint32_t> ends = input.inner_edge;
  if (ends.empty()) return {};
  TRY(assign_in_parts(input.position.size() + 1, 0, &edges->start));
  TRY(edges->other.resize(ends.size()));
  for (uint32_t v : ends) ++edges->start[v];
  starts_from_counts(edges->start.span());
  for (uint32_t i = 0; i < ends.size(); ++i) edges->other[edges->start[ends[i]]++] = ends[i ^ 1u];
  shift_starts_back(edges->start.span());
  return {};
}

// Gives the corners of v's fan that follow `corner` within its sector the same copy, turning one
// way round v: a sector ends at another patch and at an edge of a curve.
static void walk_sector(const DisplaceInput& input, Span<const uint32_t> fan,
                        Span<const uint32_t> cuts, uint32_t corner, bool forward,
                        SplitMesh* split) {
  const uint32_t copy = split->triangle[corner], patch = input.patch[corner / 3];
  for (bool going = true; going;) {
    const uint32_t edge = forward ? mesh::previous_half_edge(corner) : mesh::next_half_edge(corner);
    const uint32_t across = input.triangle[edge];
    for (uint32_t end : cuts) {
      if (end == across) return;
    }
    going = false;
    for (uint32_t c : fan) {
      const uint32_t side = forward ? mesh::next_half_edge(c) : mesh::previous_half_edge(c);
      const bool next = input.triangle[side] == across && input.patch[c / 3] == patch;
      if (!next || split->triangle[c] != k_none) continue;
      split->triangle[c] = copy;
      corner = c;
      going = true;
      break;
    }
  }
}

// Gives every corner its split vertex: free vertices keep theirs, the corners of a held vertex
// share one in each patch, those of a held vertex on a curve inside the patch one on each side.
static Status split_along_curves(const DisplaceInput& input, SplitMesh* split) {
  Context& context = split->origin.context();
  const uint32_t n = static_cast<uint32_t>(input.position.size());
  Array<uint32_t> start(context), corner(context);
  InnerEdges inner(context);
  TRY(mesh::find_corners(n, input.triangle, &start, &corner));
  TRY(list_inner_edges(input, &inner));
  TRY(assign_in_parts(input.triangle.size(), k_none, &split->triangle));
  TRY(split->origin.reserve(input.triangle.size()));
  TRY(in_parts(context, n, [&](size_t i) {
    const uint32_t v = static_cast<uint32_t>(i);
    const Span<const uint32_t> fan = corner.span().part(start[v], start[v + 1] - start[v]);
    // A soft vertex has an unknown, whose column takes no row twice.
    const Span<const uint32_t> cuts = input.held[v] ? inner[v] : Span<const uint32_t>{};
    for (uint32_t k = 0; k < fan.size(); ++k) {
      uint32_t& copy = split->triangle[fan[k]];
      for (uint32_t j = 0; j < k && copy == k_none && cuts.empty(); ++j) {
        const bool same = !input.on_curve[v] || input.patch[fan[j] / 3] == input.patch[fan[k] / 3];
        if (same) copy = split->triangle[fan[j]];
      }
      if (copy != k_none) continue;
      copy = static_cast<uint32_t>(split->origin.size());
      split->origin.push_reserved(v);
      if (cuts.empty()) continue;
      walk_sector(input, fan, cuts, fan[k], true, split);
      walk_sector(input, fan, cuts, fan[k], false, split);
    }
  }));
  split->vertices = static_cast<uint32_t>(split->origin.size());
  return {};
}

static Status add_rim_conormals(SplitMesh* split) {
  Context& context = split->origin.context();
  Array<uint32_t> twins(context);
  TRY(mesh::find_twins(split->vertices, split->triangle.span(), &twins));
  TRY(assign_in_parts(split->vertices, Vec3{}, &split->conormal));
  return in_parts(context, twins.size(), [&](size_t h) {
    if (twins[h] != k_none) return;
    const uint32_t next = mesh::next_half_edge(static_cast<uint32_t>(h));
    const uint32_t a = split->triangle[h], b = split->triangle[next];
    const Vec3 edge = split->position[b] - split->position[a];
    const Vec3 half = 0.5 * cross(edge, unit(split->normal[a] + split->normal[b]));
    split->conormal[a] += half;
    split->conormal[b] += half;
  });
}

static Status make_split_mesh(const DisplaceInput& input, Span<const Vec3> normal,
                              Span<const mesh::TriangleShape> shapes, SplitMesh* split) {
  Context& context = split->origin.context();
  TRY(split_along_curves(input, split));
  TRY(split->position.resize(split->vertices));
  TRY(split->normal.resize(split->vertices));
  TRY(split->area.resize(split->vertices));
  TRY(in_parts(context, split->vertices, [&](size_t r) {
    split->position[r] = input.position[split->origin[r]];
    split->normal[r] = normal[split->origin[r]];
  }));
  TRY(add_rim_conormals(split));
  TRY(mesh::mixed_voronoi_areas(context, split->triangle.span(), shapes, split->area.span()));
  return mesh::cotangent_laplacian(split->vertices, split->triangle.span(), shapes,
                                   &split->laplacian);
}

Status MinimumVariation::number_unknowns(Span<const uint8_t> held) {
  TRY(displacement_.resize(held.size()));
  TRY(curvature_.resize(held.size()));
  unknowns_ = 0;
  return in_parts(context_, held.size(), [&](size_t v) {
    displacement_[v] = held[v] ? k_none : unknowns_++;
    curvature_[v] = unknowns_++;
  });
}

// A column whose entries come from several patches, sorted by row.
static void sort_column(size_t first, sparse::Csc* matrix) {
  for (size_t i = first + 1; i < matrix->row.size(); ++i) {
    const uint32_t row = matrix->row[i];
    const double value = matrix->value[i];
    size_t hole = i;
    for (; hole > first && matrix->row[hole - 1] > row; --hole) {
      matrix->row[hole] = matrix->row[hole - 1];
      matrix->value[hole] = matrix->value[hole - 1];
    }
    matrix->row[hole] = row;
    matrix->value[hole] = value;
  }
}

// The integrated Laplacian of the displaced positions, on the split mesh, is asked to be -2 m h n,
// and h to have the least square Laplacian:
//   sum_r (g_r - (L u)_r - 2 m_r h_i(r))^2 / m_r + (c l)^4 h^T (Ls M^-1 Ls) h,
//   g_r = -<(L v)_r + c_r, n_i(r)>,
// and, where the curves foretell H on them (node_curvature.h), c l w (h - H)^2 more. There c_r is
// the conormal of the patch's rim, made from the curve's positions and the given normals: that is
// how these normals enter. Split rows are essential, merged ones never see them.
// The matrix: first the rows of the split mesh, then one row a vertex for the Laplacian of h, then
// one a vertex for the springs and one for the curvature foretold. Columns are the unknowns, u and
// h of a vertex next to each other.
Status MinimumVariation::make_rows(const DisplaceInput& input, const sparse::Csc& split_laplacian,
                                   Span<const double> split_area, Span<const uint32_t> origin,
                                   const sparse::Csc& laplacian, sparse::Csc* rows) const {
  const uint32_t n = laplacian.cols, split = split_laplacian.cols;
  rows->rows = split + 3 * n;
  rows->cols = unknowns_;
  const size_t most =
      split_laplacian.row.size() + laplacian.row.size() + size_t{split} + 2 * size_t{n};
  if (most >= k_none) return fail(Code::too_large, "the mesh is too large for 32-bit indices");
  TRY(rows->start.resize(size_t{unknowns_} + 1));
  TRY(rows->row.reserve(most));
  TRY(rows->value.reserve(most));
  const auto add = [&](uint32_t row, double value) {
    rows->row.push_reserved(row);
    rows->value.push_reserved(value);
  };
  uint32_t column = 0, first_copy = 0;  // split vertices are numbered along with their origins
  TRY(in_parts(context_, n, [&](size_t i) {
    const uint32_t v = static_cast<uint32_t>(i);
    uint32_t end_copy = first_copy;
    while (end_copy < split && origin[end_copy] == v) ++end_copy;
    if (displacement_[v] != k_none) {
      const size_t first = rows->row.size();
      rows->start[column++] = static_cast<uint32_t>(first);
      for (uint32_t copy = first_copy; copy < end_copy; ++copy) {
        for (uint32_t p = split_laplacian.start[copy]; p < split_laplacian.start[copy + 1]; ++p) {
          const uint32_t row = split_laplacian.row[p];
          if (!input.is_bare(origin[row])) add(row, split_laplacian.value[p]);
        }
      }
      sort_column(first, rows);
      add(split + n + v, 1.0);
    }
    rows->start[column++] = static_cast<uint32_t>(rows->row.size());
    for (uint32_t copy = first_copy; copy < end_copy; ++copy) add(copy, 2.0 * split_area[copy]);
    for (uint32_t p = laplacian.start[v]; p < laplacian.start[v + 1]; ++p) {
      add(split + laplacian.row[p], laplacian.value[p]);
    }
    add(split + 2 * n + v, 1.0);
    first_copy = end_copy;
  }));
  rows->start[column] = static_cast<uint32_t>(rows->row.size());
  return {};
}

// Row weights and right-hand side, g. On open borders the rows of the Laplacian of h are left out.
// Where a border's normal is not known it has no conormal: there that row stays, as the natural
// condition, and the first one's place is taken by a slight pull of h towards zero, without which a
// patch of no known normal at all could have any constant h.
static Status make_targets(const DisplaceInput& input, const SplitMesh& split,
                           Span<const double> area, Span<const Vec3> normal, Span<double> weight,
                           Span<double> target) {
  Context& context = split.origin.context();
  const double length2 = input.smoothing_length * input.smoothing_length;
  TRY(in_parts(context, split.vertices, [&](size_t r) {
    Vec3 sum = split.conormal[r];
    for (uint32_t p = split.laplacian.start[r]; p < split.laplacian.start[r + 1]; ++p) {
      sum += split.laplacian.value[p] * split.position[split.laplacian.row[p]];
    }
    weight[r] = 1.0 / split.area[r];
    target[r] = -dot(sum, split.normal[r]);
    if (input.is_bare(split.origin[r])) {
      weight[r] *= k_bare_pull;
      target[r] = 0.0;
    }
  }));
  const size_t n = area.size();
  return in_parts(context, n, [&](size_t v) {
    const bool left_out = input.on_border[v] && !input.is_bare(v);
    weight[split.vertices + v] = left_out ? 0.0 : length2 * length2 / area[v];
    target[split.vertices + v] = 0.0;
    const size_t r = split.vertices + n + v;
    const bool pulled = input.soft.any() && input.soft.cutoff[v] > 0.0;
    weight[r] =
        pulled ? length2 * length2 * spring(input.soft.share[v], input.soft.cutoff[v], 4) : 0.0;
    target[r] = pulled ? dot(input.soft.position[v] - input.position[v], normal[v]) : 0.0;
    const bool foretold = !input.foretold_weight.empty();
    weight[r + n] = foretold ? input.smoothing_length * input.foretold_weight[v] : 0.0;
    target[r + n] = foretold ? input.foretold_curvature[v] : 0.0;
  });
}

// y = rows^T diag(weight) rows x.
static Status apply_normal_equations(void* self, Span<const double> x, Span<double> y) {
  NormalEquations& equations = *static_cast<NormalEquations*>(self);
  const sparse::Csc& rows = equations.rows;
  const Span<double> image = equations.image.span();
  Context& context = equations.image.context();
  TRY(in_parts(context, image.size(), [&](size_t r) { image[r] = 0.0; }));
  TRY(in_parts(context, rows.cols, [&](size_t j) {
    for (uint32_t p = rows.start[j]; p < rows.start[j + 1]; ++p) {
      image[rows.row[p]] += rows.value[p] * x[j];
    }
  }));
  TRY(in_parts(context, image.size(), [&](size_t r) { image[r] *= equations.weight[r]; }));
  TRY(in_parts(context, rows.cols, [&](size_t j) {
    double sum = 0.0;
    for (uint32_t p = rows.start[j]; p < rows.start[j + 1]; ++p) {
      sum += rows.value[p] * image[rows.row[p]];
    }
    y[j] = sum;
  }));
  return context.checkpoint();
}

// Conjugate gradients from the last step's h, until the residual is what the size allows. What
// the iteration cannot do shows in the residual.
Status MinimumVariation::iterate(const WeightedRows& system,
                                 const sparse::LinearOperator& preconditioner, uint32_t most,
                                 Span<double> solution, uint32_t* iterations) {
  const double tolerance = unknowns_ <= 60000 ? 1e-12 : unknowns_ <= 600000 ? 1e-11 : 1e-10;
  sparse::CgResult result;
  NormalEquations equations(context_, system.rows, system.weight);
  TRY(equations.image.resize(system.rows.rows));
  TRY(context_.enter(Stage::solve));
  TRY(in_parts(context_, solution.size(),
               [&](size_t i) { solution[i] = start_.empty() ? 0.0 : start_[i]; }));
  const Status status =
      sparse::conjugate_gradients(context_, {apply_normal_equations, &equations}, preconditioner,
                                  system.rhs, solution, {tolerance, most}, &result);
  *iterations = result.iterations;
  residual_ = result.residual;
  return status.code == Code::not_positive_definite ? Status{} : status;
}

Status MinimumVariation::solve_by_old_factor(const WeightedRows& system, Span<double> solution,
                                             bool* solved) {
  // A factorisation costs as much as some ten to sixty solves, so what is nearly good is accepted.
  constexpr double k_good_enough = 1e-9;
  uint32_t iterations = 0;
  TRY(iterate(system, sparse::inverse_operator(factor_), 40, solution, &iterations));
  *solved = residual_ <= k_good_enough;
  iterations_ += iterations;
  return {};
}

// By vertices, so that u and h of a vertex stay together.
Status MinimumVariation::order_unknowns(const DisplaceInput& input, const sparse::Csc& matrix,
                                        Array<uint32_t>* order) const {
  Array<uint32_t> vertex(context_), patch(context_);
  TRY(vertex.reserve(unknowns_));
  TRY(assign_in_parts(input.position.size(), 0, &patch));
  TRY(in_parts(context_, displacement_.size(), [&](size_t v) {
    if (displacement_[v] != k_none) vertex.push_reserved(static_cast<uint32_t>(v));
    vertex.push_reserved(static_cast<uint32_t>(v));
  }));
  TRY(mesh::patches_of_vertices(context_, input.triangle, input.patch, patch.span()));
  return sparse::nested_dissection(matrix, {vertex.span(), input.position, patch.span()}, order);
}

static Status no_room_for_fairing() {
  return fail(Code::memory_cap,
              "the memory cap leaves no room for the factor of the fairing; `stanko` needs less");
}

Status MinimumVariation::solve_by_new_factor(const DisplaceInput& input, const WeightedRows& system,
                                             Span<double> solution) {
  const sparse::Csc& rows = system.rows;
  sparse::Csc transposed(context_), matrix(context_);
  Array<uint32_t> all(context_), order(context_);
  TRY(sparse::transpose(rows, &transposed));
  TRY(all.resize(rows.cols));
  TRY(in_parts(context_, rows.cols, [&](size_t j) { all[j] = static_cast<uint32_t>(j); }));
  TRY(sparse::weighted_product(transposed, system.weight, rows, all.span(), rows.cols,
                               sparse::Part::lower, &matrix));
  transposed.row.free();
  transposed.value.free();
  TRY(context_.enter(Stage::factor));
  TRY(order_unknowns(input, matrix, &order));
  TRY(factor_.analyse(matrix, order.span()));
  order.free();
  matrix.row.free();
  if (factor_.factor_bytes() > context_.room_bytes()) return no_room_for_fairing();
  Status factored = factor_.factor(matrix);
  factored.place = {};  // a column of ours means nothing to the caller
  TRY(factored);
  ++factorisations_;
  bool solved = false;
  TRY(solve_by_old_factor(system, solution, &solved));
  // Short of the tolerance the solution may still serve; one that is no number may not.
  if (!solved && !(residual_ < 1.0)) {
    return fail(Code::not_positive_definite,
                "the linear system cannot be solved in double precision");
  }
  return {};
}

// The preconditioner is made once, for the mesh of the first step that needs it.
Status MinimumVariation::solve_by_pairs(const DisplaceInput& input, const sparse::Csc& laplacian,
                                        Span<const double> area, const WeightedRows& system,
                                        Span<double> solution) {
  constexpr uint32_t k_most_iterations = 5000;
  constexpr double k_good_enough = 1e-6;
  if (!iterative_) {
    Array<uint32_t> patch(context_);
    TRY(assign_in_parts(input.position.size(), 0, &patch));
    TRY(mesh::patches_of_vertices(context_, input.triangle, input.patch, patch.span()));
    const size_t n = input.position.size(), springs = system.rows.rows - 2 * n;
    TRY(pairs_.build({laplacian,
                      area,
                      input.soft.any() ? system.weight.part(springs, n) : Span<const double>{},
                      displacement_.span(),
                      curvature_.span(),
                      input.smoothing_length,
                      {input.position, patch.span()}}));
    iterative_ = true;
  }
  uint32_t iterations = 0;
  TRY(iterate(system, pairs_.linear_operator(), k_most_iterations, solution, &iterations));
  context_.count_iterations(iterations);
  return residual_ <= k_good_enough ? Status{} : no_room_for_fairing();
}

Status MinimumVariation::solve(const DisplaceInput& input, Span<Vec3> normal, Span<double> step) {
  TRY(context_.enter(Stage::operators));
  const uint32_t n = static_cast<uint32_t>(input.position.size());
  Array<mesh::TriangleShape> shapes(context_);
  Array<double> area(context_), weight(context_), target(context_), rhs(context_),
      solution(context_);
  sparse::Csc laplacian(context_), rows(context_);
  SplitMesh split(context_);
  TRY(mesh::vertex_normals(context_, input.position, input.triangle, normal));
  TRY(in_parts(context_, n, [&](size_t v) {
    if (input.on_curve[v] && !input.is_bare(v)) normal[v] = input.curve_normal[v];
  }));
  TRY(mesh::triangle_shapes(input.position, input.triangle, &shapes));
  TRY(make_split_mesh(input, normal, shapes.span(), &split));
  TRY(context_.checkpoint());
  TRY(area.resize(n));
  TRY(mesh::mixed_voronoi_areas(context_, input.triangle, shapes.span(), area.span()));
  TRY(mesh::cotangent_laplacian(n, input.triangle, shapes.span(), &laplacian));
  TRY(number_unknowns(input.held));
  TRY(make_rows(input, split.laplacian, split.area.span(), split.origin.span(), laplacian, &rows));
  TRY(context_.checkpoint());
  TRY(weight.resize(rows.rows));
  TRY(target.resize(rows.rows));
  TRY(make_targets(input, split, area.span(), normal, weight.span(), target.span()));
  TRY(rhs.resize(unknowns_));
  TRY(solution.resize(unknowns_));
  TRY(in_parts(context_, unknowns_, [&](size_t j) {
    rhs[j] = 0.0;
    for (uint32_t p = rows.start[j]; p < rows.start[j + 1]; ++p) {
      rhs[j] += rows.value[p] * (weight[rows.row[p]] * target[rows.row[p]]);
    }
  }));
  TRY(context_.checkpoint());
  const WeightedRows system = {rows, weight.span(), rhs.span()};
  bool solved = false;
  if (factorisations_ > 0 && !iterative_) {
    TRY(solve_by_old_factor(system, solution.span(), &solved));
  }
  if (!solved && !iterative_) {
    const Status status = solve_by_new_factor(input, system, solution.span());
    solved = status.ok();
    if (status.code != Code::memory_cap) TRY(status);
  }
  if (!solved) {
    factor_ = sparse::Cholesky(context_);
    TRY(solve_by_pairs(input, laplacian, area.span(), system, solution.span()));
  }
  TRY(copy_in_parts(solution.span(), &start_));
  return in_parts(context_, n, [&](size_t v) {
    step[v] = input.held[v] ? 0.0 : solution[displacement_[v]];
    if (!input.held[v]) start_[displacement_[v]] = 0.0;
  });
}

}  // namespace wireskin::smooth
