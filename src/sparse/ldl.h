// L D L^T factorisation of a very sparse symmetric positive definite matrix, column by column, and
// the entries of its inverse that stand where the factor has entries: among them the diagonal.
//
// For systems whose factor has a handful of entries per column, where the panels of the supernodal
// Cholesky do not pay, and for traces of inverses. Analyse the pattern once, then factor, solve and
// invert as often as the values change. Invariants: as for Cholesky. Memory: 2.5 words per entry of
// the factor, 1.5 per entry of the matrix, about 5 per column; only analyse() and solve() allocate.
// Cost of inverse_diagonal(): up to twice that of factor().
//
// Sources: Timothy Davis, "Algorithm 849: A Concise Sparse Cholesky Factorization Package", 2005;
// K. Takahashi, J. Fagan, M. Chen, "Formation of a Sparse Bus Impedance Matrix and Its Application
// to Short Circuit Study", 1973.
#pragma once

#include "sparse/csc.h"

namespace wireskin::sparse {

class Ldl {
 public:
  explicit Ldl(Context& context);

  // Reads the pattern of the lower triangle; order[k] is the column to be eliminated k-th.
  Status analyse(const Csc& lower, Span<const uint32_t> order);

  // Reads the values of a matrix with the pattern analysed. A pivot that is not positive and finite
  // is `not_positive_definite`, place.vertex its column.
  Status factor(const Csc& lower);

  // x := A^-1 x, an n x columns block stored row by row. Cancelled it may have written part of x.
  Status solve(Span<double> x, uint32_t columns);

  // The diagonal of A^-1.
  Status inverse_diagonal(Span<double> diagonal);

  size_t nonzeros() const { return row_.size() + order_.size(); }

 private:
  uint32_t find_row_pattern(uint32_t k);
  Status count_work(size_t work);

  Context* context_;
  bool factored_ = false;
  size_t work_ = 0;        // multiplications since the last checkpoint
  Array<uint32_t> order_;  // and below everything is numbered in the order of elimination
  Pattern upper_;
  Array<uint32_t> parent_;  // the elimination tree
  Array<uint32_t> start_;   // of each column of L below the diagonal
  Array<uint32_t> row_;
  Array<double> value_, diagonal_;
  Array<double> inverse_, inverse_diagonal_;

  Array<uint32_t> filled_;   // entries of each column of L so far
  Array<uint32_t> visited_;  // the last row whose pattern a column was found in
  Array<uint32_t> pattern_, path_;
  Array<double> column_, sum_;
  Array<double> permuted_;
};

}  // namespace wireskin::sparse
