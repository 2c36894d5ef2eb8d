#include "sparse/ldl.h"

#include <cfloat>
#include <cmath>

#include "base/in_parts.h"
#include "sparse/elimination_tree.h"

namespace wireskin::sparse {

Ldl::Ldl(Context& context)
    : context_(&context),
      order_(context),
      upper_(context),
      parent_(context),
      start_(context),
      row_(context),
      value_(context),
      diagonal_(context),
      inverse_(context),
      inverse_diagonal_(context),
      filled_(context),
      visited_(context),
      pattern_(context),
      path_(context),
      column_(context),
      sum_(context),
      permuted_(context) {}

// Entries far from the diagonal may shrink step by step until they are denormal, which processors
// handle slowly; this far below one they are nothing.
static double without_dust(double entry) {
  constexpr double k_dust = 0x1p-500;
  return std::fabs(entry) < k_dust ? 0.0 : entry;
}

// What a column costs beside its entries.
static constexpr size_t k_work_of_column = 16;

Status Ldl::count_work(size_t work) {
  constexpr size_t k_work_per_checkpoint = size_t{1} << 21;
  work_ += work;
  if (work_ < k_work_per_checkpoint) return {};
  work_ = 0;
  return context_->checkpoint();
}

// Row k of L has an entry in every column on the way from an entry of the matrix's row up the
// elimination tree to k. Those columns, descendants first, are pattern_[result .. n).
uint32_t Ldl::find_row_pattern(uint32_t k) {
  uint32_t top = static_cast<uint32_t>(pattern_.size());
  visited_[k] = k;
  for (uint32_t p = upper_.start[k]; p < upper_.start[k + 1]; ++p) {
    uint32_t length = 0;
    for (uint32_t j = upper_.index[p]; visited_[j] != k; j = parent_[j]) {
      path_[length++] = j;
      visited_[j] = k;
    }
    while (length > 0) pattern_[--top] = path_[--length];
  }
  return top;
}

Status Ldl::analyse(const Csc& lower, Span<const uint32_t> order) {
  WIRESKIN_ASSERT(is_lower_triangle(lower) && order.size() == lower.cols);
  factored_ = false;
  const uint32_t n = lower.cols;
  TRY(copy_in_parts(order, &order_));
  TRY(path_.resize(n));
  TRY(pattern_.resize(n));
  TRY(filled_.resize(n));
  TRY(assign_in_parts(n, 0.0, &column_));
  TRY(assign_in_parts(n, 0.0, &sum_));
  TRY(diagonal_.resize(n));
  TRY(inverse_diagonal_.resize(n));
  TRY(assign_in_parts(n, k_none, &visited_));
  TRY(assign_in_parts(size_t{n} + 1, 0, &start_));
  TRY(in_parts(*context_, n, [&](size_t k) { path_[order[k]] = static_cast<uint32_t>(k); }));
  TRY(permute_pattern(lower, path_.span(), Triangle::upper, &upper_));
  TRY(elimination_tree(upper_, &parent_));
  uint64_t entries = 0;
  for (uint32_t k = 0; k < n; ++k) {
    const uint32_t top = find_row_pattern(k);
    for (uint32_t t = top; t < n; ++t) ++start_[pattern_[t]];
    entries += n - top;
    if (entries >= k_none) {
      return fail(Code::too_large, "the factor is too large for 32-bit indices");
    }
    TRY(count_work(n - top + k_work_of_column));
  }
  starts_from_counts(start_.span());
  TRY(row_.resize(static_cast<size_t>(entries)));
  TRY(value_.resize(static_cast<size_t>(entries)));
  return inverse_.resize(static_cast<size_t>(entries));
}

// Row by row: row k of L D solves a triangular system with the rows above.
Status Ldl::factor(const Csc& lower) {
  factored_ = false;
  const uint32_t n = static_cast<uint32_t>(order_.size());
  if (lower.cols != n || lower.value.size() != upper_.source.size()) {
    return fail(Code::bad_argument, "the matrix has not the pattern that was analysed");
  }
  TRY(in_parts(*context_, n, [&](size_t j) {
    filled_[j] = start_[j];
    visited_[j] = k_none;
    column_[j] = 0.0;
  }));
  for (uint32_t k = 0; k < n; ++k) {
    const uint32_t top = find_row_pattern(k);
    for (uint32_t p = upper_.start[k]; p < upper_.start[k + 1]; ++p) {
      column_[upper_.index[p]] = lower.value[upper_.source[p]];
    }
    double pivot = column_[k];
    column_[k] = 0.0;
    size_t work = k_work_of_column;
    for (uint32_t t = top; t < n; ++t) {
      const uint32_t j = pattern_[t];
      const double y = column_[j];
      column_[j] = 0.0;
      for (uint32_t p = start_[j]; p < filled_[j]; ++p) column_[row_[p]] -= value_[p] * y;
      const double entry = without_dust(y / diagonal_[j]);
      pivot -= entry * y;
      work += filled_[j] - start_[j] + 2;
      row_[filled_[j]] = k;
      value_[filled_[j]++] = entry;
    }
    if (!(pivot > 0.0 && pivot <= DBL_MAX)) {
      Place place;
      place.vertex = order_[k];
      return fail(Code::not_positive_definite, "the matrix is not positive definite", place);
    }
    diagonal_[k] = pivot;
    TRY(count_work(work));
  }
  factored_ = true;
  return {};
}

Status Ldl::solve(Span<double> x, uint32_t columns) {
  if (!factored_) return fail(Code::bad_argument, "there is no factor to solve with");
  const uint32_t n = static_cast<uint32_t>(order_.size());
  WIRESKIN_ASSERT(x.size() == size_t{n} * columns);
  TRY(permuted_.resize(x.size()));
  double* y = permuted_.data();
  TRY(in_parts(*context_, n, [&](size_t k) {
    const double* from = x.data() + size_t{order_[k]} * columns;
    for (uint32_t c = 0; c < columns; ++c) y[k * columns + c] = from[c];
  }));
  for (uint32_t j = 0; j < n; ++j) {
    const double* yj = y + size_t{j} * columns;
    for (uint32_t p = start_[j]; p < start_[j + 1]; ++p) {
      double* yi = y + size_t{row_[p]} * columns;
      for (uint32_t c = 0; c < columns; ++c) yi[c] -= value_[p] * yj[c];
    }
    TRY(count_work(k_work_of_column + size_t{start_[j + 1] - start_[j]} * columns));
  }
  for (uint32_t j = n; j-- > 0;) {
    double* yj = y + size_t{j} * columns;
    for (uint32_t c = 0; c < columns; ++c) yj[c] /= diagonal_[j];
    for (uint32_t p = start_[j]; p < start_[j + 1]; ++p) {
      const double* yi = y + size_t{row_[p]} * columns;
      for (uint32_t c = 0; c < columns; ++c) yj[c] -= value_[p] * yi[c];
    }
    TRY(count_work(k_work_of_column + size_t{start_[j + 1] - start_[j]} * columns));
  }
  return in_parts(*context_, n, [&](size_t k) {
    double* to = x.data() + size_t{order_[k]} * columns;
    const double* from = y + k * columns;
    for (uint32_t c = 0; c < columns; ++c) to[c] = from[c];
  });
}

// Z = A^-1 satisfies Z L = L^-T D^-1, whose lower triangle is D^-1. So column j of Z below the
// diagonal is -Z(s, s) L(s, j) with s the rows of L(:, j), and all of Z(s, s) is known when the
// columns are taken from the last to the first: any two rows of a column meet in the factor.
Status Ldl::inverse_diagonal(Span<double> diagonal) {
  if (!factored_) return fail(Code::bad_argument, "there is no factor to invert");
  const uint32_t n = static_cast<uint32_t>(order_.size());
  for (uint32_t j = n; j-- > 0;) {
    const uint32_t first = start_[j], end = start_[j + 1];
    size_t work = k_work_of_column;
    for (uint32_t p = first; p < end; ++p) {
      column_[row_[p]] = value_[p];
      sum_[row_[p]] = 0.0;
    }
    for (uint32_t p = first; p < end; ++p) {
      const uint32_t i = row_[p];
      const double entry = value_[p];
      double sum = inverse_diagonal_[i] * entry;
      // Rows of column i that column j lacks read a zero and write a sum that nobody reads.
      for (uint32_t q = start_[i]; q < start_[i + 1]; ++q) {
        sum += inverse_[q] * column_[row_[q]];
        sum_[row_[q]] += inverse_[q] * entry;
      }
      sum_[i] += sum;
      work += 2 * size_t{start_[i + 1] - start_[i]} + 2;
    }
    double own = 1.0 / diagonal_[j];
    for (uint32_t p = first; p < end; ++p) {
      inverse_[p] = without_dust(-sum_[row_[p]]);
      own -= inverse_[p] * value_[p];
      column_[row_[p]] = 0.0;
    }
    inverse_diagonal_[j] = own;
    diagonal[order_[j]] = own;
    TRY(count_work(work));
  }
  return {};
}

}  // namespace wireskin::sparse
