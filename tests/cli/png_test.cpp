#include "png.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <random>

#include "cli/inflate.h"
#include "deflate.h"

using namespace wireskin_cli;
using namespace cli_test;

static uint32_t big(const std::string& bytes, size_t at) {
  uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

static uint32_t checksum(const std::string& bytes) {
  // The definition: the remainder of a division of polynomials, one bit at a time.
  uint32_t crc = ~0u;
  for (const char c : bytes) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      const bool one = ((crc ^ (static_cast<unsigned char>(c) >> bit)) & 1) != 0;
      crc = (crc >> 1) ^ (one ? 0xedb88320u : 0u);
    }
  }
  return ~crc;
}

static int undo_filter(int filter, int a, int b, int c) {
  const int p = a + b - c;
  const int pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
  const int paeth = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
  const int predictions[5] = {0, a, b, (a + b) / 2, paeth};
  REQUIRE(filter <= 4);
  return predictions[filter];
}

// Decodes what png_bytes may write: one IDAT, true colour.
static Image decoded(const std::string& png) {
  REQUIRE(png.substr(0, 8) == "\x89PNG\r\n\x1a\n");
  std::string data, types;
  size_t at = 8;
  int width = 0, height = 0;
  while (at < png.size()) {
    const size_t size = big(png, at);
    const std::string chunk = png.substr(at + 4, 4 + size);
    REQUIRE(checksum(chunk) == big(png, at + 8 + size));
    types += chunk.substr(0, 4) + " ";
    if (chunk.compare(0, 4, "IHDR") == 0) {
      width = static_cast<int>(big(chunk, 4));
      height = static_cast<int>(big(chunk, 8));
      REQUIRE(chunk.substr(12) == std::string("\x08\x02\0\0\0", 5));
    }
    if (chunk.compare(0, 4, "IDAT") == 0) data = inflate(chunk.substr(4));
    at += 12 + size;
  }
  REQUIRE(types == "IHDR IDAT IEND ");
  Image image(width, height, 0);
  const size_t row = 3 * static_cast<size_t>(width);
  REQUIRE(data.size() == static_cast<size_t>(height) * (row + 1));
  for (size_t y = 0; y < static_cast<size_t>(height); ++y) {
    uint8_t* line = image.rgb.data() + y * row;
    for (size_t i = 0; i < row; ++i) {
      const int a = i < 3 ? 0 : line[i - 3];
      const int b = y == 0 ? 0 : (line - row)[i];
      const int c = i < 3 || y == 0 ? 0 : (line - row)[i - 3];
      const int filter = data[y * (row + 1)];
      const int rest = static_cast<unsigned char>(data[y * (row + 1) + 1 + i]);
      line[i] = static_cast<uint8_t>(rest + undo_filter(filter, a, b, c));
    }
  }
  return image;
}

TEST_CASE("the reference decoder knows a stream that is not ours") {
  // zlib's own compression of "hello hello hello hello", with a fixed code and a repetition.
  const std::string stream("\x78\x9c\xcb\x48\xcd\xc9\xc9\x57\xc8\x40\x27\x01\x68\x03\x08\xb1", 16);
  CHECK(inflate(stream) == "hello hello hello hello");
  CHECK_THROWS(inflate(stream.substr(0, 12)));
  std::string wrong = stream;
  wrong[15] ^= 1;
  CHECK_THROWS(inflate(wrong));
}

TEST_CASE("compressed data comes back") {
  std::mt19937 random(3);
  std::string noise, skewed;
  for (int i = 0; i < 200000; ++i) noise += static_cast<char>(random() & 0xff);
  // Powers of two as frequencies ask for codes longer than the 15 bits that the format allows.
  for (int i = 0; i < 1 << 19; ++i) {
    unsigned r = random(), zeros = 0;
    while (zeros < 24 && (r >> zeros & 1) == 0) ++zeros;
    skewed += static_cast<char>(zeros * 7 + (random() & 1) * 100);
  }
  std::string far = noise.substr(0, 32700) + noise.substr(0, 3000) + noise.substr(0, 40000);
  for (const std::string& data :
       {std::string(), std::string("a"), std::string("ab"), std::string("abc"),
        std::string(100000, 'x'), noise, skewed, far, std::string(5, '\0') + "abcabcabcabcabcd"}) {
    CAPTURE(data.size());
    CHECK(inflate(zlib_bytes(data)) == data);
  }
}

TEST_CASE("compression is worth its name") {
  CHECK(zlib_bytes(std::string(100000, 'x')).size() < 500);
  std::string ramp;
  for (unsigned i = 0; i < 65536; ++i) ramp += static_cast<char>(i * i / 100);
  CHECK(zlib_bytes(ramp).size() < 40000);
}

TEST_CASE("pictures come back pixel by pixel") {
  std::mt19937 random(5);
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 3}, {257, 31}, {640, 200}}) {
    Image image(width, height, 255);
    for (size_t i = 0; i < image.rgb.size(); ++i) {
      // Smooth on the left, noise on the right, white below.
      const size_t x = i / 3 % static_cast<size_t>(width);
      if (i < image.rgb.size() / 2) {
        image.rgb[i] = static_cast<uint8_t>(x < 300 ? x * 2 + i % 3 : random() & 0xff);
      }
    }
    const Image back = decoded(png_bytes(image));
    CHECK(back.width == width);
    CHECK(back.height == height);
    CHECK(back.rgb == image.rgb);
  }
}
