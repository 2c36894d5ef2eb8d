// Solids of wireframes: which flat faces are faces of something, and which only cross its inside.
//
// In: the flat faces, any cycle in a plane among them. Out: for each triangle its turn in the
// search for voids, and the curves that are settled. The faces cut space into cells. A face stays
// if its rim needs it: a curve is where two faces make a crease, so a third face at a curve is one
// too many, and two in one plane leave nothing to draw a curve for. Cells are merged, the outside
// among them, the best merger first, as long as that makes the curves' faults fewer: three or more
// faces count as their length, two that are flat as half as much again, none at all is not allowed.
// So the floor of an attic goes, as do the lids of a hole, and the wall between two boxes in a row
// stays. Faces that part cells then are passed last; likewise those of cells that curved faces
// leave open, where none of their curves has too many. Near-linear. Sources: G. Markowsky, M. A.
// Wesley, "Fleshing Out Wire Frames", 1980, for cells and edges; the weights are our own.
#pragma once

#include "flow/flat_faces.h"
#include "flow/persistence.h"

namespace wireskin::flow {

// Whether a curve has use for a wall: it has flat faces on both sides already, or on one.
enum class Need : uint8_t { open, settled, waiting };

struct FlatCells {
  Array<Pass> turn;  // of each triangle; empty where there are no faces
  Array<Need> need;  // of each edge of the curves, and of each chord
  bool any_settled = false;

  explicit FlatCells(Context& context) : turn(context), need(context) {}
};

Status find_flat_cells(Context& context, const Complex& complex, const Samples& samples,
                       const CurveEdges& curves, const StraightLines& lines, const FlatFaces& faces,
                       FlatCells* cells);

}  // namespace wireskin::flow
