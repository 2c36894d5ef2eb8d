// Solids of wireframes: which flat faces are faces of something, and which only cross its inside.
//
// In: the flat faces, any cycle in a plane among them. Out: for each triangle its turn in the
// search for voids, and the curves that are settled. The faces cut space into cells, and cells are
// merged where their curves need no face between (merge_cells.h): the floor of an attic goes, as do
// the lids of a hole, and the wall between two boxes in a row stays. Faces that part cells then are
// passed last; likewise, late, those of cells that curved faces leave open, where none of their
// curves has too many, and the lids of such (flat_lids.h). Linear but for these two. Source: G.
// Markowsky, M. A. Wesley, "Fleshing Out Wire Frames", 1980.
#pragma once

#include "flow/flat_lids.h"
#include "flow/persistence.h"

namespace wireskin::flow {

// Whether a curve has use for a wall: it has flat faces on both sides already, or on one.
enum class Need : uint8_t { open, settled, waiting };

struct FlatCells {
  Array<Pass> turn;  // of each triangle; empty where there are no faces
  Array<Need> need;  // of each edge of the curves, and of each chord
  bool any_settled = false;
  // Lids: of each the triangles in its middle, in all layers.
  Array<uint32_t> lid_start, lid_middle;
  bool given_up = false;  // on the faces

  explicit FlatCells(Context& context)
      : turn(context), need(context), lid_start(context), lid_middle(context) {}
};

Status find_flat_cells(Context& context, const Drawing& drawing, const FlatFaces& faces, Lids lids,
                       FlatCells* cells);

}  // namespace wireskin::flow
