// The Delaunay triangulation of points in space: tetrahedra whose circumscribed balls hold no point
// inside. Points come one at a time; the tetrahedra in whose balls one lies make room for others.
//
// In: points, in any position; those at the same place are one. Out: positively oriented
// tetrahedra, 32 bytes each, linked face to face. All decisions are exact (num/predicates3.h). Of
// more than four points on one empty sphere each counts as outside the spheres of those before it,
// as if it were lifted by an infinitesimal far beyond theirs: the result is a triangulation, and
// depends on the places only, not on the numbers.
// Cost: about 4 microseconds a point where the result is linear; quadratic at worst.
// Source: A. Bowyer, "Computing Dirichlet Tessellations", 1981; H. Edelsbrunner, "An Acyclicity
// Theorem for Cell Complexes in d Dimensions", 1990 (why every walk ends).
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::flow {

struct Tetrahedron {
  uint32_t vertex[4];  // det(b - a, c - a, d - a) > 0
  uint32_t across[4];  // behind the face opposite to the vertex: 4 * tetrahedron + its face, or
                       // k_none on the hull
};

struct Delaunay {
  explicit Delaunay(Context& context) : tets(context), same_as(context) {}

  Array<Tetrahedron> tets;
  Array<uint32_t> same_as;  // for each point the least number of a point at the same place; only
                            // that one occurs in tets
  uint32_t places = 0;      // different points
  int dimension = -1;       // of what they span: without volume (below 3) there are no tetrahedra
};

// `most_tets` bounds the tetrahedra that stand at any time, with one for each face of the hull
// (2^28 at most); more are the status `too_large`. Coordinates that are not finite or outside the
// range of num/predicates3.h are `bad_argument`.
Status triangulate(Context& context, Span<const Vec3> points, uint32_t most_tets,
                   Delaunay* delaunay);

}  // namespace wireskin::flow
