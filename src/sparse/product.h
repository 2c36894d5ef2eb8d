// The weighted product of two sparse matrices, A diag(w) B, cut down to the rows and columns of the
// unknowns: how the systems of variational smoothing arise from a Laplacian.
//
// In: A and B in compressed columns, a weight for each inner index, and the number that each row
// and column of the product has among the unknowns (k_none: left out). Out: the product, columns
// sorted. Entries are summed in ascending inner index. Cost: the multiplications of the product,
// and a few more to guess its size. Source: F. Gustavson, "Two Fast Algorithms for Sparse Matrices:
// Multiplication and Permuted Transposition", 1978.
#pragma once

#include "sparse/csc.h"

namespace wireskin::sparse {

enum class Part { all, lower };

// `unknown` numbers rows and columns alike, ascending. With Part::lower only entries on and below
// the diagonal are made; every column must then have its diagonal in the product's pattern.
Status weighted_product(const Csc& a, Span<const double> weight, const Csc& b,
                        Span<const uint32_t> unknown, uint32_t unknowns, Part part, Csc* product);

}  // namespace wireskin::sparse
