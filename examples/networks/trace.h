// Traces the cycles of a network, as an independent check of networks that are to be surfaced: are
// all patches discs, and is each of them seen without folds along its mean normal?
//
// Segments round a node are sorted by the angle of their first chord in the node's tangent plane;
// cycles keep their face to the left (Stanko et al., "Surfacing Curve Networks with Normal
// Control", 2016, section 3.2). Cycles of boundary curves only bound nothing and are dropped. The
// test for crossings is plain O(n^2) in double precision, for checking examples only.
#pragma once

#include "network.h"

namespace networks {

struct Patch {
  std::vector<uint32_t> vertices;  // the cycle, its face to the left
  double mean_normal = 0.0;        // length of the mean of the cycle's unit normals
  double least_facing = 0.0;       // least cosine between a normal of the cycle and their mean
  bool simple =
      false;  // the projection along the mean normal is a counter-clockwise simple polygon
  bool robust = false;  // and stays so when the direction is tilted by 5 degrees to four sides
};

struct Trace {
  size_t nodes = 0;
  size_t segments = 0;
  size_t components = 0;
  std::vector<Patch> patches;

  // Of the surface, if every patch is a disc.
  long euler_characteristic() const {
    return static_cast<long>(nodes) - static_cast<long>(segments) +
           static_cast<long>(patches.size());
  }
};

Trace trace(const Network& network);

}  // namespace networks
