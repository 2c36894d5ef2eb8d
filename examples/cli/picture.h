// The surface seen from two sides, shaded, with isophotes and the curves.
//
// Isophotes are stripes of equal angle between the normal and a fixed direction: they are smooth
// where curvature is, have kinks where only the normal is continuous, and break where it is not.
// The border has a colour of their own, and so has the surface's inner side.
#pragma once

#include "image.h"
#include "wireskin.h"

namespace wireskin_cli {

// `up_axis` is 0, 1 or 2 for x, y or z.
Image draw_picture(const wsk_surface_view& surface, int up_axis);

}  // namespace wireskin_cli
