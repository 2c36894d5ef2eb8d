// Cholesky factorisation of a sparse symmetric positive definite matrix, P A P^T = L L^T, in three
// steps: analyse the pattern once, factor as often as the values change, solve as often as there
// are right-hand sides. Multifrontal: each supernode is assembled from the matrix and the update
// matrices of its children, and factored as a dense panel. Invariants: a failed analyse() or
// factor() leaves no factor behind, and solve() then says so; the same bits for a first factor()
// and a repeated one, for one right-hand side and for many, for every instruction set and any
// number of threads. Memory: factor_bytes(), used again by later factors, 2 words per entry of the
// matrix, about 8 per column.
// Sources: Iain Duff, John Reid, "The Multifrontal Solution of Indefinite Sparse Symmetric Linear
// Equations", 1983; Esmond Ng, Barry Peyton, "Block Sparse Cholesky Algorithms on Advanced
// Uniprocessor Computers", 1993.
#pragma once

#include "sparse/fronts.h"
#include "sparse/panel.h"

namespace wireskin::sparse {

class Cholesky {
 public:
  explicit Cholesky(Context& context, Instructions instructions = best_instructions());

  // Reads the pattern of the lower triangle; order[k] is the column to be eliminated k-th.
  Status analyse(const Csc& lower, Span<const uint32_t> order);

  // What the numerical factor will need beside the analysis, known after analyse().
  size_t factor_bytes() const;

  // Reads the values of a matrix with the pattern analysed. A pivot that is not positive and finite
  // is `not_positive_definite`, place.vertex its column.
  Status factor(const Csc& lower);

  // Gives back what only another factor() would need; the next one begins with analyse().
  void end_factoring();

  // x := A^-1 x, an n x columns block stored row by row. Cancelled it may have written part of x.
  Status solve(Span<double> x, uint32_t columns);

  // Entries of the factor, without the zeros that the panels add.
  size_t nonzeros() const { return nonzeros_; }
  double multiplications() const { return fronts_.work; }
  uint32_t size() const { return n_; }

 private:
  struct Batch;

  uint32_t slots() const;
  size_t scratch_size() const;
  Status allocate_workspace();
  Status locate_entries();
  Panel panel_of(uint32_t s);
  void assemble(uint32_t s, const double* source, uint32_t first, uint32_t end);
  Status assemble_in_parts(uint32_t s, const double* source);
  void add_child(uint32_t c, const Panel& panel, uint32_t first, uint32_t end);
  uint32_t factor_supernode(uint32_t s, const double* source, const PanelTools& tools);
  static void factor_task(uint32_t index, void* batch);
  Status factor_one_task(const Task& task, const double* source);
  Status factor_tasks(uint32_t first, uint32_t end, const double* source);
  Status factor_step(const Step& step, const double* source);
  Status refuse_column(uint32_t s, uint32_t column) const;
  size_t lane_step() const { return round_up_rows(tallest_) + 4; }
  Status solve_forward(uint32_t s, uint32_t lanes);
  Status solve_backward(uint32_t s, uint32_t lanes);
  Status count_work(uint64_t work);

  Context* context_;
  DenseKernels kernels_;
  uint32_t n_ = 0;
  uint32_t tallest_ = 0;  // rows of a panel, at most
  size_t nonzeros_ = 0;
  uint64_t work_ = 0;  // since the last checkpoint
  bool analysed_ = false;
  bool factored_ = false;
  Array<uint32_t> order_;
  Pattern lower_;  // the permuted matrix, column by column; index: the row's place in its panel
  Supernodes supernodes_;
  Fronts fronts_;
  Array<double> value_;      // the panels
  Array<double> workspace_;  // the update matrices; in solve() the right-hand sides
  Array<double> scratch_;    // of the kernels, for each thread
};

}  // namespace wireskin::sparse
