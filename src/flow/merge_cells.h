// Cells between flat faces, and which of them are one: what lies between is no face of anything.
//
// In: the complex, its flat faces and their rims. Out: the cells, by tetrahedra and the outside;
// each face's state and the cells on its sides. A curve is where two faces make a crease: a third
// face at it is one too many, and two in one plane leave nothing to draw a curve for. Cells are
// merged, the outside among them, the best merger first, as long as that makes the curves' faults
// fewer: three or more faces count as their length, two that are flat as half as much again, fewer
// than two are not allowed. In passes over all faces left, each with all mergers that do not touch
// each other: few, but for faces round one curve, of which each may take a pass. Source: G.
// Markowsky, M. A. Wesley, "Fleshing Out Wire Frames", 1980, for cells; the weights are our own.
#pragma once

#include "flow/face_rims.h"

namespace wireskin::flow {

// Union-find over tetrahedra and the outside; a root is the least of its members.
struct CellForest {
  Array<uint32_t> parent;
  Array<uint8_t> solid;  // of each root: some tetrahedron of it is not flat

  explicit CellForest(Context& context) : parent(context), solid(context) {}
  uint32_t root_of(uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void join(uint32_t a, uint32_t b) {
    a = root_of(a);
    b = root_of(b);
    const uint32_t low = a < b ? a : b;
    solid[low] = static_cast<uint8_t>(solid[a] | solid[b]);
    parent[a < b ? b : a] = low;
  }
};

struct FaceCells {
  CellForest forest;
  Array<uint32_t> side;  // of each face two cells, or k_none

  explicit FaceCells(Context& context) : forest(context), side(context) {}
};

Status find_face_cells(const Complex& complex, const FlatFaces& faces, FaceRims* rims,
                       FaceCells* cells);

Status merge_cells(Context& context, const Drawing& drawing, const FlatFaces& faces, FaceRims* rims,
                   FaceCells* cells);

}  // namespace wireskin::flow
