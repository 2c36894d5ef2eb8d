// The topological reconstruction: which voids there are, and the walls between them.
//
// In: the complex, its voids, the curves' edges. Out: the voids chosen, and the triangles left
// after peeling, opening of handles and removal of walls that no curve bounds. Invariants: walls
// separate exactly the chosen voids and the outside; no piece of curve that had a triangle loses
// its last. A void counts if its wall ends on curves that have use for it (round tubes feign
// others); those behind flat faces or waiting for one more whatever their ratio. Then triangles
// with one void on both sides go, greatest radius first, unless they are fins. O(triangles) for a
// void tried, near-linear else. Source: B. Sadri, K. Singh, "Flow-Complex-Based Shape
// Reconstruction from 3D Curves", 2014, section 4.3 and figure 13.
#pragma once

#include "flow/flat_cells.h"
#include "flow/sheet.h"

namespace wireskin::flow {

inline constexpr int32_t k_automatic_voids = -1;

struct TopologyOptions {
  int32_t voids = k_automatic_voids;
  double least_ratio = 1.05;  // of a void chosen automatically: amid 1.03 to 1.1, which do alike
  bool open_walls = false;    // keep walls with borders that are no curves
};

struct Topology3 {
  Array<uint32_t> chosen;  // places in Persistence::voids
  uint32_t untried = 0;    // voids that might have been chosen, past the most that are tried
  Sheet walls;             // the result
  Sheet closed;            // before handles and open walls were removed
  Array<uint32_t> label;   // of each tetrahedron, and of the outside (last): its void's root

  explicit Topology3(Context& context)
      : chosen(context), walls(context), closed(context), label(context) {}
};

// What a wall ends on, as lengths.
struct WallBorder {
  double whole = 0.0;
  double loose = 0.0;    // off the curves and their chords
  double in_face = 0.0;  // of that, where it merges into a flat face that waits for others
  double settled = 0.0;  // on curves that have no use for the wall
  double waiting = 0.0;  // on curves that have a flat face on their other side

  // No curve is there for the sake of the wall, or few. Where no flat face settles any curve this
  // tells nothing: sketches are full of walls that end at others.
  bool is_idle() const { return loose + settled > 0.6 * whole; }
  // Curves are there that lack only this wall; it may reach the flat faces at them a little early.
  bool is_wanted() const {
    return waiting >= 0.6 * whole && settled + loose - in_face <= 0.1 * whole;
  }
};

WallBorder measure_border(const Complex& complex, const CurveEdges& curves, const FlatCells& cells,
                          const Sheet& sheet, Span<const uint32_t> wall);

// The components of the complement of a sheet: joins all tetrahedra not separated by it. The
// outside is the last entry. Labels are least members.
Status label_rooms(const Complex& complex, const Sheet& sheet, Array<uint32_t>* label);

Status choose_voids(Context& context, const Complex& complex, const CurveEdges& curves,
                    const FlatCells& cells, const Persistence& persistence,
                    const TopologyOptions& options, Array<uint32_t>* chosen, uint32_t* untried);

Status reconstruct_topology(Context& context, const Complex& complex, const CurveEdges& curves,
                            const FlatCells& cells, const Persistence& persistence,
                            const TopologyOptions& options, Topology3* topology);

}  // namespace wireskin::flow
