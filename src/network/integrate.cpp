#include "network/integrate.h"

#include "base/in_parts.h"
#include "base/sort_in_parts.h"
#include "num/trig.h"
#include "sparse/cholesky.h"
#include "sparse/ordering.h"

namespace wireskin::network {

// The chord of the circular arc of that length between two tangents.
static Vec3 chord_of_arc(const Vec3& from, const Vec3& to, double arc) {
  const double sine = 0.5 * length(to - from);  // of half the turn
  const double half = arc_tangent(sine, 0.5 * length(to + from));
  const double shrink = half > 0.0 ? sine / half : 1.0;
  return (arc * shrink) * unit(to + from);
}

// From sample i - 1 of curve c to sample i.
static Vec3 measured_step(const SensorSamples& samples, size_t c, uint32_t i) {
  const double arc = samples.arc[i] - samples.arc[i - 1];
  const Vec3 &from = samples.tangent[i - 1], &to = samples.tangent[i];
  return samples.to_next[c] ? arc * from : chord_of_arc(from, to, arc);
}

static constexpr size_t k_steps_of_arc = 4;  // a step to measure takes as long as so many others

// One step between two different points, k_none in place of a fixed one.
struct Step {
  uint32_t low, high;
  double weight;
};

// The unknown of each point: the first point of every component is fixed.
static Status number_unknowns(Context& context, const SensorSamples& samples,
                              Array<uint32_t>* unknown, uint32_t* count) {
  DisjointSets sets(context);
  Pace pace(context);
  TRY(sets.reset(samples.points));
  TRY(unknown->resize(samples.points));
  for (size_t c = 0; c + 1 < samples.start.size(); ++c) {
    for (uint32_t i = samples.start[c] + 1; i < samples.start[c + 1]; ++i) {
      sets.unite(samples.point[i - 1], samples.point[i]);
      TRY(pace.after());
    }
  }
  *count = 0;
  return in_parts(context, samples.points, [&](size_t i) {
    const uint32_t p = static_cast<uint32_t>(i);
    (*unknown)[p] = sets.find(p) == p ? k_none : (*count)++;
  });
}

// The lower triangle of the weighted Laplacian; steps between the same two points add up.
static Status assemble_laplacian(Context& context, uint32_t n, Span<Step> steps,
                                 Span<const double> diagonal, sparse::Csc* matrix) {
  TRY(sort_in_parts(context, steps, [](const Step& p, const Step& q) {
    if (p.low != q.low) return p.low < q.low;
    return p.high != q.high ? p.high < q.high : p.weight < q.weight;
  }));
  matrix->rows = matrix->cols = n;
  TRY(matrix->start.resize(n + size_t{1}));
  TRY(matrix->row.reserve(n + steps.size()));
  TRY(matrix->value.reserve(n + steps.size()));
  size_t k = 0;
  Pace pace(context);
  for (uint32_t j = 0; j < n; ++j) {
    TRY(pace.after());
    matrix->start[j] = static_cast<uint32_t>(matrix->row.size());
    matrix->row.push_reserved(j);
    matrix->value.push_reserved(diagonal[j]);
    for (; k < steps.size() && steps[k].low == j; ++k) {
      TRY(pace.after());
      if (matrix->row.back() == steps[k].high) {
        matrix->value.back() -= steps[k].weight;
        continue;
      }
      matrix->row.push_reserved(steps[k].high);
      matrix->value.push_reserved(-steps[k].weight);
    }
  }
  matrix->start[n] = static_cast<uint32_t>(matrix->row.size());
  return {};
}

static Status solve_laplacian(Context& context, Span<Step> steps, Span<const double> diagonal,
                              Span<double> x) {
  const uint32_t n = static_cast<uint32_t>(diagonal.size());
  if (n == 0) return {};
  sparse::Csc matrix(context);
  sparse::Cholesky factor(context);
  Array<uint32_t> order(context);
  TRY(assemble_laplacian(context, n, steps, diagonal, &matrix));
  TRY(sparse::minimum_degree(matrix, &order));
  TRY(factor.analyse(matrix, order.span()));
  TRY(context.enter(Stage::factor));
  TRY(factor.factor(matrix));
  TRY(context.enter(Stage::solve));
  return factor.solve(x, 3);
}

Status integrate_tangents(Context& context, const SensorSamples& samples, Span<Vec3> position,
                          double* residual) {
  Array<uint32_t> unknown(context);
  Array<Step> steps(context);
  Array<double> diagonal(context), x(context);
  uint32_t n = 0;
  TRY(number_unknowns(context, samples, &unknown, &n));
  Pace pace(context);
  TRY(steps.reserve(samples.arc.size()));
  TRY(assign_in_parts(n, 0.0, &diagonal));
  TRY(assign_in_parts(size_t{3} * n, 0.0, &x));
  const auto add = [&](uint32_t u, const Vec3& v) {
    if (u == k_none) return;
    x[3 * u] += v.x, x[3 * u + 1] += v.y, x[3 * u + 2] += v.z;
  };
  for (size_t c = 0; c + 1 < samples.start.size(); ++c) {
    for (uint32_t i = samples.start[c] + 1; i < samples.start[c + 1]; ++i) {
      TRY(pace.after(k_steps_of_arc));
      const uint32_t a = unknown[samples.point[i - 1]], b = unknown[samples.point[i]];
      if (samples.point[i - 1] == samples.point[i]) continue;
      const double weight = 1.0 / (samples.arc[i] - samples.arc[i - 1]);
      const Vec3 pull = weight * measured_step(samples, c, i);
      add(a, -pull);
      add(b, pull);
      if (a != k_none) diagonal[a] += weight;
      if (b != k_none) diagonal[b] += weight;
      if (a == k_none || b == k_none) continue;
      steps.push_reserved({a < b ? a : b, a < b ? b : a, weight});
    }
  }
  TRY(solve_laplacian(context, steps.span(), diagonal.span(), x.span()));
  TRY(in_parts(context, position.size(), [&](size_t i) {
    const uint32_t u = unknown[samples.point[i]];
    position[i] = u == k_none ? Vec3{} : Vec3{x[3 * u], x[3 * u + 1], x[3 * u + 2]};
  }));
  double sum = 0.0, count = 0.0;
  for (size_t c = 0; c + 1 < samples.start.size(); ++c) {
    for (uint32_t i = samples.start[c] + 1; i < samples.start[c + 1]; ++i) {
      TRY(pace.after(k_steps_of_arc));
      const Vec3 misfit = position[i] - position[i - 1] - measured_step(samples, c, i);
      sum += dot(misfit, misfit);
      count += 1.0;
    }
  }
  *residual = count > 0.0 ? std::sqrt(sum / count) : 0.0;
  return {};
}

}  // namespace wireskin::network
