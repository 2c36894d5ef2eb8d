// Sparse matrices in compressed columns, the only matrix format of the library.
//
// Invariants: row indices are strictly ascending in each column; start has cols + 1 entries. A
// symmetric matrix is stored as its lower triangle, with the diagonal present in every column (so
// it is each column's first entry). Vectors of several columns are stored row by row: entry (i, c)
// of an n x columns block stands at i * columns + c. Cost: everything here is linear in the number
// of entries.
#pragma once

#include "base/array.h"

namespace wireskin::sparse {

struct Csc {
  uint32_t rows = 0;
  uint32_t cols = 0;
  Array<uint32_t> start;
  Array<uint32_t> row;
  Array<double> value;

  explicit Csc(Context& context) : start(context), row(context), value(context) {}
};

// True if `a` keeps the invariants of a lower triangle; for assertions and tests.
bool is_lower_triangle(const Csc& a);

// y = A x for the symmetric matrix whose lower triangle is `lower`. Each column of the block is
// summed in the same order whatever `columns` is.
Status multiply_symmetric(const Csc& lower, Span<const double> x, Span<double> y, uint32_t columns);

// Appends a column's entries to the rows and values of a matrix that is being gathered: `rows`,
// distinct and in any order, and of each its value in `sum`, which has an entry for every row of
// the matrix.
Status append_column(Span<const uint32_t> rows, Span<const double> sum, Csc* matrix);

// *result = the transpose of `a`.
Status transpose(const Csc& a, Csc* result);

// A pattern without values: the entries of column j are index[start[j] .. start[j + 1]), unordered;
// source[k] is the entry of the original matrix that stands behind entry k.
struct Pattern {
  Array<uint32_t> start;
  Array<uint32_t> index;
  Array<uint32_t> source;

  explicit Pattern(Context& context) : start(context), index(context), source(context) {}
};

// Loops over columns that do a few operations per entry pause for a checkpoint after this many.
inline constexpr uint32_t k_columns_per_checkpoint = 1u << 12;

inline Status checkpoint_at_column(Context& context, uint32_t j) {
  return (j + 1) % k_columns_per_checkpoint == 0 ? context.checkpoint() : Status{};
}

enum class Triangle { lower, upper };

// One triangle of the symmetrically permuted matrix, diagonal included: column j of `lower` becomes
// column position[j]. Of two mirrored entries the one in the wanted triangle is listed. The source
// of each may be left out.
Status permute_pattern(const Csc& lower, Span<const uint32_t> position, Triangle triangle,
                       Pattern* result, bool with_source = true);

}  // namespace wireskin::sparse
