// What the curves tell of the curvature across them: nothing inside an arc, but at a node, where
// they cross, the whole second fundamental form II and its first derivative; between two nodes that
// tell, the curvature across the arc is interpolated. Without it the displacement steps make the
// mean curvature of a patch too even: the octants of an ellipsoid come out seven times worse.
//
// In: positions and unit normals on curves. Along a curve with tangent t, normal n and b = n x t,
// dn = II(t, t) t + II(t, b) b; two directions at a node give the three numbers of II and, with the
// symmetric tensor C = D II (Codazzi), its four derivatives, by least squares over all arcs there.
// On an arc II(b, b) is the cubic with the values and slopes of its ends, over the angle that the
// normal turns by rather than over length: so an ellipsoid's is nearly a cubic. Out: H = (II(t, t)
// + II(b, b)) / 2 inside arcs, and its weight, which has the unit of a length: the share of the
// curve times how far to trust H, from how well the same cubic foretells II(t, t), which is known,
// how far the normal turns, and how well the arcs agree at the nodes. O(triangles). Source: M. do
// Carmo, "Differential Geometry of Curves and Surfaces", 1976, for the equations.
#pragma once

#include "smooth/arcs.h"

namespace wireskin::smooth {

// `weight` is zero where nothing is known.
Status foretell_curvature(Context& context, const GivenCurves& curves, Array<double>* curvature,
                          Array<double>* weight);

}  // namespace wireskin::smooth
