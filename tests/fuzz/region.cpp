// libFuzzer target: points, loops and lines of a plane to the region triangulator. Its triangles
// are counter-clockwise and linked both ways.
#include "planar/region.h"

#include "fuzz/bytes.h"
#include "num/predicates.h"

using namespace wireskin;

static void check_triangles(const planar::Triangulation& t) {
  for (uint32_t i = 0; i < t.triangles.size(); ++i) {
    const planar::Triangle& triangle = t.triangles[i];
    fuzz::require(orient2d(t.points[triangle.vertex[0]], t.points[triangle.vertex[1]],
                           t.points[triangle.vertex[2]]) > 0.0);
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t twin = triangle.twin[k];
      if (twin != k_none) fuzz::require(t.twin(twin) == 4 * i + k);
    }
  }
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz::Bytes bytes(data, size);
  fuzz::Limits limits;
  fuzz::Arena& heap = limits.allocator;
  {
    Context context({heap.allocate, heap.release, &heap}, size_t{1} << 26, {});
    const uint32_t count = 2 + bytes.count(14, 40);
    std::vector<Vec2> points;
    for (uint32_t i = 0; i < count; ++i) {
      const Vec2 p = {bytes.number(), bytes.number()};
      // The caller's part of the contract.
      const bool fits = std::fabs(p.x) < 1e60 && std::fabs(p.y) < 1e60;
      points.push_back(fits ? p : Vec2{1.0, 2.0});
    }
    std::vector<uint32_t> border, lines;
    const uint32_t loops = bytes.count(2, 4);
    for (uint32_t l = 0; l < loops; ++l) {
      const uint32_t corners = 1 + bytes.count(8, 12), first = bytes.below(count);
      uint32_t last = first;
      for (uint32_t i = 1; i < corners; ++i) {
        const uint32_t next = bytes.one_in(3) ? bytes.below(count) : (last + 1) % count;
        border.insert(border.end(), {last, next});
        last = next;
      }
      border.insert(border.end(), {last, first});
    }
    for (uint32_t i = bytes.count(3, 6) - 1; i > 0; --i) {
      lines.push_back(bytes.below(count));
      lines.push_back(bytes.below(count));
    }
    planar::Region region;
    region.points = {points.data(), points.size()};
    region.border = {border.data(), border.size()};
    region.lines = {lines.data(), lines.size()};
    region.join = bytes.one_in(2);
    planar::Triangulation t(context);
    Array<uint32_t> joined(context);
    planar::Conflict conflict;
    if (planar::triangulate_region(region, &t, &joined, &conflict).ok()) check_triangles(t);
  }
  fuzz::require(heap.clean());
  return 0;
}
