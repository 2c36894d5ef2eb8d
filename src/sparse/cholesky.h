// Cholesky factorisation of a sparse symmetric positive definite matrix, P A P^T = L L^T, in three
// steps: analyse the pattern once, factor as often as the values change, solve as often as there
// are right-hand sides. Supernodal and left-looking: each panel collects the updates of the panels
// to its left and is then factored as a dense matrix.
//
// Invariants: a failed analyse() or factor() leaves no factor behind, and solve() then says so. The
// same input gives the same bits, for a first factor() and a repeated one, for one right-hand side
// and for many. Memory: the panels, 2 words per entry of the matrix, about 8 per column; factor()
// allocates none.
//
// Source: Esmond Ng, Barry Peyton, "Block Sparse Cholesky Algorithms on Advanced Uniprocessor
// Computers", 1993.
#pragma once

#include "sparse/supernodes.h"

namespace wireskin::sparse {

class Cholesky {
 public:
  explicit Cholesky(Context& context);

  // Reads the pattern of the lower triangle; order[k] is the column to be eliminated k-th.
  Status analyse(const Csc& lower, Span<const uint32_t> order);

  // Reads the values of a matrix with the pattern analysed. A pivot that is not positive and finite
  // is `not_positive_definite`, place.vertex its column.
  Status factor(const Csc& lower);

  // x := A^-1 x, an n x columns block stored row by row.
  Status solve(Span<double> x, uint32_t columns);

  // Entries of the factor, without the zeros that the panels add.
  size_t nonzeros() const { return nonzeros_; }
  uint32_t size() const { return n_; }

 private:
  Status allocate_workspace(size_t entries);
  void assemble(uint32_t s, const double* source);
  Status apply_update(uint32_t from, uint32_t to);
  Status apply_updates(uint32_t s);
  Status factor_panel(uint32_t s);
  void link(uint32_t s);
  void solve_forward(uint32_t s, uint32_t columns);
  void solve_backward(uint32_t s, uint32_t columns);
  void gather_tail(uint32_t s, uint32_t columns);
  Status count_work(size_t work);
  Status count_solve(uint32_t s, uint32_t columns);

  Context* context_;
  uint32_t n_ = 0;
  size_t nonzeros_ = 0;
  bool analysed_ = false;
  bool factored_ = false;
  size_t work_ = 0;  // multiplications since the last checkpoint
  Array<uint32_t> order_;
  Pattern lower_;  // the permuted matrix, column by column
  Supernodes supernodes_;
  Array<double> value_;

  // A supernode waits in the list of the supernode that its next unused row belongs to.
  Array<uint32_t> waiting_;
  Array<uint32_t> next_;
  Array<uint32_t> used_;      // rows of a supernode that have been used
  Array<uint32_t> position_;  // of a row in the panel under construction
  Array<uint32_t> relative_;  // positions of the rows of one update

  Array<double> permuted_;  // the right-hand sides in elimination order
  Array<double> tail_;      // those of the rows below one supernode
};

}  // namespace wireskin::sparse
