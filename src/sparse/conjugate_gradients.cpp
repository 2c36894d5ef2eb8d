#include "sparse/conjugate_gradients.h"

#include <cfloat>
#include <cmath>

#include "base/in_parts.h"

namespace wireskin::sparse {

static Status apply_symmetric(void* self, Span<const double> x, Span<double> y) {
  return multiply_symmetric(*static_cast<const Csc*>(self), x, y, 1);
}

LinearOperator symmetric_operator(const Csc& lower) {
  // The operator's `self` is not constant for the sake of others; this one only reads.
  return {&apply_symmetric, const_cast<Csc*>(&lower)};
}

static Status apply_inverse(void* self, Span<const double> x, Span<double> y) {
  if (!x.empty()) std::memcpy(y.data(), x.data(), x.size() * sizeof(double));
  return static_cast<Cholesky*>(self)->solve(y, 1);
}

LinearOperator inverse_operator(Cholesky& factor) {
  return {&apply_inverse, &factor};
}

Status Jacobi::build(const Csc& lower) {
  TRY(diagonal_.resize(lower.cols));
  return in_parts(diagonal_.context(), lower.cols,
                  [&](size_t j) { diagonal_[j] = lower.value[lower.start[j]]; });
}

Status Jacobi::apply(void* self, Span<const double> x, Span<double> y) {
  const Array<double>& diagonal = static_cast<const Jacobi*>(self)->diagonal_;
  return in_parts(diagonal.context(), x.size(), [&](size_t i) { y[i] = x[i] / diagonal[i]; });
}

static Status dot(Context& context, Span<const double> a, Span<const double> b, double* result) {
  double sum = 0.0;
  TRY(in_parts(context, a.size(), [&](size_t i) { sum += a[i] * b[i]; }));
  *result = sum;
  return {};
}

static Status norm(Context& context, Span<const double> a, double* result) {
  TRY(dot(context, a, a, result));
  *result = std::sqrt(*result);
  return {};
}

static Status add_multiple(Context& context, Span<double> y, double factor, Span<const double> x) {
  return in_parts(context, y.size(), [&](size_t i) { y[i] += factor * x[i]; });
}

static bool is_positive(double value) {
  return value > 0.0 && value <= DBL_MAX;
}

static Status break_down() {
  return fail(Code::not_positive_definite, "conjugate gradients met non-positive curvature");
}

// The system and the vectors of the iteration.
struct CgState {
  const LinearOperator* a;
  const LinearOperator* preconditioner;
  Span<const double> b;
  Span<double> x;
  Array<double> r, z, p, q;  // residual, preconditioned residual, direction, A times direction

  CgState(Context& c, const LinearOperator& matrix, const LinearOperator& inverse,
          Span<const double> rhs, Span<double> start)
      : a(&matrix), preconditioner(&inverse), b(rhs), x(start), r(c), z(c), p(c), q(c) {}
};

// One run of the classical iteration from the residual in r, until the recurrence says |r| <= goal.
static Status iterate(Context& context, CgState* s, double goal, uint32_t max_iterations,
                      uint32_t* iterations) {
  const Span<double> r = s->r.span(), z = s->z.span(), p = s->p.span(), q = s->q.span();
  double rz = 0.0, rz_before = 0.0, curvature = 0.0, length = 0.0;
  for (bool first = true; *iterations < max_iterations; first = false) {
    TRY(context.checkpoint());
    TRY(s->preconditioner->apply(s->preconditioner->self, r, z));
    TRY(dot(context, r, z, &rz));
    if (!is_positive(rz)) return break_down();
    const double beta = first ? 0.0 : rz / rz_before;
    TRY(in_parts(context, p.size(), [&](size_t i) { p[i] = first ? z[i] : z[i] + beta * p[i]; }));
    TRY(s->a->apply(s->a->self, p, q));
    TRY(dot(context, p, q, &curvature));
    if (!is_positive(curvature)) return break_down();
    const double alpha = rz / curvature;
    TRY(add_multiple(context, s->x, alpha, p));
    TRY(add_multiple(context, r, -alpha, q));
    rz_before = rz;
    ++*iterations;
    TRY(norm(context, r, &length));
    if (!(length > goal)) break;
  }
  return {};
}

static Status true_residual(Context& context, CgState* s) {
  TRY(s->a->apply(s->a->self, s->x, s->r.span()));
  return in_parts(context, s->x.size(), [&](size_t i) { s->r[i] = s->b[i] - s->r[i]; });
}

Status conjugate_gradients(Context& context, const LinearOperator& a,
                           const LinearOperator& preconditioner, Span<const double> b,
                           Span<double> x, const CgOptions& options, CgResult* result) {
  WIRESKIN_ASSERT(b.size() == x.size());
  *result = {};
  CgState state(context, a, preconditioner, b, x);
  TRY(state.r.resize(b.size()));
  TRY(state.z.resize(b.size()));
  TRY(state.p.resize(b.size()));
  TRY(state.q.resize(b.size()));
  double scale = 0.0, length = 0.0;
  TRY(norm(context, b, &scale));
  if (scale == 0.0) {
    for (double& entry : x) entry = 0.0;
    result->converged = true;
    return {};
  }
  double before = 0.0;
  for (bool first = true;; first = false) {
    TRY(true_residual(context, &state));
    TRY(norm(context, state.r.span(), &length));
    result->residual = length / scale;
    if (!(result->residual <= DBL_MAX)) return break_down();
    result->converged = result->residual <= options.tolerance;
    if (result->converged || result->iterations >= options.max_iterations) return {};
    if (!first && result->residual > 0.5 * before) return {};
    before = result->residual;
    TRY(iterate(context, &state, options.tolerance * scale, options.max_iterations,
                &result->iterations));
  }
}

}  // namespace wireskin::sparse
