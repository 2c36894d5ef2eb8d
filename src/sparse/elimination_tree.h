// The elimination tree of a sparse Cholesky factor and what follows from it without forming the
// factor: a postorder and the number of entries in each column.
//
// parent[j] is the row of the first entry below the diagonal in column j of the factor, k_none for
// a root. Cost: nearly linear in the entries of the matrix, whatever the fill.
//
// Sources: Joseph Liu, "The Role of Elimination Trees in Sparse Factorization", 1990; John Gilbert,
// Esmond Ng, Barry Peyton, "An Efficient Algorithm to Compute Row and Column Counts for Sparse
// Cholesky Factorization", 1994.
#pragma once

#include "sparse/csc.h"

namespace wireskin::sparse {

Status elimination_tree(const Pattern& upper, Array<uint32_t>* parent);

// *order = the nodes of the forest, every subtree contiguous and its root last.
Status postorder(Span<const uint32_t> parent, Array<uint32_t>* order);

// Entries of each column of the factor, diagonal included. The columns must be in postorder.
Status column_counts(const Pattern& lower, Span<const uint32_t> parent, Array<uint32_t>* count);

}  // namespace wireskin::sparse
