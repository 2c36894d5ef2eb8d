// The graph of a curve network: segments of curve between nodes, and the cycles that bound patches.
//
// Seen from the tip of a node's normal the segments round it have a cyclic order. Who enters a node
// by one segment and leaves it by the next one clockwise keeps one patch on the left all the way
// round: so every side of every segment lies on exactly one cycle. Beyond the boundary there is no
// surface: the cycles there are dropped. A segment with the same cycle on both sides lies inside
// its patch (it dangles, or joins two loops); what is left of the cycle without such segments are
// the loops of the patch. Loops of different connected components come together in network/group.h.
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

// Lists one after the other: list i has the items start[i] .. start[i + 1).
struct Lists {
  Array<uint32_t> start, item;

  explicit Lists(Context& context) : start(context), item(context) {}
  uint32_t count() const { return start.empty() ? 0 : static_cast<uint32_t>(start.size() - 1); }
  Span<const uint32_t> operator[](uint32_t i) const {
    return item.span().part(start[i], start[i + 1] - start[i]);
  }
  // Ends the list to which items were pushed since the last one ended.
  Status close() {
    if (start.empty()) TRY(start.push(0));
    return start.push(static_cast<uint32_t>(item.size()));
  }
};

struct Network {
  Array<Segment> segment;
  Lists loop;                   // half-segments, each loop with its patch on the left
  Array<uint32_t> patch_start;  // patch p has the loops patch_start[p] .. patch_start[p + 1)
  Lists inner;                  // of each patch: segments inside it, the same patch on both sides
  Lists point;                  // of each patch: nodes inside it that no segment meets
  // Of each patch: a closed chain of boundary curves that no other curve meets, so that either side
  // of it may be the one with the surface. The loop given is the one that runs counter-clockwise.
  Array<uint8_t> ring;
  Lists loose;  // segments joined to nothing that bounds a patch, connected ones together

  explicit Network(Context& context)
      : segment(context),
        loop(context),
        patch_start(context),
        inner(context),
        point(context),
        ring(context),
        loose(context) {}
  uint32_t patches() const {
    return patch_start.empty() ? 0 : static_cast<uint32_t>(patch_start.size() - 1);
  }
  // The half-segments of all loops of a patch.
  Span<const uint32_t> cycle(uint32_t patch) const {
    const uint32_t first = loop.start[patch_start[patch]];
    return loop.item.span().part(first, loop.start[patch_start[patch + 1]] - first);
  }
};

// `boundary`: of each curve, whether the surface ends there. Every cycle becomes a patch of its
// own. Fails with open_network at ends without node, at boundary curves with surface on both sides
// and at curves where there is no surface, with tangent_normal or inconsistent_normals at nodes
// whose segments have no order, with patch_several_loops where a patch would have a handle.
// `faults`, if given, gets what is wrong at each segment instead, except for ends without node and
// handles of loose pieces: no patch at such a segment is to be made.
Status find_patches(const curves::Curves& curves, Span<const uint8_t> boundary,
                    Span<const Node> nodes, Network* network, Array<Status>* faults = nullptr);

}  // namespace wireskin::network
