// One step of minimum variation: every free vertex moves along its normal by u so that the mean
// curvature of the surface is as smooth as it can be while the surface meets the normals given on
// the curves.
//
// Unknowns: a displacement u per free vertex and a mean curvature h per vertex, over the mesh split
// along the curves (a held vertex has one row in each patch that it touches, on each side of a
// curve). The rows stand at their function in displace.cpp. One factorisation of size 2 n; next
// steps solve similar systems by conjugate gradients with an old factor.
// Source: H. Moreton, C. Sequin, "Functional Optimization for Fair Surface Design", 1992 (minimum
// variation surfaces), linearised along the normals.
#pragma once

#include "mesh/operators.h"
#include "smooth/laplacian_pairs.h"
#include "smooth/soft.h"

namespace wireskin::smooth {

struct DisplaceInput {
  Span<const Vec3> position;
  Span<const Vec3> curve_normal;  // unit, of the vertices on curves
  Span<const uint32_t> triangle;
  Span<const uint32_t> patch;  // of each triangle
  Span<const uint8_t> on_curve;
  Span<const uint8_t> held;  // on a curve and not soft; the same in every step
  Span<const uint8_t> on_border;
  double smoothing_length = 0.0;  // c l above
  Soft soft = {};                 // adds (c l)^4 share / cutoff^7 (u - <a - v, n>)^2
  Span<const uint8_t> bare = {};  // held, on a border, normal not known; empty: none
  // Mean curvature as the nodes foretell it, and its weight, a length; empty: none.
  Span<const double> foretold_curvature = {}, foretold_weight = {};
  Span<const uint32_t> inner_edge = {};  // of curves inside patches, two vertices each

  bool is_bare(size_t v) const { return !bare.empty() && bare[v]; }
};

// Solves one step after the other. The systems of later steps differ little from the first, so its
// factor preconditions conjugate gradients for them, from the last step's h; only where these are
// slow is there a new one. Where the memory cap leaves no room for it, the preconditioner is that
// of laplacian_pairs.h, with some hundred iterations.
class MinimumVariation {
 public:
  explicit MinimumVariation(Context& context)
      : context_(context),
        factor_(context),
        pairs_(context),
        displacement_(context),
        curvature_(context),
        start_(context) {}

  // `normal`: out, the directions; `step`: out, u of every vertex, zero where held.
  Status solve(const DisplaceInput& input, Span<Vec3> normal, Span<double> step);

  double residual() const { return residual_; }  // of the last solve, |b - A x| / |b|
  uint32_t factorisations() const { return factorisations_; }
  // Of conjugate gradients after a factor, all steps together.
  uint32_t iterations() const { return iterations_; }

 private:
  struct WeightedRows;

  Status number_unknowns(Span<const uint8_t> held);
  Status make_rows(const DisplaceInput& input, const sparse::Csc& split_laplacian,
                   Span<const double> split_area, Span<const uint32_t> origin,
                   const sparse::Csc& laplacian, sparse::Csc* rows) const;
  Status iterate(const WeightedRows& system, const sparse::LinearOperator& preconditioner,
                 uint32_t most, Span<double> solution, uint32_t* iterations);
  Status solve_by_old_factor(const WeightedRows& system, Span<double> solution, bool* solved);
  Status order_unknowns(const DisplaceInput& input, const sparse::Csc& matrix,
                        Array<uint32_t>* order) const;
  Status solve_by_new_factor(const DisplaceInput& input, const WeightedRows& system,
                             Span<double> solution);
  Status solve_by_pairs(const DisplaceInput& input, const sparse::Csc& laplacian,
                        Span<const double> area, const WeightedRows& system, Span<double> solution);

  Context& context_;
  sparse::Cholesky factor_;
  LaplacianPairs pairs_;  // in its place where the memory cap forbids it
  bool iterative_ = false;
  Array<uint32_t> displacement_;  // number of each vertex's unknown u, k_none where held
  Array<uint32_t> curvature_;     // and of its unknown h, next to it
  Array<double> start_;           // the last solution with u = 0, or empty
  uint32_t unknowns_ = 0;
  uint32_t factorisations_ = 0;
  uint32_t iterations_ = 0;
  double residual_ = 0.0;
};

}  // namespace wireskin::smooth
