// Soft constraints: curves that pull instead of hold, for measured data.
//
// A soft vertex is free, and a spring of stiffness (half the length of its curve edges) /
// cutoff^(2k - 1) draws it to its given place, k the order of the Laplacian that is minimised:
// details of the curve shorter than about the cutoff length are smoothed away, longer ones are
// kept. Scaling the network and the cutoff together scales the result, and refining the mesh does
// not change it: that is what sets this apart from a bare weight. Normals have a cutoff of at least
// four spacings, being noisier. Source: T. Stanko et al., "Surfacing Curve Networks with Normal
// Control", 2016, section 4.5, with a weight that has a length.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::smooth {

struct Soft {
  Span<const double>
      cutoff;  // of each vertex; zero where it is held or free. Empty: nothing is soft
  Span<const double> share;   // of each vertex: half the length of its curve edges
  Span<const Vec3> position;  // where each soft vertex is drawn to
  Span<const Vec3> normal;    // unit
  double spacing = 0.0;       // of the curves

  bool any() const { return !cutoff.empty(); }
  double normal_cutoff(size_t v) const {
    return cutoff[v] > 4.0 * spacing ? cutoff[v] : 4.0 * spacing;
  }
};

// share / cutoff^(2 order - 1).
inline double spring(double share, double cutoff, int order) {
  double stiffness = share / cutoff;
  for (int k = 1; k < order; ++k) stiffness = stiffness / (cutoff * cutoff);
  return stiffness;
}

}  // namespace wireskin::smooth
