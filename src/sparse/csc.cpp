#include "sparse/csc.h"

#include "base/in_parts.h"
#include "base/sort.h"

namespace wireskin::sparse {

bool is_lower_triangle(const Csc& a) {
  if (a.rows != a.cols || a.start.size() != size_t{a.cols} + 1 || a.start[0] != 0) return false;
  if (a.row.size() != a.value.size() || a.row.size() != a.start[a.cols]) return false;
  for (uint32_t j = 0; j < a.cols; ++j) {
    if (a.start[j] >= a.start[j + 1] || a.row[a.start[j]] != j) return false;
    for (uint32_t k = a.start[j] + 1; k < a.start[j + 1]; ++k) {
      if (a.row[k] <= a.row[k - 1] || a.row[k] >= a.rows) return false;
    }
  }
  return true;
}

Status multiply_symmetric(const Csc& lower, Span<const double> x, Span<double> y,
                          uint32_t columns) {
  WIRESKIN_ASSERT(x.size() == size_t{lower.cols} * columns && y.size() == x.size());
  for (double& entry : y) entry = 0.0;
  for (uint32_t j = 0; j < lower.cols; ++j) {
    TRY(checkpoint_at_column(lower.start.context(), j));
    const double* xj = x.data() + size_t{j} * columns;
    double* yj = y.data() + size_t{j} * columns;
    const uint32_t diagonal = lower.start[j];
    for (uint32_t c = 0; c < columns; ++c) yj[c] += lower.value[diagonal] * xj[c];
    for (uint32_t k = diagonal + 1; k < lower.start[j + 1]; ++k) {
      const double a = lower.value[k];
      const double* xi = x.data() + size_t{lower.row[k]} * columns;
      double* yi = y.data() + size_t{lower.row[k]} * columns;
      for (uint32_t c = 0; c < columns; ++c) {
        yi[c] += a * xj[c];
        yj[c] += a * xi[c];
      }
    }
  }
  return {};
}

Status append_column(Span<const uint32_t> rows, Span<const double> sum, Csc* matrix) {
  const size_t first = matrix->row.size();
  const uint32_t count = static_cast<uint32_t>(rows.size());
  TRY(matrix->row.resize(first + count));
  TRY(matrix->value.resize(first + count));
  uint32_t* const row = matrix->row.data() + first;
  double* const value = matrix->value.data() + first;
  sort_distinct(rows.data(), count, row);
  for (uint32_t k = 0; k < count; ++k) value[k] = sum[row[k]];
  return {};
}

Status transpose(const Csc& a, Csc* result) {
  const size_t entries = a.row.size();
  TRY(assign_in_parts(size_t{a.rows} + 1, 0, &result->start));
  TRY(result->row.resize(entries));
  TRY(result->value.resize(entries));
  Array<uint32_t> next(a.start.context());
  TRY(in_parts(a.start.context(), entries, [&](size_t k) { ++result->start[a.row[k]]; }));
  starts_from_counts(result->start.span());
  TRY(copy_in_parts(result->start, &next));
  for (uint32_t j = 0; j < a.cols; ++j) {
    TRY(checkpoint_at_column(a.start.context(), j));
    for (uint32_t k = a.start[j]; k < a.start[j + 1]; ++k) {
      const uint32_t to = next[a.row[k]]++;
      result->row[to] = j;
      result->value[to] = a.value[k];
    }
  }
  result->rows = a.cols;
  result->cols = a.rows;
  return {};
}

Status permute_pattern(const Csc& lower, Span<const uint32_t> position, Triangle triangle,
                       Pattern* result, bool with_source) {
  Context& context = lower.start.context();
  const uint32_t n = lower.cols;
  TRY(assign_in_parts(size_t{n} + 1, 0, &result->start));
  TRY(result->index.resize(lower.row.size()));
  if (with_source) TRY(result->source.resize(lower.row.size()));
  Array<uint32_t> next(context);
  Pace pace(context);
  const bool by_smaller = triangle == Triangle::lower;
  for (uint32_t j = 0; j < n; ++j) {
    TRY(pace.after(lower.start[j + 1] - lower.start[j]));
    for (uint32_t k = lower.start[j]; k < lower.start[j + 1]; ++k) {
      const uint32_t a = position[lower.row[k]], b = position[j];
      const uint32_t smaller = a < b ? a : b, larger = a < b ? b : a;
      ++result->start[by_smaller ? smaller : larger];
    }
  }
  starts_from_counts(result->start.span());
  TRY(copy_in_parts(result->start, &next));
  for (uint32_t j = 0; j < n; ++j) {
    TRY(pace.after(lower.start[j + 1] - lower.start[j]));
    for (uint32_t k = lower.start[j]; k < lower.start[j + 1]; ++k) {
      const uint32_t a = position[lower.row[k]], b = position[j];
      const uint32_t smaller = a < b ? a : b, larger = a < b ? b : a;
      const uint32_t to = next[by_smaller ? smaller : larger]++;
      result->index[to] = by_smaller ? larger : smaller;
      if (with_source) result->source[to] = k;
    }
  }
  return {};
}

}  // namespace wireskin::sparse
