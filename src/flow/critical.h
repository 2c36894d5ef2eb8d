// Critical points of the distance from a point set: the simplices that are swallowed alone, where
// the topology of the union of growing balls changes.
//
// In: a complex. The question is asked of its points (gabriel.h), not of its rounded values, so the
// answer is right without a jitter, too, where no exact ties are. Out: minima (the points), saddles
// of index 1 (edges) and 2 (triangles), and maxima (tetrahedra), in the order of their numbers. The
// maximum at infinity is not counted.
// Source: D. Siersma, "Voronoi Diagrams and Morse Theory of the Distance Function", 1999; U. Bauer,
// H. Edelsbrunner, "The Morse Theory of Cech and Delaunay Complexes", 2017.
#pragma once

#include "flow/complex.h"

namespace wireskin::flow {

struct CriticalPoints {
  explicit CriticalPoints(Context& context) : edge(context), triangle(context), tet(context) {}

  uint32_t points = 0;  // different ones
  Array<uint32_t> edge, triangle, tet;

  // 1 wherever there are no exact ties.
  int64_t euler() const {
    return static_cast<int64_t>(points) - static_cast<int64_t>(edge.size()) +
           static_cast<int64_t>(triangle.size()) - static_cast<int64_t>(tet.size());
  }
};

Status find_critical_points(const Complex& complex, CriticalPoints* critical);

}  // namespace wireskin::flow
