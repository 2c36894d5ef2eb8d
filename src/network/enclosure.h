// Curves that lie inside a patch without being connected to its border: they ought to be a second
// loop of the border (a hole) or to hold the patch's inside, and a patch of one loop must not
// ignore them.
//
// In: the curve vertices and segments (for the components), then one patch after the other with its
// border in its plane. A component is inside where all its vertices project into the border's
// polygon, no farther from the plane than the border itself and a twentieth of its width. Cost: one
// point-in-polygon test for each pair of patch and component, all vertices where it hits.
#pragma once

#include "network/plane.h"

namespace wireskin::network {

class Enclosure {
 public:
  explicit Enclosure(Context& context) : component_(context), start_(context), member_(context) {}
  Status find_components(const Network& network, const CurveVertices& vertices);

  // Fails with patch_several_loops, naming the curve.
  Status check(const CurveVertices& vertices, Span<const uint32_t> border, Span<const Vec2> polygon,
               const Plane& plane) const;

 private:
  Array<uint32_t> component_;       // of each curve vertex
  Array<uint32_t> start_, member_;  // the vertices of each component
};

}  // namespace wireskin::network
