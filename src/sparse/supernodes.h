// The structure of a sparse Cholesky factor as supernodes: runs of columns that share one list of
// rows and are stored as one dense panel.
//
// In: a permuted pattern in postorder, its elimination tree and column counts. Besides columns that
// share their rows exactly, a supernode takes in its last child where that stores few zeros, or
// where both are so narrow that longer panels pay for them. Invariants: the rows of supernode s
// ascend and begin with its own columns, first[s] .. first[s + 1]; its panel of values begins at
// panel[s], a trapezoid (dense.h) of round_up_rows() rows, and a margin behind the last. A panel's
// values above the diagonal and in the padding mean nothing. Cost: linear in entries and rows.
// Source: Cleve Ashcraft, Roger Grimes, "The Influence of Relaxed Supernode Partitions on the
// Multifrontal Method", 1989.
#pragma once

#include "sparse/csc.h"
#include "sparse/dense.h"

namespace wireskin::sparse {

// Kernels that start at any row of the last column may read beyond it.
inline constexpr uint32_t k_panel_margin = 4;

struct Supernodes {
  uint32_t count = 0;
  Array<uint32_t> first;      // count + 1
  Array<uint32_t> row_start;  // count + 1
  Array<uint32_t> row;
  Array<uint32_t> panel;      // count + 1
  Array<uint32_t> of_column;  // the supernode of each column

  explicit Supernodes(Context& c) : first(c), row_start(c), row(c), panel(c), of_column(c) {}

  uint32_t width(uint32_t s) const { return first[s + 1] - first[s]; }
  uint32_t height(uint32_t s) const { return row_start[s + 1] - row_start[s]; }
  uint32_t column_step(uint32_t s) const { return round_up_rows(height(s)); }
  const uint32_t* rows(uint32_t s) const { return row.data() + row_start[s]; }
};

Status find_supernodes(const Pattern& lower, Span<const uint32_t> parent,
                       Span<const uint32_t> count, Supernodes* result);

}  // namespace wireskin::sparse
