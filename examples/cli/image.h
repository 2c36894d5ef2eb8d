// A picture of 8-bit red, green and blue, rows from the top.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace wireskin_cli {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgb;

  Image(int w, int h, uint8_t value)
      : width(w), height(h), rgb(3 * static_cast<size_t>(w) * static_cast<size_t>(h), value) {}
};

}  // namespace wireskin_cli
