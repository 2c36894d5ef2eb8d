// Loops as those see them that ask what they face: thinned to places with their conormals, which
// point into the patch along the surface.
//
// In: borders of patches. Out: places, the area of a band between two loops, and which loop a place
// looks at. All take time in proportion to the places they compare.
#pragma once

#include "network/border.h"

namespace wireskin::network {

// A side of a loop that may face another one: a thinned list of its vertices.
struct Facing {
  uint32_t patch;
  bool reversed;
  uint32_t first, count;  // of the probes
  bool needy;             // hard to close alone
  double alone;           // what closing it costs
  Vec3 centre;
  double radius;
  bool sideless = false;  // a ring whose normals do not tell on which side it could be closed
};

struct Probe {
  Vec3 position, conormal;
  double share;  // of the length of the loop
};

Status add_facing(const Border& border, uint32_t loop, uint32_t patch, bool reversed, double cosine,
                  double area, Array<Facing>* facing, Array<Probe>* probes);

// The area of a band from a's probes to the nearest ones of b, more where its conormals lead
// elsewhere; negative where they do not lead there.
double half_band(const Facing& a, const Facing& b, Span<const Probe> probes, double least_cosine);

// The patch that a place of a loop looks at, and how far along the surface that is.
struct Sight {
  uint32_t loop = k_none;
  double distance = DBL_MAX;
};

// The nearest place whose conormal looks back: the way between two conormals that turn by a and b
// from the chord is longer than it by about 2 / (1 + cosine) of either. Loops that are `hidden` do
// not count.
Sight look(const Probe& p, Span<const Facing> facing, Span<const Probe> probes,
           Span<const uint8_t> hidden);

}  // namespace wireskin::network
