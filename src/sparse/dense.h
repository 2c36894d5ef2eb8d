// The dense arithmetic under the sparse factorisation and the triangular solves: subtracting
// products, solving with a small triangle, adding an update to a front. Written once
// (dense_kernels.inc) and compiled for several instruction sets; the processor decides at run time.
//
// Invariants: all instruction sets, tilings and blockings give the same bits: every output takes
// its terms one after the other in ascending order, multiplied and then subtracted, never fused,
// and vectors stand across outputs, but for dot products, whose eight partial sums they hold.
// Matrices are stored column by column; rows come in multiples of four, and those that pad a matrix
// are read and written like any other. Source of the blocking: K. Goto, R. van de Geijn, "Anatomy
// of High-Performance Matrix Multiplication", 2008.
#pragma once

#include "base/array.h"

namespace wireskin::sparse {

// Columns of a lower trapezoid are stored in blocks of eight: each begins with the row of its
// block's first diagonal entry, so the distance of neighbours is eight less in every next block.
inline constexpr uint32_t k_trapezoid_block = 8;

// From an entry of the first column, whose neighbour is `step` away, to that of `column` in the
// same row, which need not be stored.
inline size_t trapezoid_offset(size_t step, uint32_t column) {
  const size_t block = column / k_trapezoid_block, inside = column % k_trapezoid_block;
  return step * column -
         k_trapezoid_block * (block * (block - 1) / 2 * k_trapezoid_block + block * (inside + 1));
}

inline size_t trapezoid_size(size_t step, uint32_t columns) {
  const size_t block = columns / k_trapezoid_block, inside = columns % k_trapezoid_block;
  return step * columns -
         k_trapezoid_block * (block * (block - 1) / 2 * k_trapezoid_block + block * inside);
}

// C -= A B^T, or C = -A B^T: entry (i, j) of C loses the sum over k < depth of
// a[i + k * a_step] * b[j * b_out + k * b_step].
struct Update {
  uint32_t rows;  // a multiple of four
  uint32_t columns;
  uint32_t depth;
  const double* a;
  size_t a_step;
  const double* b;
  size_t b_out;
  size_t b_step;
  double* c;
  size_t c_step;
  bool lower;      // entries above the diagonal are not needed
  bool overwrite;  // C counts as zero
  // A and B, or C, are columns of trapezoids, the first of them the first of its block.
  bool from_trapezoid = false;
  bool into_trapezoid = false;

  size_t from_column(size_t step, uint32_t k) const {
    return from_trapezoid ? trapezoid_offset(step, k) : step * k;
  }
  size_t into_column(uint32_t j) const {
    return into_trapezoid ? trapezoid_offset(c_step, j) : c_step * j;
  }
  // The distance of the neighbours of column k or j.
  static size_t step_at(size_t step, uint32_t k, bool trapezoid) {
    return trapezoid ? step - k / k_trapezoid_block * k_trapezoid_block : step;
  }
};

// c[j + l * c_step] loses the sum over k < depth of a[k + j * a_step] * b[k + l * b_step], for j <
// columns, l < lanes. The terms go to eight sums in turn, which are then added pairwise.
struct Dots {
  uint32_t columns;
  uint32_t lanes;
  uint32_t depth;  // a multiple of four
  const double* a;
  size_t a_step;
  const double* b;
  size_t b_step;
  double* c;
  size_t c_step;
};

// A lower triangle of at most eight columns: entries below the diagonal, inverses on it.
struct DiagonalBlock {
  static constexpr uint32_t k_size = 8;
  uint32_t columns;
  double entry[k_size][k_size];  // [row][column]
  double inverse[k_size];
};

// `length` consecutive rows, `from` on in an update, are rows `to` on of the front above.
struct Run {
  uint32_t from;
  uint32_t to;
  uint32_t length;
};

// A block of the large updates: columns of B, then rows of A, in the scratch memory.
inline constexpr uint32_t k_block_columns = 128;
inline constexpr uint32_t k_block_rows = 96;
inline constexpr uint32_t k_block_depth = 256;
inline constexpr size_t k_update_scratch = size_t{k_block_depth} * (k_block_columns + k_block_rows);

// Whether update() needs its scratch memory of k_update_scratch numbers for this shape.
inline bool needs_scratch(uint32_t rows, uint32_t depth) {
  return depth > 24 && rows >= 96;
}

struct DenseKernels {
  void (*update)(const Update& update, double* scratch);
  void (*subtract_dots)(const Dots& dots);
  // x := x L^-T for rows of length `columns`, whose columns stand `step` apart.
  void (*solve_block)(const DiagonalBlock& block, uint32_t rows, double* x, ptrdiff_t step);
  // Adds the rows k and below of an update's column, `from` its row 0, to a column of the front
  // whose first row is row `shift`. Row k is in the first run.
  void (*add_runs)(const Run* run, const Run* end, uint32_t k, const double* from, double* to,
                   uint32_t shift);
};

enum class Instructions { baseline, avx2, avx512 };

// Asks the processor and the operating system; the answer is not kept anywhere.
bool has_instructions(Instructions instructions);
Instructions best_instructions();

// The set must be one that the processor has.
DenseKernels dense_kernels(Instructions instructions);

inline uint32_t round_up_rows(uint32_t rows) {
  return (rows + 3) / 4 * 4;
}

}  // namespace wireskin::sparse
