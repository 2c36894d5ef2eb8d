// What the border of a patch looks at: from every place of a loop along its conormal, which points
// into the patch along the surface, to the nearest place whose conormal looks back.
//
// In: borders of patches. Out: places thinned to at most 32 a loop, and of each place what it sees.
// The way between two places that turn by angles a and b from the chord, and whose normals differ
// by t when carried along, counts as chord 8 / ((1 + cos a) (1 + cos b) (1 + cos t)); where the
// place met would rather look elsewhere it counts as more in that proportion. Of its own loop a
// place sees what is not beside it. Nothing is seen beyond four times the loop's length. Places
// stand in a tree of boxes: O(n log^2 n) to build, and about O(log n) a look. The curvature of the
// patch that a loop would bound alone follows from how it turns (C. F. Gauss, 1827; O. Bonnet,
// 1848).
#pragma once

#include "network/border.h"

namespace wireskin::network {

struct SightLoop {
  uint32_t patch;
  bool reversed;          // the other side of a ring
  uint32_t first, count;  // of the places
  double curvature;       // of a disc inside the loop
  double reach;           // how far it looks at most
};

struct SightPlace {
  Vec3 position, conormal, normal;
  uint32_t loop;
};

struct SightBox {
  Vec3 low, high;
  uint32_t first, count;  // in `order`
  uint32_t second;        // the right child, the left one follows; k_none in a leaf
};

// What a place sees; `loop` k_none: nothing.
struct Sight {
  uint32_t loop = k_none;
  double way = 0.0;     // in proportion more where the place seen rather looks elsewhere
  double cosine = 0.0;  // between conormal and chord
};

struct SightMap {
  const Lists& corner;  // of each patch: the vertices where its segments end, ascending
  Array<SightLoop> loop;
  Array<SightPlace> place;
  Array<uint32_t> order;
  Array<SightBox> box;
  Array<double> nearest;  // of each place: the way to what it sees, negative before it was asked

  SightMap(Context& context, const Lists& corners)
      : corner(corners),
        loop(context),
        place(context),
        order(context),
        box(context),
        nearest(context) {}
};

// The integral of the curvature over a disc inside a loop, from how the loop turns.
double curvature_inside(const Border& border, uint32_t loop);

// Whether all normals of a loop are known.
bool knows_normals(const Border& border, uint32_t loop);

Status add_sight_loop(const Border& border, uint32_t loop, uint32_t patch, bool reversed,
                      SightMap* map);

// Once all loops were added.
Status build_sight_tree(SightMap* map);

// How the surface turns on its way from p to q: the cosines of the chord with the conormal of p and
// against that of q, and of the normals when that of p is carried along.
struct SightTurn {
  double chord, out, back, twist;
};
SightTurn turn_between(const SightPlace& p, const SightPlace& q);

// About how long the surface is from p to q; negative where they do not look at each other.
double way_between(const SightPlace& p, const SightPlace& q);

// What place i sees. Loops that are `hidden` do not count, nor those that pass the same vertex.
Sight look(SightMap* map, uint32_t i, Span<const uint8_t> hidden);

}  // namespace wireskin::network
