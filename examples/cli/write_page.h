// A page that shows the result in any browser: the viewer of examples/web with surface, curves and
// report inside, complete in one file.
//
// The scene is a 32-bit length, a JSON header of that length that names the arrays, then the
// arrays, little-endian, all in base64. Positions are 32-bit floats relative to the middle of the
// bounding box, unit normals 16-bit integers.
#pragma once

#include <string>
#include <string_view>

#include "build.h"

namespace wireskin_cli {

// The page without its scene; generated from examples/web.
extern const std::string_view k_page;

struct PageInput {
  const wsk_surface_view& surface;
  const BuildResult& result;
  std::string title;
  std::string report;  // JSON
  int up_axis = 2;
};

std::string page_bytes(const PageInput& input);

}  // namespace wireskin_cli
