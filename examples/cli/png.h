// An image as the bytes of a PNG file: true colour, 8 bits, the filter of each row chosen by the
// least sum of absolute values (W3C, "Portable Network Graphics Specification", section 12.8).
#pragma once

#include <string>

#include "image.h"

namespace wireskin_cli {

std::string png_bytes(const Image& image);

}  // namespace wireskin_cli
