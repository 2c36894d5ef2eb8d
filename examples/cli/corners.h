// The normal at every corner of every triangle of a surface, for what draws or writes it: that of
// its own side where the surface has a crease, else that of its vertex.
#pragma once

#include <vector>

#include "wireskin.h"

namespace wireskin_cli {

// Three a triangle, each the first of three numbers of the view's.
inline std::vector<const double*> normals_of_corners(const wsk_surface_view& surface) {
  std::vector<const double*> normals(3 * static_cast<size_t>(surface.triangle_count));
  for (size_t h = 0; h < normals.size(); ++h) {
    normals[h] = surface.normals + 3 * static_cast<size_t>(surface.triangles[h]);
  }
  for (size_t i = 0; i < surface.crease_corner_count; ++i) {
    normals[surface.crease_corners[i]] = surface.crease_normals + 3 * i;
  }
  return normals;
}

}  // namespace wireskin_cli
