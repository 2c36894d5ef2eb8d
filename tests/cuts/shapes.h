// Measured meshes as the tests of cut networks need them: oriented manifolds, and what is known of
// them.
#pragma once

#include <string>

#include "accuracy/real.h"

namespace cuts {

// An OBJ or OFF file without the triangles at edges of more than two, at edges that turn by more
// than 100 degrees, and at vertices where two borders meet; of the rest the largest connected part.
networks::Mesh read_mesh(const std::string& path);

// Planes at these fractions of the mesh's bounding box along x, y and z.
std::vector<networks::Plane> planes_along_axes(const networks::Mesh& mesh,
                                               const std::vector<double>& x,
                                               const std::vector<double>& y,
                                               const std::vector<double>& z);

long euler_characteristic(const networks::Mesh& mesh);

}  // namespace cuts
