// Preconditioned conjugate gradients for A x = b with A symmetric positive definite. Matrix and
// preconditioner are operators without a type, so that a matrix, a factor of a nearby matrix or
// any product of them fit.
//
// In: b, a start in x. Out: x and the residual |b - A x| / |b|, computed from the final x and not
// from the recurrence: `converged` says that it is within the tolerance. Where the recurrence has
// drifted away from the truth the iteration starts again from x, as long as that helps. Reaching
// the limit of iterations is no failure. Non-positive curvature, or a value that is not finite, is
// `not_positive_definite`, and x is then the last iterate.
// Cost: per iteration one application of each operator and five passes over vectors of length n.
//
// Source: Magnus Hestenes, Eduard Stiefel, "Methods of Conjugate Gradients for Solving Linear
// Systems", 1952.
#pragma once

#include "sparse/cholesky.h"

namespace wireskin::sparse {

struct LinearOperator {
  Status (*apply)(void* self, Span<const double> x, Span<double> y);  // y = A x
  void* self;
};

struct CgOptions {
  double tolerance = 1e-10;  // of the relative residual
  uint32_t max_iterations = 1000;
};

struct CgResult {
  uint32_t iterations = 0;
  double residual = 0.0;
  bool converged = false;
};

// The operators refer to what they are made from, which must outlive them.
LinearOperator symmetric_operator(const Csc& lower);
LinearOperator inverse_operator(Cholesky& factor);

// Division by the diagonal of a matrix.
class Jacobi {
 public:
  explicit Jacobi(Context& context) : diagonal_(context) {}
  Status build(const Csc& lower);
  LinearOperator linear_operator() { return {&apply, this}; }

 private:
  static Status apply(void* self, Span<const double> x, Span<double> y);

  Array<double> diagonal_;
};

Status conjugate_gradients(Context& context, const LinearOperator& a,
                           const LinearOperator& preconditioner, Span<const double> b,
                           Span<double> x, const CgOptions& options, CgResult* result);

}  // namespace wireskin::sparse
