// From which two sides a surface is looked at, and where its points fall on the screen.
//
// A sheet is seen from above and from a low side, a mask that faces sideways from two
// sides of its face, a closed surface from two opposite sides. Orthographic.
#pragma once

#include <array>

#include "raster.h"
#include "vec.h"
#include "wireskin.h"

namespace wireskin_cli {

// Orthonormal: to the right and up on the screen, and towards the eye.
struct Frame {
  Vec3 right;
  Vec3 up;
  Vec3 toward;
};

// `up_axis` is 0, 1 or 2 for x, y or z.
std::array<Frame, 2> choose_frames(const wsk_surface_view& surface, int up_axis);

// The extent of the surface in a frame.
struct Extent {
  double left, right, bottom, top;
  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

Extent extent_in(const Frame& frame, const wsk_surface_view& surface);

// Frame, scale and the pixel of the frame's origin. Depth is in pixels too.
struct Camera {
  Frame frame;
  double scale = 1.0;
  double origin_x = 0.0;
  double origin_y = 0.0;

  ScreenPoint project(const Vec3& p) const {
    return {origin_x + scale * dot(p, frame.right), origin_y - scale * dot(p, frame.up),
            scale * dot(p, frame.toward)};
  }
};

}  // namespace wireskin_cli
