// The linear systems of variational smoothing: vertex values that minimise the weighted square of
// their Laplacian, with some vertices held.
//
// L is the integrated cotangent Laplacian, w the inverse vertex areas, or 0 to leave a row out.
// Order 1 minimises the Dirichlet energy, with the matrix -L; order 2 sum_r w_r |(L v)_r - T_r|^2
// over the free values, with K = L W L; order 3 the Dirichlet energy of W L v, with L W (-L) W L. K
// is positive definite when every component holds a vertex and the free rows stay in. One factor
// serves any number of fields; new weights keep the symbolic analysis. Where the factor of K would
// not fit under the memory cap, conjugate gradients take its place, preconditioned by the inverse
// of L_ff W^-1 L_ff (laplacian_pairs.h, a quarter of K's factor; order 1 has no way out). Cost: see
// sparse/cholesky.h. Source: M. Botsch, L. Kobbelt, "An Intuitive Framework for Real-Time Freeform
// Modeling", 2004.
#pragma once

#include "num/vec.h"
#include "sparse/conjugate_gradients.h"

namespace wireskin::smooth {

enum class Order { one = 1, two = 2, three = 3 };

// Roughly where each vertex stands in space, and its patch (any of several); or nothing.
struct Places {
  Span<const Vec3> position;
  Span<const uint32_t> patch;
};

// One vector field to solve for. In: the held values, the target of every row (empty: zero), and
// where penalties draw to. Out: the free values.
struct Field3 {
  Span<const Vec3> target;
  Span<const Vec3> anchor;
  Span<Vec3> value;
};

class System {
 public:
  explicit System(Context& context)
      : place_(context),
        patch_(context),
        unknown_(context),
        matrix_(context),
        factor_(context),
        weight_(context),
        penalty_(context),
        block_(context) {}

  // `laplacian` must outlive the system. Numbers the unknowns. Where the vertices stand decides
  // nothing but the order of elimination; without it that is general and slower.
  Status prepare(const sparse::Csc& laplacian, Span<const uint8_t> fixed, Order order,
                 const Places& places = {});
  // Assembles and factors with these row weights, and a penalty for each vertex (empty: none); may
  // be called again unless this is the `last` time, which saves memory.
  Status factor(Span<const double> weight, Span<const double> penalty, bool last = false);
  // `residual`: the greatest relative residual of all columns, after one step of refinement where
  // needed.
  Status solve(Span<const Field3> fields, double* residual);
  Status solve(Span<const Vec3> target, Span<const Vec3> anchor, Span<Vec3> value,
               double* residual) {
    const Field3 field = {target, anchor, value};
    return solve({&field, 1}, residual);
  }

 private:
  Status find_gradients(Span<const Field3> fields, double* squares);
  Status add_solutions(Span<const Field3> fields) const;
  Status add_penalties();
  Status find_order(const sparse::Csc& matrix, Array<uint32_t>* order) const;
  Status analyse();
  Status prepare_iteration();
  Status iterate(size_t columns);
  static Status apply_laplacian_inverses(void* self, Span<const double> x, Span<double> y);

  const sparse::Csc* laplacian_ = nullptr;
  Order order_ = Order::two;
  bool analysed_ = false;
  bool iterative_ = false;  // factor_ is that of S - L_ff, S from the penalties
  uint32_t unknowns_ = 0;
  Array<Vec3> place_;  // of each unknown until the order is found, or empty
  Array<uint32_t> patch_;
  Array<uint32_t> unknown_;  // number of each vertex among the unknowns, k_none where held
  sparse::Csc matrix_;
  sparse::Cholesky factor_;
  Array<double> weight_;
  Array<double> penalty_;  // of each vertex, or empty
  Array<double> block_;    // right-hand sides, then solutions: three columns a field, row by row
};

}  // namespace wireskin::smooth
