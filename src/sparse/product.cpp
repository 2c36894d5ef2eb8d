#include "sparse/product.h"

#include "base/in_parts.h"

namespace wireskin::sparse {

namespace {

// Column j of the product: the rows met so far, `count`, and their sums, in a dense array marked by
// column.
struct Accumulator {
  Array<uint32_t> mark;
  Array<uint32_t> rows;  // one more than there are
  Array<double> sum;
  uint32_t count = 0;

  explicit Accumulator(Context& context) : mark(context), rows(context), sum(context) {}
};

struct Factors {
  const Csc& a;
  Span<const double> weight;
  const Csc& b;
  Span<const uint32_t> unknown;
  Part part;

  // Rows ascend and unknowns are numbered along with them, so a column of the lower part reads the
  // columns of A from their ends up to its own row.
  bool ends_at(uint32_t row, uint32_t column) const { return part == Part::lower && row < column; }
};

}  // namespace

// Gathers column `column` of B's numbering, which is unknown j, and leaves its rows unsorted.
// Weights of zero are no reason to skip an entry: the pattern must not depend on values. Columns
// may be long, so the multiplications are counted instead of the columns.
static void gather_column(const Factors& factors, uint32_t column, uint32_t j,
                          Accumulator* gathered, Pace* pace) {
  uint32_t* const mark = gathered->mark.data();
  uint32_t* const rows = gathered->rows.data();
  double* const sum = gathered->sum.data();
  uint32_t count = 0;
  for (uint32_t q = factors.b.start[column]; q < factors.b.start[column + 1]; ++q) {
    const uint32_t inner = factors.b.row[q];
    pace->add(factors.a.start[inner + 1] - factors.a.start[inner]);
    const double scale = factors.weight[inner] * factors.b.value[q];
    for (uint32_t p = factors.a.start[inner + 1]; p-- > factors.a.start[inner];) {
      if (factors.ends_at(factors.a.row[p], column)) break;
      const uint32_t i = factors.unknown[factors.a.row[p]];
      if (i == k_none) continue;
      // Whether a row is new is hard to foresee, so it is no question for a branch.
      const bool fresh = mark[i] != j;
      const double before[2] = {sum[i], 0.0};
      mark[i] = j;
      rows[count] = i;
      count += fresh;
      sum[i] = before[fresh] + factors.a.value[p] * scale;
    }
  }
  gathered->count = count;
}

// About the number of entries of the product, from every 32nd column.
static Status estimate_entries(const Factors& factors, Accumulator* gathered, Pace* pace,
                               size_t* entries) {
  constexpr uint32_t k_step = 32;
  size_t total = 0;
  uint32_t j = 0;
  for (uint32_t column = 0; column < factors.b.cols; ++column) {
    TRY(pace->after());
    if (factors.unknown[column] == k_none) continue;
    if (j % k_step == 0) {
      gather_column(factors, column, j, gathered, pace);
      total += gathered->count;
    }
    ++j;
  }
  *entries = total * k_step;
  return {};
}

// Room for one more column, and where there was none, for some more.
static Status make_room(size_t more, size_t* room, Csc* product) {
  const size_t least = product->row.size() + more;
  if (least >= k_none) return fail(Code::too_large, "the matrix is too large for 32-bit indices");
  if (least <= *room) return {};
  *room = least + least / 16;
  TRY(product->row.reserve(*room));
  return product->value.reserve(*room);
}

Status weighted_product(const Csc& a, Span<const double> weight, const Csc& b,
                        Span<const uint32_t> unknown, uint32_t unknowns, Part part, Csc* product) {
  Context& context = product->start.context();
  const Factors factors = {a, weight, b, unknown, part};
  Accumulator gathered(context);
  Pace pace(context, k_light_steps_per_checkpoint);
  size_t room = 0, entries = 0;
  TRY(assign_in_parts(unknowns, k_none, &gathered.mark));
  TRY(assign_in_parts(unknowns, 0.0, &gathered.sum));
  TRY(gathered.rows.resize(size_t{unknowns} + 1));
  TRY(product->start.resize(size_t{unknowns} + 1));
  product->rows = product->cols = unknowns;
  product->row.clear();
  product->value.clear();
  TRY(estimate_entries(factors, &gathered, &pace, &entries));
  TRY(make_room(entries, &room, product));
  TRY(assign_in_parts(unknowns, k_none, &gathered.mark));
  uint32_t j = 0;
  for (uint32_t column = 0; column < b.cols; ++column) {
    if (unknown[column] == k_none) continue;
    gather_column(factors, column, j, &gathered, &pace);
    TRY(make_room(gathered.count, &room, product));
    product->start[j++] = static_cast<uint32_t>(product->row.size());
    TRY(append_column(gathered.rows.span().part(0, gathered.count), gathered.sum.span(), product));
    TRY(pace.after());
  }
  product->start[unknowns] = static_cast<uint32_t>(product->row.size());
  return {};
}

}  // namespace wireskin::sparse
