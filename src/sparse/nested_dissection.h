// A fill-reducing order for matrices that come from a surface of patches, by nested dissection: a
// separator, whose columns are eliminated last, splits the rest in two, again and again.
//
// In: the pattern of the lower triangle, and for each vertex a place in space and its patch; all
// columns of a vertex are kept together. Whole patches are separated from each other first, for
// across a curve one layer of vertices is enough where inside a patch it takes two; then each patch
// is halved across its longest side. The separator is the smaller of the two layers that touch each
// other. Out: order[k] = the column eliminated k-th. Equal places cost fill, never correctness;
// ties go by vertex number, so the order is the same everywhere. O(n log n), memory 2 words per
// entry and 12 per vertex. Source: Alan George, "Nested Dissection of a Regular Finite Element
// Mesh", 1973.
#pragma once

#include "num/vec.h"
#include "sparse/csc.h"

namespace wireskin::sparse {

struct Geometry {
  Span<const uint32_t> vertex;  // of each column, ascending; empty: column j is vertex j
  Span<const Vec3> position;    // of each vertex
  Span<const uint32_t> patch;   // of each vertex, small numbers

  bool empty() const { return position.empty(); }
};

Status nested_dissection(const Csc& lower, const Geometry& geometry, Array<uint32_t>* order);

}  // namespace wireskin::sparse
