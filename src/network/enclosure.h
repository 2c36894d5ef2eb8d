// Which patch encloses each connected component of the curves: a curve inside a patch without being
// connected to its border is a second loop of the border, or holds the patch's inside.
//
// In: network and curve vertices, every cycle a patch of its own. A component is enclosed where all
// its vertices project into the patch's border, no farther from its plane than the border itself
// and a share of its width (a twentieth; half of it for pieces that bound nothing themselves and
// face the way the patch does). Of several such patches the one counts that is least in the sum of
// its size and four times how far the component lies beyond the border's heights. Cost: components
// are sorted by place, so a patch looks only at those in its own range of x; all vertices where a
// piece's first vertex is inside.
#pragma once

#include "network/plane.h"

namespace wireskin::network {

struct Components {
  Array<uint32_t> of_vertex;  // of each curve vertex; a node without segments is one of its own
  Lists members;              // the vertices of each component
  Array<uint8_t> bounds;      // of each component: has a cycle that bounds a patch

  explicit Components(Context& context) : of_vertex(context), members(context), bounds(context) {}
};

Status find_components(const Network& network, const CurveVertices& vertices,
                       Components* components);

struct Enclosing {
  uint32_t patch = k_none;
  double score = 0.0;
  Vec3 normal;          // of the patch's plane
  double facing = 1.0;  // the mean cosine with the component's normals; 1 where none is known
};

// Of each component.
Status find_enclosing(const Network& network, const CurveVertices& vertices,
                      const Components& components, Array<Enclosing>* enclosing);

}  // namespace wireskin::network
