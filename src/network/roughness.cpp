#include "network/roughness.h"

#include "base/in_parts.h"
#include "base/sort_in_parts.h"
#include "sparse/ordering.h"
#include "sparse/product.h"

namespace wireskin::network {

static constexpr size_t k_steps_of_row = 4;  // of some fourteen columns

// One curve's part of the kept samples.
struct KeptCurve {
  uint32_t first_kept;
  uint32_t count;
  uint32_t first_sample;
  bool closed;

  uint32_t after(uint32_t k) const { return k + 1 == count ? 0 : k + 1; }
  uint32_t before(uint32_t k) const { return k == 0 ? count - 1 : k - 1; }
  bool is_end(uint32_t k) const { return !closed && (k == 0 || k + 1 == count); }
};

static KeptCurve kept_curve(const KeptSamples& samples, size_t curve) {
  const uint32_t first = samples.kept_start[curve];
  return {first, samples.kept_start[curve + 1] - first, samples.start[curve],
          samples.closed[curve] != 0};
}

static uint32_t sample_of(const KeptSamples& samples, const KeptCurve& curve, uint32_t k) {
  return curve.first_sample + samples.kept[curve.first_kept + k];
}

// One pass of the mask 1/4, 1/2, 1/4 over the points of a curve; ends stay.
static Status filter_points(const KeptCurve& curve, Span<const Vec3> from, Pace* pace,
                            Span<Vec3> to) {
  for (uint32_t k = 0; k < curve.count; ++k) {
    TRY(pace->after());
    to[k] = from[k];
    if (curve.is_end(k)) continue;
    to[k] = 0.25 * (from[curve.before(k)] + from[curve.after(k)]) + 0.5 * from[k];
  }
  return {};
}

// The distance of each kept sample to the next one of its curve; zero after the end of an open one.
Status Roughness::measure_gaps(const KeptSamples& samples, bool filtered, Array<double>* gaps) {
  constexpr int k_filter_passes = 4;
  Array<Vec3> points(gaps->context()), work(gaps->context());
  TRY(points.resize(samples.kept.size()));
  TRY(work.resize(samples.kept.size()));
  TRY(gaps->resize(samples.kept.size()));
  for (size_t c = 0; c < samples.closed.size(); ++c) {
    const KeptCurve curve = kept_curve(samples, c);
    const Span<Vec3> p = points.span().part(curve.first_kept, curve.count);
    const Span<Vec3> q = work.span().part(curve.first_kept, curve.count);
    for (uint32_t k = 0; k < curve.count; ++k) {
      TRY(pace_.after());
      p[k] = samples.position[sample_of(samples, curve, k)];
    }
    for (int pass = 0; filtered && pass < k_filter_passes; pass += 2) {
      TRY(filter_points(curve, p, &pace_, q));
      TRY(filter_points(curve, q, &pace_, p));
    }
    for (uint32_t k = 0; k < curve.count; ++k) {
      TRY(pace_.after());
      const bool last = !curve.closed && k + 1 == curve.count;
      (*gaps)[curve.first_kept + k] = last ? 0.0 : length(p[curve.after(k)] - p[k]);
    }
  }
  return {};
}

Status Roughness::number_unknowns(const KeptSamples& samples) {
  uint32_t nodes = 0;
  for (size_t c = 0; c < samples.closed.size(); ++c) {
    const KeptCurve curve = kept_curve(samples, c);
    for (uint32_t k = 0; k < curve.count; ++k) {
      TRY(pace_.after());
      const uint32_t node = samples.node[sample_of(samples, curve, k)];
      if (node != k_none && node >= nodes) nodes = node + 1;
    }
  }
  Array<uint32_t> unknown_of_node(*context_);
  TRY(assign_in_parts(nodes, k_none, &unknown_of_node));
  TRY(unknown_.resize(samples.kept.size()));
  TRY(value_.reserve(samples.kept.size() * k_columns));
  value_.clear();
  unknowns_ = 0;
  for (size_t c = 0; c < samples.closed.size(); ++c) {
    const KeptCurve curve = kept_curve(samples, c);
    for (uint32_t k = 0; k < curve.count; ++k) {
      TRY(pace_.after());
      const uint32_t sample = sample_of(samples, curve, k);
      const uint32_t node = samples.node[sample];
      const bool known = node != k_none && unknown_of_node[node] != k_none;
      unknown_[curve.first_kept + k] = known ? unknown_of_node[node] : unknowns_;
      if (known) continue;
      if (node != k_none) unknown_of_node[node] = unknowns_;
      ++unknowns_;
      const Vec3& p = samples.position[sample];
      const Vec3& n = samples.normal[sample];
      const double values[k_columns] = {p.x, p.y, p.z, n.x, n.y, n.z};
      for (const double v : values) value_.push_reserved(v);
    }
  }
  return {};
}

// Appends one column of E^T, with ascending rows; a curve that comes straight back to a node has
// the same unknown on both sides.
static void push_row(const uint32_t unknown[3], const double weight[3], sparse::Csc* transposed) {
  const uint32_t first = transposed->start.back();
  for (int i = 0; i < 3; ++i) {
    size_t at = first;
    while (at < transposed->row.size() && transposed->row[at] < unknown[i]) ++at;
    if (at < transposed->row.size() && transposed->row[at] == unknown[i]) {
      transposed->value[at] += weight[i];
      continue;
    }
    transposed->row.push_reserved(unknown[i]);
    transposed->value.push_reserved(weight[i]);
    for (size_t k = transposed->row.size() - 1; k > at; --k) {
      swap_values(transposed->row[k], transposed->row[k - 1]);
      swap_values(transposed->value[k], transposed->value[k - 1]);
    }
  }
  transposed->start.push_reserved(static_cast<uint32_t>(transposed->row.size()));
}

Status Roughness::list_rows(const KeptSamples& samples, Span<const double> gaps) {
  // Nearer samples than this part of the median spacing count as that far apart: beyond it the row
  // only says that both ends move together.
  constexpr double k_least_gap = 0x1p-20;
  const size_t most = samples.kept.size();
  TRY(transposed_.start.reserve(most + 1));
  TRY(transposed_.row.reserve(3 * most));
  TRY(transposed_.value.reserve(3 * most));
  transposed_.start.clear();
  transposed_.row.clear();
  transposed_.value.clear();
  transposed_.start.push_reserved(0);
  for (size_t c = 0; c < samples.closed.size() && spacing_ > 0.0; ++c) {
    const KeptCurve curve = kept_curve(samples, c);
    for (uint32_t k = 0; k < curve.count; ++k) {
      TRY(pace_.after());
      if (curve.is_end(k)) continue;
      if (!samples.corner.empty() && samples.corner[sample_of(samples, curve, k)]) continue;
      const uint32_t before = curve.before(k), after = curve.after(k);
      const double to_before = gaps[curve.first_kept + before] / spacing_;
      const double to_after = gaps[curve.first_kept + k] / spacing_;
      const double g = to_before > k_least_gap ? to_before : k_least_gap;
      const double h = to_after > k_least_gap ? to_after : k_least_gap;
      const double s = std::sqrt(0.5 * (g + h));
      const uint32_t* unknown = unknown_.data() + curve.first_kept;
      const uint32_t columns[3] = {unknown[before], unknown[k], unknown[after]};
      const double a = 1.0 / (s * g), b = 1.0 / (s * h);
      const double weights[3] = {a, -(a + b), b};
      push_row(columns, weights, &transposed_);
    }
  }
  transposed_.rows = unknowns_;
  transposed_.cols = static_cast<uint32_t>(transposed_.start.size() - 1);
  return {};
}

// E p in the first columns, probes in the others: signs from a linear congruential generator.
Status Roughness::fill_right_side() {
  const uint32_t columns = k_columns + probes_;
  uint32_t random = 1;
  for (uint32_t j = 0; j < rows(); ++j) {
    TRY(pace_.after(k_steps_of_row));
    double* to = right_side_.data() + size_t{j} * columns;
    for (uint32_t i = 0; i < k_columns; ++i) to[i] = 0.0;
    for (uint32_t e = transposed_.start[j]; e < transposed_.start[j + 1]; ++e) {
      const double* from = value_.data() + size_t{transposed_.row[e]} * k_columns;
      for (uint32_t i = 0; i < k_columns; ++i) to[i] += transposed_.value[e] * from[i];
    }
    for (uint32_t i = k_columns; i < columns; ++i) {
      random = random * 1664525u + 1013904223u;
      to[i] = random >> 31 != 0 ? 1.0 : -1.0;
    }
  }
  return {};
}

// E E^T, its factor's structure, and E p.
Status Roughness::prepare_system() {
  constexpr uint32_t k_exact_rows = 1u << 14;
  const uint32_t m = rows();
  sparse::Csc roughness(*context_);
  Array<double> ones(*context_);
  Array<uint32_t> same(*context_), order(*context_);
  TRY(sparse::transpose(transposed_, &roughness));
  TRY(assign_in_parts(unknowns_, 1.0, &ones));
  TRY(same.resize(m));
  TRY(in_parts(*context_, m, [&](size_t j) { same[j] = static_cast<uint32_t>(j); }));
  TRY(sparse::weighted_product(roughness, ones.span(), transposed_, same.span(), m,
                               sparse::Part::lower, &product_));
  TRY(sparse::minimum_degree(product_, &order));
  TRY(factor_.analyse(product_, order.span()));
  system_.rows = system_.cols = m;
  TRY(copy_in_parts(product_.start, &system_.start));
  TRY(copy_in_parts(product_.row, &system_.row));
  TRY(system_.value.resize(product_.value.size()));
  probes_ = m > k_exact_rows ? k_probes : 0;
  TRY(right_side_.resize(size_t{m} * (k_columns + probes_)));
  TRY(solution_.resize(right_side_.size()));
  TRY(inverse_diagonal_.resize(probes_ == 0 ? m : 0));
  TRY(residual_.resize(size_t{unknowns_} * k_columns));
  return fill_right_side();
}

Status Roughness::build(const KeptSamples& samples, bool filtered) {
  if (samples.kept.size() >= k_none / 3) {
    return fail(Code::too_large, "too many samples for 32-bit indices");
  }
  Array<double> gaps(*context_), sorted(*context_);
  TRY(number_unknowns(samples));
  TRY(measure_gaps(samples, filtered, &gaps));
  TRY(sorted.reserve(gaps.size()));
  TRY(in_parts(*context_, gaps.size(), [&](size_t k) {
    if (gaps[k] > 0.0) sorted.push_reserved(gaps[k]);
  }));
  TRY(sort_in_parts(*context_, sorted.span(), Ascending()));
  spacing_ = sorted.empty() ? 0.0 : sorted[sorted.size() / 2];
  TRY(list_rows(samples, gaps.span()));
  return rows() > 0 ? prepare_system() : Status{};
}

// H has the eigenvalues of (I + lambda E E^T)^-1, and one for each direction beyond those: so the
// trace of I - H is that of I less the smaller inverse.
Status Roughness::find_freedom(double* freedom) {
  double sum = 0.0;
  if (probes_ == 0) {
    TRY(factor_.inverse_diagonal(inverse_diagonal_.span()));
    for (const double d : inverse_diagonal_) sum += 1.0 - d;
    *freedom = sum;
    return {};
  }
  const uint32_t columns = k_columns + probes_;
  for (uint32_t j = 0; j < rows(); ++j) {
    TRY(pace_.after());
    const double* z = right_side_.data() + size_t{j} * columns;
    const double* y = solution_.data() + size_t{j} * columns;
    for (uint32_t i = k_columns; i < columns; ++i) sum += z[i] * (z[i] - y[i]);
  }
  *freedom = sum / probes_;
  return {};
}

Status Roughness::measure_residuals(Residuals* residuals) const {
  residuals->position = residuals->normal = 0.0;
  return in_parts(*context_, unknowns_, [&](size_t u) {
    const double* r = residual_.data() + u * k_columns;
    residuals->position += r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
    residuals->normal += r[3] * r[3] + r[4] * r[4] + r[5] * r[5];
  });
}

Status Roughness::smooth(double lambda, Residuals* residuals) {
  const uint32_t m = rows(), columns = k_columns + probes_;
  TRY(pace_.after(m));
  TRY(in_parts(*context_, product_.value.size(),
               [&](size_t e) { system_.value[e] = lambda * product_.value[e]; }));
  TRY(in_parts(*context_, m, [&](size_t j) { system_.value[system_.start[j]] += 1.0; }));
  TRY(copy_in_parts(right_side_, &solution_));
  TRY(factor_.factor(system_));
  TRY(factor_.solve(solution_.span(), columns));
  TRY(assign_in_parts(residual_.size(), 0.0, &residual_));
  for (uint32_t j = 0; j < m; ++j) {
    TRY(pace_.after(k_steps_of_row));
    const double* from = solution_.data() + size_t{j} * columns;
    for (uint32_t e = transposed_.start[j]; e < transposed_.start[j + 1]; ++e) {
      const double weight = lambda * transposed_.value[e];
      double* to = residual_.data() + size_t{transposed_.row[e]} * k_columns;
      for (uint32_t i = 0; i < k_columns; ++i) to[i] += weight * from[i];
    }
  }
  if (residuals == nullptr) return {};
  TRY(measure_residuals(residuals));
  return find_freedom(&residuals->freedom);
}

Status Roughness::compare_sizes(const KeptSamples& samples, double tolerated, bool* change) {
  *change = false;
  for (size_t c = 0; c < samples.closed.size(); ++c) {
    const KeptCurve curve = kept_curve(samples, c);
    if (curve.count == 0) continue;
    const size_t first = size_t{unknown_[curve.first_kept]} * k_columns;
    double was = 0.0, is = 0.0;  // greatest distance from the first sample
    for (uint32_t k = 1; k < curve.count; ++k) {
      TRY(pace_.after());
      const size_t at = size_t{unknown_[curve.first_kept + k]} * k_columns;
      const double* v = value_.data();
      const double* r = residual_.data();
      const Vec3 before = {v[at] - v[first], v[at + 1] - v[first + 1], v[at + 2] - v[first + 2]};
      const Vec3 moved = {r[at] - r[first], r[at + 1] - r[first + 1], r[at + 2] - r[first + 2]};
      const double old_distance = length(before), new_distance = length(before - moved);
      was = old_distance > was ? old_distance : was;
      is = new_distance > is ? new_distance : is;
    }
    *change = *change || !(std::fabs(is - was) <= tolerated * was);
  }
  return {};
}

Status Roughness::write_positions(const KeptSamples& samples) {
  for (size_t c = 0; c < samples.closed.size(); ++c) {
    const KeptCurve curve = kept_curve(samples, c);
    for (uint32_t k = 0; k < curve.count; ++k) {
      TRY(pace_.after());
      const size_t at = size_t{unknown_[curve.first_kept + k]} * k_columns;
      const double* v = value_.data() + at;
      const double* r = residual_.data() + at;
      samples.position[sample_of(samples, curve, k)] = {v[0] - r[0], v[1] - r[1], v[2] - r[2]};
    }
  }
  return {};
}

Status Roughness::write_normals(const KeptSamples& samples) {
  for (size_t c = 0; c < samples.closed.size(); ++c) {
    const KeptCurve curve = kept_curve(samples, c);
    for (uint32_t k = 0; k < curve.count; ++k) {
      TRY(pace_.after());
      const size_t at = size_t{unknown_[curve.first_kept + k]} * k_columns + 3;
      const double* v = value_.data() + at;
      const double* r = residual_.data() + at;
      const Vec3 given = {v[0], v[1], v[2]};
      const Vec3 smoothed = {v[0] - r[0], v[1] - r[1], v[2] - r[2]};
      // Normals that turn all the way round within the reach of the spline may average to nothing
      // or to the opposite; the given one is then the better answer.
      samples.normal[sample_of(samples, curve, k)] =
          dot(smoothed, given) > 0.0 ? unit(smoothed) : given;
    }
  }
  return {};
}

}  // namespace wireskin::network
