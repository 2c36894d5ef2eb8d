// The voids that growing balls round the points enclose: which triangle closes a void, which
// tetrahedron is the last of it to be filled, and how much the balls grow in between.
//
// In: a complex with its values. Out: every triangle is a creator (it closes a void, and is paired
// with the tetrahedron that fills it) or a destroyer; voids by decreasing ratio. Valid for any
// values, as they are only compared; the outside is the void that is never filled.
// Cost: sorting the triangles, and almost linear union-find over the tetrahedra.
// Source: H. Edelsbrunner, D. Letscher, A. Zomorodian, "Topological Persistence and
// Simplification", 2002; J. B. Kruskal, "On the Shortest Spanning Subtree of a Graph", 1956.
#pragma once

#include "flow/complex.h"

namespace wireskin::flow {

struct Void {
  uint32_t creator;  // triangle
  uint32_t maximum;  // tetrahedron
  double creation;   // radius at which the creator closes it: sqrt f
  double filling;    // radius at which the maximum fills it: sqrt F, capped
  double ratio;  // filling / creation with both capped at sqrt(3/8) diagonal, the largest that a
                 // true maximum can have (H. Jung, 1901)
  bool held;     // the creator is passed last
};

// When a triangle is passed: before all others, and then it is no wall of anything; before all
// others; by its radius, or a little later than that, for walls that curves hold are surer than
// those of about the same radius in mid-air; after those; at last.
enum class Pass : uint8_t { hole, first, by_radius, flat, late, last };

struct Persistence {
  explicit Persistence(Context& context) : creator(context), void_of(context), voids(context) {}

  Array<uint8_t> creator;   // for each triangle 1, or 0 for a destroyer that may be a wall
  Array<uint32_t> void_of;  // for each triangle its place in voids, or k_none
  Array<Void> voids;  // held, or of ratio > 1 + 1e-6; held first, by decreasing ratio, then creator
};

// What is passed first parts nothing; what is passed last parts all that only it parts, however
// narrow or wide it is there (flat_cells.h). No turns: all by radius.
Status find_persistence(Context& context, const Complex& complex, Persistence* persistence,
                        Span<const Pass> turn = {});

}  // namespace wireskin::flow
