#include "sparse/product.h"

#include "base/sort.h"

namespace wireskin::sparse {

namespace {

// Column j of the product: the rows met so far and their sums, in a dense array marked by column.
struct Accumulator {
  Array<uint32_t> mark;
  Array<uint32_t> rows;
  Array<double> sum;

  explicit Accumulator(Context& context) : mark(context), rows(context), sum(context) {}
};

struct Factors {
  const Csc& a;
  Span<const double> weight;
  const Csc& b;
  Span<const uint32_t> unknown;
  Part part;
};

}  // namespace

// Gathers column `column` of B's numbering, which is unknown j, and leaves its rows unsorted.
// Weights of zero are no reason to skip an entry: the pattern must not depend on values.
static void gather_column(const Factors& factors, uint32_t column, uint32_t j,
                          Accumulator* gathered) {
  gathered->rows.clear();
  for (uint32_t q = factors.b.start[column]; q < factors.b.start[column + 1]; ++q) {
    const uint32_t inner = factors.b.row[q];
    const double scale = factors.weight[inner] * factors.b.value[q];
    for (uint32_t p = factors.a.start[inner]; p < factors.a.start[inner + 1]; ++p) {
      const uint32_t i = factors.unknown[factors.a.row[p]];
      if (i == k_none || (factors.part == Part::lower && i < j)) continue;
      if (gathered->mark[i] != j) {
        gathered->mark[i] = j;
        gathered->sum[i] = 0.0;
        gathered->rows.push_reserved(i);
      }
      gathered->sum[i] += factors.a.value[p] * scale;
    }
  }
}

// The number of entries of each column, by marks alone.
static Status count_columns(const Factors& factors, Span<uint32_t> mark, Csc* product) {
  uint64_t total = 0;
  uint32_t j = 0;
  for (uint32_t column = 0; column < factors.b.cols; ++column) {
    if (factors.unknown[column] == k_none) continue;
    product->start[j] = static_cast<uint32_t>(total);
    for (uint32_t q = factors.b.start[column]; q < factors.b.start[column + 1]; ++q) {
      const uint32_t inner = factors.b.row[q];
      for (uint32_t p = factors.a.start[inner]; p < factors.a.start[inner + 1]; ++p) {
        const uint32_t i = factors.unknown[factors.a.row[p]];
        if (i == k_none || mark[i] == j || (factors.part == Part::lower && i < j)) continue;
        mark[i] = j;
        ++total;
      }
    }
    if (total >= k_none) return fail(Code::too_large, "the matrix is too large for 32-bit indices");
    if (++j % 8192 == 0) TRY(product->start.context().checkpoint());
  }
  product->start[j] = static_cast<uint32_t>(total);
  return {};
}

Status weighted_product(const Csc& a, Span<const double> weight, const Csc& b,
                        Span<const uint32_t> unknown, uint32_t unknowns, Part part, Csc* product) {
  Context& context = product->start.context();
  const Factors factors = {a, weight, b, unknown, part};
  Accumulator gathered(context);
  TRY(gathered.mark.assign(unknowns, k_none));
  TRY(gathered.sum.resize(unknowns));
  TRY(gathered.rows.reserve(unknowns));
  TRY(product->start.resize(size_t{unknowns} + 1));
  TRY(count_columns(factors, gathered.mark.span(), product));
  for (uint32_t& m : gathered.mark) m = k_none;
  product->rows = product->cols = unknowns;
  TRY(product->row.resize(product->start[unknowns]));
  TRY(product->value.resize(product->start[unknowns]));
  uint32_t j = 0;
  for (uint32_t column = 0; column < b.cols; ++column) {
    if (unknown[column] == k_none) continue;
    gather_column(factors, column, j, &gathered);
    sort(gathered.rows.span(), [](uint32_t x, uint32_t y) { return x < y; });
    const uint32_t first = product->start[j];
    for (uint32_t k = 0; k < gathered.rows.size(); ++k) {
      product->row[first + k] = gathered.rows[k];
      product->value[first + k] = gathered.sum[gathered.rows[k]];
    }
    if (++j % 8192 == 0) TRY(context.checkpoint());
  }
  return {};
}

}  // namespace wireskin::sparse
