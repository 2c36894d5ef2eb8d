// The dense Cholesky factorisation of one panel of columns and the update matrix that its rows
// below leave, divided among threads where the caller asks for it.
//
// In: a lower trapezoid, column by column (dense.h says how). Out: its factor; the update matrix
// loses the products of the rows below. The bits do not depend on how the work is divided. Cost:
// that of the products, done in blocks of 64 and of 8 columns.
#pragma once

#include "sparse/dense.h"

namespace wireskin::sparse {

struct Panel {
  double* value;
  uint32_t height;  // rows
  uint32_t width;   // columns
  double* update;   // square, of height - width rows
  bool first;       // the update matrix counts as zero

  uint32_t rows() const { return round_up_rows(height); }
  uint32_t tail() const { return height - width; }
  // From an entry of a column to its right neighbour in the same block.
  size_t step(uint32_t column) const {
    return rows() - column / k_trapezoid_block * k_trapezoid_block;
  }
  // The entry of a row in a column; rows above the column's block stand elsewhere.
  double* at(uint32_t row, uint32_t column) const {
    return value + (trapezoid_offset(rows(), column) + row);
  }
};

// What does the work: `scratch` has k_update_scratch numbers for each of `slots` threads.
struct PanelTools {
  const DenseKernels* kernels;
  double* scratch;
  uint32_t slots;
};

// Returns the first column with a pivot that is not positive and finite, or k_none. With one slot
// it runs on this thread and calls nothing of the context.
uint32_t factor_panel(const PanelTools& tools, const Panel& panel);

// The same with checkpoints, and with the work of wide panels divided by the context's threads.
Status factor_panel_in_parts(Context& context, const PanelTools& tools, const Panel& panel,
                             uint32_t* bad_column);

}  // namespace wireskin::sparse
