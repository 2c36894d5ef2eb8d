// The graph of a curve network: segments of curve between nodes, and the cycles that bound patches.
//
// Seen from the tip of a node's normal the segments round it have a cyclic order. Who enters a node
// by one segment and leaves it by the next one clockwise keeps one patch on the left all the way
// round: so every side of every segment lies on exactly one cycle. Beyond the boundary there is no
// surface: the cycles there are dropped.
//
// Invariants: half-segment 2 s runs along its curve, 2 s + 1 against it, each with a patch on its
// left; of a boundary segment exactly one has one. O(samples + segments log segments). Source: T.
// Stanko et al., "Surfacing Curve Networks with Normal Control", 2016, section 3.2.
#pragma once

#include "curves/curve.h"
#include "network/nodes.h"

namespace wireskin::network {

struct Segment {
  uint32_t curve;
  uint32_t first_knot, last_knot;  // last_knot > first_knot
  uint32_t from, to;               // nodes; k_none both for a closed curve without node
  bool boundary;
};

inline uint32_t opposite(uint32_t half_segment) {
  return half_segment ^ 1u;
}

struct Network {
  Array<Segment> segment;
  Array<uint32_t>
      patch_start;  // patch p has the half-segments patch_start[p] .. patch_start[p + 1)
  Array<uint32_t> half_segment;  // the cycles one after the other

  explicit Network(Context& context)
      : segment(context), patch_start(context), half_segment(context) {}
  uint32_t patches() const {
    return patch_start.empty() ? 0 : static_cast<uint32_t>(patch_start.size() - 1);
  }
  Span<const uint32_t> cycle(uint32_t patch) const {
    return half_segment.span().part(patch_start[patch],
                                    patch_start[patch + 1] - patch_start[patch]);
  }
};

// `boundary`: of each curve, whether the surface ends there. Fails with open_network at dangling
// ends and at boundary curves with surface on both sides, with tangent_normal or
// inconsistent_normals at nodes whose segments have no order, with patch_several_loops where a
// cycle passes a segment twice.
Status find_patches(const curves::Curves& curves, Span<const uint8_t> boundary,
                    Span<const Node> nodes, Network* network);

}  // namespace wireskin::network
