// Creases: the mesh of the patches cut open along the sharp curves for the smoothing, and put
// together again.
//
// In: the network with the normals on both sides of its curves, and the mesh of its patches. Out: a
// mesh in which sharp curves are open borders, each copy of a vertex with the normal of its own
// sector: the mean of the sides of the sharp curves that bound it and of the curves inside it.
// Where none of these is known the copy is bare. Held vertices do not move, so copies stay
// together.
#pragma once

#include "mesh/cut.h"
#include "network/patch_mesh.h"
#include "surface.h"

namespace wireskin {

struct Creased {
  mesh::Cut cut;
  Array<Vec3> position, normal;
  Array<uint8_t> held, bare, on_border;

  explicit Creased(Context& context)
      : cut(context),
        position(context),
        normal(context),
        held(context),
        bare(context),
        on_border(context) {}
};

// Whether any curve is sharp; if not, nothing below is needed.
inline bool has_creases(const network::CurveVertices& vertices) {
  return !vertices.side_start.empty();
}

// `sharp`: of each curve. Fails with inconsistent_normals, naming node and curve, where the normals
// of one sector oppose each other.
Status cut_along_creases(Context& context, const network::Network& network,
                         const network::CurveVertices& vertices, Span<const uint8_t> sharp,
                         Span<const network::Node> nodes, const Surface& surface, Creased* creased);

// Positions and triangles go back to the surface.
void merge_creases(const Creased& creased, Surface* surface);

// Normals and curvature of the surface at creases are those of the sides, each measured by itself,
// in the mean; so are the constraint normals, as far as they are known.
Status measure_sides(Context& context, const Creased& creased, Surface* surface);

}  // namespace wireskin
