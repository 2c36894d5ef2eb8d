// The dense inner product kernel under the sparse factorisation and the triangular solves.
//
// product(i, j) = sum over k of a[i + k * a_step] * b[j * b_out + k * b_step], k ascending from
// zero. Tiles of 4 x 4 products are formed side by side: a tile only shares loads, each sum keeps
// its order, so the bits do not depend on the tiling, on the compiler's vectors or on how many
// columns are asked for at once.
#pragma once

#include "base/array.h"

namespace wireskin::sparse {

struct Products {
  const double* a;  // the i-th output begins at a + i
  size_t a_step;
  const double* b;
  size_t b_out;
  size_t b_step;
  uint32_t depth;  // terms in each sum
};

// Hands the products of the rows i .. i + Rows and columns j .. j + Columns to subtract(i, j,
// product).
template <uint32_t Rows, uint32_t Columns, typename Subtract>
void product_tile(const Products& p, uint32_t i, uint32_t j, const Subtract& subtract) {
  double sum[Columns][Rows] = {};
  const double* a = p.a + i;
  const double* b = p.b + j * p.b_out;
  for (uint32_t k = 0; k < p.depth; ++k, a += p.a_step, b += p.b_step) {
    for (uint32_t c = 0; c < Columns; ++c) {
      const double factor = b[c * p.b_out];
      for (uint32_t r = 0; r < Rows; ++r) sum[c][r] += a[r] * factor;
    }
  }
  for (uint32_t c = 0; c < Columns; ++c) {
    for (uint32_t r = 0; r < Rows; ++r) subtract(i + r, j + c, sum[c][r]);
  }
}

template <uint32_t Columns, typename Subtract>
void product_strip(const Products& p, uint32_t first_row, uint32_t rows, uint32_t j,
                   const Subtract& subtract) {
  uint32_t i = first_row;
  for (; i + 4 <= rows; i += 4) product_tile<4, Columns>(p, i, j, subtract);
  for (; i < rows; ++i) product_tile<1, Columns>(p, i, j, subtract);
}

// All products of `rows` x `columns`.
template <typename Subtract>
void for_products(const Products& p, uint32_t rows, uint32_t columns, const Subtract& subtract) {
  uint32_t j = 0;
  for (; j + 4 <= columns; j += 4) product_strip<4>(p, 0, rows, j, subtract);
  for (; j < columns; ++j) product_strip<1>(p, 0, rows, j, subtract);
}

// The products on and below the diagonal, and some of those above it.
template <typename Subtract>
void for_lower_products(const Products& p, uint32_t rows, uint32_t columns,
                        const Subtract& subtract) {
  uint32_t j = 0;
  for (; j + 4 <= columns; j += 4) product_strip<4>(p, j, rows, j, subtract);
  for (; j < columns; ++j) product_strip<1>(p, j, rows, j, subtract);
}

}  // namespace wireskin::sparse
