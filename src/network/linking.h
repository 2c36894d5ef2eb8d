// Whether any two-sided surface without crossings can have this border with these normals.
//
// Pushed along its normals such a surface does not meet its border, so the border and its copy
// pushed along them have the linking number 0: that is the signed crossings of the loops seen from
// any direction, and the turns that the normals make about their curves against that direction. The
// border of a Moebius band has another number, and so has a knot with normals that stay on one
// side. In: a border. Out: the number, 0 where it is not defined (normals not known, curves that
// turn back). Cost: O(n log n) and the pairs of edges whose extents meet along an axis, which are
// n^2 / 2 at the worst: then 2^16 edges take seconds.
// Sources: G. Calugareanu, "L'integrale de Gauss et l'analyse des noeuds tridimensionnels", 1959;
// J. H. White, "Self-Linking and the Gauss Integral in Higher Dimensions", 1969; L. H. Kauffman,
// "On Knots", 1987, for the blackboard framing.
#pragma once

#include "network/border.h"

namespace wireskin::network {

Status linking_number(const Border& border, int32_t* number);

}  // namespace wireskin::network
