// One step of minimum variation: every free vertex moves along its normal by u so that the mean
// curvature of the surface is as smooth as it can be while the surface meets the normals given on
// the curves.
//
// Unknowns: a displacement u per free vertex and a mean curvature h per vertex. On the mesh split
// along the curves (a held vertex has one row in each patch it touches) the integrated Laplacian of
// the displaced positions is asked to be -2 m h n, and h to have the least square Laplacian:
//   sum_r (g_r - (L u)_r - 2 m_r h_i(r))^2 / m_r + (c l)^4 h^T (Ls M^-1 Ls) h,
//   g_r = -<(L v)_r + c_r, n_i(r)>,
// where c_r is the conormal of the patch's rim, made from the curve's positions and the given
// normals: that is how these normals enter. Split rows are essential, merged ones never see them.
// On open borders the rows of the last term are left out. One factorisation of size 2 n. Source: H.
// Moreton, C. Sequin, "Functional Optimization for Fair Surface Design", 1992 (minimum variation
// surfaces), linearised along the normals.
#pragma once

#include "mesh/operators.h"

namespace wireskin::smooth {

struct DisplaceInput {
  Span<const Vec3> position;
  Span<const Vec3> held_normal;  // unit at held vertices
  Span<const uint32_t> triangle;
  Span<const uint32_t> patch;  // of each triangle
  Span<const uint8_t> held;
  Span<const uint8_t> on_border;
  double smoothing_length;  // c l above
};

// `normal`: out, the directions; `step`: out, u of every vertex, zero where held.
Status displacements(Context& context, const DisplaceInput& input, Span<Vec3> normal,
                     Span<double> step, double* residual);

}  // namespace wireskin::smooth
