#include "png.h"

#include <cstdlib>
#include <string_view>

#include "bytes.h"
#include "deflate.h"

namespace wireskin_cli {

static uint32_t crc32(std::string_view bytes) {
  uint32_t crc = 0xffffffffu;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

static void append_chunk(std::string& png, const char* type, std::string_view data) {
  append_big(png, static_cast<uint32_t>(data.size()));
  const size_t start = png.size();
  png += type;
  png += data;
  append_big(png, crc32(std::string_view(png).substr(start)));
}

// The predictor of A. Paeth, "Image File Compression Made Easy", 1991.
static int paeth(int left, int above, int corner) {
  const int estimate = left + above - corner;
  const int to_left = std::abs(estimate - left);
  const int to_above = std::abs(estimate - above);
  const int to_corner = std::abs(estimate - corner);
  if (to_left <= to_above && to_left <= to_corner) return left;
  return to_above <= to_corner ? above : corner;
}

static int prediction(int filter, int left, int above, int corner) {
  switch (filter) {
    case 1:
      return left;
    case 2:
      return above;
    case 3:
      return (left + above) / 2;
    case 4:
      return paeth(left, above, corner);
    default:
      return 0;
  }
}

// One row under one filter, with the filter's number in front; `above` may be null.
static std::string filtered(const uint8_t* row, const uint8_t* above, size_t size, int filter) {
  std::string result(1, static_cast<char>(filter));
  for (size_t i = 0; i < size; ++i) {
    const int left = i < 3 ? 0 : row[i - 3];
    const int up = above == nullptr ? 0 : above[i];
    const int corner = i < 3 || above == nullptr ? 0 : above[i - 3];
    result += static_cast<char>(
        static_cast<unsigned char>(row[i] - prediction(filter, left, up, corner)));
  }
  return result;
}

static long magnitude(std::string_view row) {
  long sum = 0;
  for (const char c : row.substr(1)) sum += std::abs(static_cast<int>(static_cast<signed char>(c)));
  return sum;
}

static std::string filtered_rows(const Image& image) {
  const size_t size = 3 * static_cast<size_t>(image.width);
  std::string rows;
  const uint8_t* above = nullptr;
  for (int y = 0; y < image.height; ++y) {
    const uint8_t* row = image.rgb.data() + static_cast<size_t>(y) * size;
    std::string best = filtered(row, above, size, 0);
    long least = magnitude(best);
    for (int filter = 1; filter <= 4; ++filter) {
      std::string other = filtered(row, above, size, filter);
      const long sum = magnitude(other);
      if (sum >= least) continue;
      least = sum;
      best.swap(other);
    }
    rows += best;
    above = row;
  }
  return rows;
}

std::string png_bytes(const Image& image) {
  std::string png = "\x89PNG\r\n\x1a\n";
  std::string header;
  append_big(header, static_cast<uint32_t>(image.width));
  append_big(header, static_cast<uint32_t>(image.height));
  // 8 bits, true colour, deflate, adaptive filters, not interlaced.
  header += std::string("\x08\x02\x00\x00\x00", 5);
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", zlib_bytes(filtered_rows(image)));
  append_chunk(png, "IEND", "");
  return png;
}

}  // namespace wireskin_cli
