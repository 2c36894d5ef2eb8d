// Whether any two-sided surface without crossings can have this border with these normals.
//
// Pushed along its normals such a surface does not meet its border, so the border and its copy
// pushed along them have the linking number 0: that is the writhe of the loops together, the sum of
// solid angles over pairs of edges, and the turns that normals make about their curves. The border
// of a Moebius band has another number, and so has a knot with normals that stay on one side.
// In: a border. Out: the number, 0 where it is not defined (normals not known, curves that turn
// back) or the sums are not near a whole number. O(n^2). Sources: G. Calugareanu, "L'integrale de
// Gauss et l'analyse des noeuds tridimensionnels", 1959; J. H. White, "Self-Linking and the Gauss
// Integral in Higher Dimensions", 1969; T. F. Banchoff, "Self Linking Numbers of Space Polygons",
// 1976.
#pragma once

#include "network/border.h"

namespace wireskin::network {

Status linking_number(const Border& border, int32_t* number);

}  // namespace wireskin::network
