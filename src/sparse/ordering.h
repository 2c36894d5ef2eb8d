// A fill-reducing order for the Cholesky factorisation of a sparse symmetric matrix: approximate
// minimum degree on the quotient graph.
//
// In: the pattern of the lower triangle (values are not read). Out: order[k] = the column
// eliminated k-th, a permutation of 0 .. n - 1. Only integers decide, ties by the last inserted, so
// the order is the same everywhere. Columns with more than 10 sqrt(n) neighbours go to the end.
// Cost: in practice close to linear in the entries; memory 2.4 words per entry
// stored and 18 per column.
//
// Source: Patrick Amestoy, Timothy Davis, Iain Duff, "An Approximate Minimum Degree Ordering
// Algorithm", 1996.
#pragma once

#include "sparse/csc.h"

namespace wireskin::sparse {

Status minimum_degree(const Csc& lower, Array<uint32_t>* order);

}  // namespace wireskin::sparse
