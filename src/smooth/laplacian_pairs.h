// Approximate inverses of fairing systems that need the factors of Laplacians alone, for conjugate
// gradients where the memory cap leaves no room for the factor of the system itself.
//
// A fourth-order matrix L M^-1 L + P, with P diagonal, is near (S - L) M^-1 (S - L) with S M^-1 S =
// P. For the unknowns (u, h) of minimum variation (displace.h) the two blocks are taken one by one:
// u with the springs as P, h with 4 M as P and the smoothing length before its Laplacian; both
// factors together are a seventh of the system's. What couples u and h is left to the iteration,
// and so is the cut along the curves. Invariant: symmetric and positive definite. Cost: two
// factorisations, then four solves of size n an application.
// Source: K.-A. Mardal, R. Winther, "Preconditioning Discretizations of Systems of Partial
// Differential Equations", 2011.
#pragma once

#include "smooth/system.h"

namespace wireskin::smooth {

// The lower half of diag(shift) - scale L among the unknowns; no shift: zero.
Status shifted_laplacian(const sparse::Csc& laplacian, Span<const uint32_t> unknown,
                         uint32_t unknowns, double scale, Span<const double> shift,
                         sparse::Csc* part);

struct FairingBlocks {
  const sparse::Csc& laplacian;                  // of the mesh with its curves closed
  Span<const double> area;                       // of each vertex
  Span<const double> spring;                     // of each vertex, or empty
  Span<const uint32_t> displacement, curvature;  // numbers of the unknowns, k_none where held
  double smoothing_length;
  Places places;
};

class LaplacianPairs {
 public:
  explicit LaplacianPairs(Context& context) : u_(context), h_(context) {}

  // A memory cap that does not even allow this is a status.
  Status build(const FairingBlocks& blocks);
  sparse::LinearOperator linear_operator() { return {&apply, this}; }

 private:
  // One block: a factor, and where its unknowns stand in the system.
  struct Block {
    sparse::Cholesky factor;
    Array<uint32_t> unknown;
    Array<double> area;
    Array<double> value;

    explicit Block(Context& c) : factor(c), unknown(c), area(c), value(c) {}
  };

  static Status factor_block(const FairingBlocks& blocks, Span<const uint32_t> numbers,
                             double scale, Span<const double> shift, Block* block);
  static Status apply_block(Span<const double> x, Span<double> y, Block* block);
  static Status apply(void* self, Span<const double> x, Span<double> y);

  Block u_, h_;
};

}  // namespace wireskin::smooth
