// Loops as those see them that ask what they face: thinned to places with their conormals, which
// point into the patch along the surface.
//
// In: borders of patches. Out: places, and the area of a band between two loops, in time in
// proportion to the pairs of places.
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

}  // namespace wireskin::network
