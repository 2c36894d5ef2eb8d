// Where curves come near each other: all places where the distance between two stretches of curve
// has a local minimum of at most a given reach.
//
// In: curves. Out: pairs of places with their distance. Edges are found by a tree of boxes,
// compared as straight lines, and the places then refined on local cubics, because between coarse
// samples curves that meet pass each other's chords at the height of the arc. O(n log n) for n
// samples, and the pairs of edges whose boxes meet. Fails with bad_argument where more places are
// within reach than 16 for each sample and one for each pair of curves, of these at most 262144; or
// more than 2^26 pairs of edges.
#pragma once

#include "network/wires.h"

namespace wireskin::network {

// The place that part (0 to below 1) of the way from sample `edge` to the next one; the last sample
// of an open curve has part 0.
struct WirePlace {
  uint32_t edge = k_none;
  double part = 0.0;
};

struct Approach {
  WirePlace a, b;  // a.edge <= b.edge
  Vec3 at_a, at_b;
  double distance = 0.0;
};

// The point of the curve there: on the cubic whose tangents at the samples are those of the
// parabolas through three of them, straight where there are only two or where the curve turns by
// more than 45 degrees.
Vec3 point_of_place(const Wires& wires, uint32_t curve, const WirePlace& place);

// The place nearest to `target` on the edge after sample i.
WirePlace nearest_on_edge(const Wires& wires, uint32_t curve, uint32_t i, const Vec3& target);

// In the order of edges.
Status find_approaches(const Wires& wires, Span<const uint32_t> curve, double reach,
                       Array<Approach>* approaches);

}  // namespace wireskin::network
