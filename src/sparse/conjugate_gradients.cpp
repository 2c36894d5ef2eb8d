#include "sparse/conjugate_gradients.h"

#include <cfloat>
#include <cmath>

namespace wireskin::sparse {

static Status apply_symmetric(void* self, Span<const double> x, Span<double> y) {
  multiply_symmetric(*static_cast<const Csc*>(self), x, y, 1);
  return {};
}

LinearOperator symmetric_operator(const Csc& lower) {
  // The operator's `self` is not constant for the sake of others; this one only reads.
  return {&apply_symmetric, const_cast<Csc*>(&lower)};
}

static Status apply_inverse(void* self, Span<const double> x, Span<double> y) {
  for (size_t i = 0; i < x.size(); ++i) y[i] = x[i];
  return static_cast<Cholesky*>(self)->solve(y, 1);
}

LinearOperator inverse_operator(Cholesky& factor) {
  return {&apply_inverse, &factor};
}

Status Jacobi::build(const Csc& lower) {
  TRY(diagonal_.resize(lower.cols));
  for (uint32_t j = 0; j < lower.cols; ++j) diagonal_[j] = lower.value[lower.start[j]];
  return {};
}

Status Jacobi::apply(void* self, Span<const double> x, Span<double> y) {
  const Array<double>& diagonal = static_cast<const Jacobi*>(self)->diagonal_;
  for (size_t i = 0; i < x.size(); ++i) y[i] = x[i] / diagonal[i];
  return {};
}

static double dot(Span<const double> a, Span<const double> b) {
  double sum = 0.0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

static void add_multiple(Span<double> y, double factor, Span<const double> x) {
  for (size_t i = 0; i < y.size(); ++i) y[i] += factor * x[i];
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
  double rz_before = 0.0;
  for (bool first = true; *iterations < max_iterations; first = false) {
    TRY(context.checkpoint());
    TRY(s->preconditioner->apply(s->preconditioner->self, r, z));
    const double rz = dot(r, z);
    if (!is_positive(rz)) return break_down();
    const double beta = first ? 0.0 : rz / rz_before;
    for (size_t i = 0; i < p.size(); ++i) p[i] = first ? z[i] : z[i] + beta * p[i];
    TRY(s->a->apply(s->a->self, p, q));
    const double curvature = dot(p, q);
    if (!is_positive(curvature)) return break_down();
    const double alpha = rz / curvature;
    add_multiple(s->x, alpha, p);
    add_multiple(r, -alpha, q);
    rz_before = rz;
    ++*iterations;
    if (!(std::sqrt(dot(r, r)) > goal)) break;
  }
  return {};
}

static Status true_residual(CgState* s) {
  TRY(s->a->apply(s->a->self, s->x, s->r.span()));
  for (size_t i = 0; i < s->x.size(); ++i) s->r[i] = s->b[i] - s->r[i];
  return {};
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
  const double scale = std::sqrt(dot(b, b));
  if (scale == 0.0) {
    for (double& entry : x) entry = 0.0;
    result->converged = true;
    return {};
  }
  double before = 0.0;
  for (bool first = true;; first = false) {
    TRY(true_residual(&state));
    result->residual = std::sqrt(dot(state.r.span(), state.r.span())) / scale;
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
