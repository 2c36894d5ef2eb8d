// The sides of closed curves with places round them, and how much area a band between two takes.
//
// In: borders of patches. Out: sides, and for each the few others between which a band is least, of
// the nearest ones. A band is taken place by place round both sides, the second against the first
// and shifted for the least sum; a way from place to place counts as chord 8 / ((1 + cos a) (1 +
// cos b) (1 + cos t)) for its turns a and b and its twist t. The lid over a circle of area A is 2 A
// / (1 + m) times (2 / (1 + m))^2 for the mean cosine m between normals and axis: so rims that bend
// back, walls and lids compare by one measure. O(1) for a band, whatever the loops; for the lists
// O(n^2) in the distances of sides, and O(n) bands where few are the least for many.
#pragma once

#include "network/border.h"
#include "network/sight.h"

namespace wireskin::network {

// So many places of each side, evenly along its vertices.
inline constexpr uint32_t k_ring_places = 32;
// So many other sides each one keeps in mind.
inline constexpr uint32_t k_ring_choices = 12;

struct RingSide {
  uint32_t patch = 0;
  uint32_t component = 0;
  bool reversed = false;
  double lid = 0.0;         // the area of closing it by itself
  double alone = 0.0;       // what that costs, more where it can hardly be done
  double cosine = 0.0;      // at which it looks across itself then
  uint32_t twin = k_none;   // the other side of a ring of boundary curves
  uint32_t other = k_none;  // the other side of an untagged curve
  double length = 0.0;
  Vec3 centre;
};

struct RingBand {
  uint32_t a, b;  // sides, a < b
  double cost;    // the area, less where the sides look straight at each other
  double cosine;  // between conormals and ways, in the mean at the end where it is less
};

struct RingBands {
  Array<RingSide> side;
  Array<SightPlace> place;  // k_ring_places of each side
  Array<RingBand> band;     // by cost

  explicit RingBands(Context& context) : side(context), place(context), band(context) {}
};

Status add_ring_side(const Border& border, const RingSide& side, RingBands* bands);

// So many times the area of closing both sides alone a band between them may have: what goes on
// straight is a tube rather than two lids.
inline double band_weight(double cosine) {
  return 0.85 + 5.0 * (cosine < 0.0 ? 0.0 : cosine > 0.5 ? 0.5 : cosine);
}

// The least band between two sides.
RingBand band_between(const RingBands& bands, uint32_t a, uint32_t b);

// Lists for each side its nearest others that are worth a band.
Status list_ring_bands(RingBands* bands);

}  // namespace wireskin::network
