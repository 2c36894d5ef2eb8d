#include "surface/spoilt.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/fails_cleanly.h"

using namespace unit;
using namespace wireskin;

namespace {

// Squares of side 1, 9 by 3 in two triangles each, in three patches of 3 by 3; the lines between
// are curves, and so is the rim. `position` is what a smoothing made of `start`.
struct Sheet {
  static constexpr uint32_t k_columns = 10, k_rows = 4;
  std::vector<Vec3> start, position;
  std::vector<uint32_t> unturned, triangle, patch;
  std::vector<uint8_t> on_curve;
  std::vector<uint8_t> back;

  Sheet() {
    for (uint32_t v = 0; v < k_columns * k_rows; ++v) {
      const uint32_t x = v % k_columns, y = v / k_columns;
      start.push_back({1.0 * x, 1.0 * y, 0.0});
      on_curve.push_back(x % 3 == 0 || y % 3 == 0);
      if (x + 1 == k_columns || y + 1 == k_rows) continue;
      const uint32_t b = v + 1, c = b + k_columns, d = v + k_columns;
      triangle.insert(triangle.end(), {v, b, c, v, c, d});
      patch.insert(patch.end(), {x / 3, x / 3});
    }
    position = start;
    unturned = triangle;
    // Every free vertex has moved, so that one sees which went back.
    for (uint32_t v = 0; v < position.size(); ++v) {
      if (!on_curve[v]) position[v].z = 0.25;
    }
  }
  static uint32_t at(uint32_t x, uint32_t y) { return y * k_columns + x; }
  bool went_back(uint32_t x, uint32_t y) const { return position[at(x, y)] == start[at(x, y)]; }
  SmoothedMesh mesh() {
    return {span(position), span(triangle), view(patch), view(start), view(unturned)};
  }
  uint32_t first() {
    Heap heap;
    Spoilt spoilt(heap.context);
    must(find_spoilt(heap.context, mesh(), 3, &spoilt));
    CHECK(spoilt.patch.empty() == (spoilt.first == k_none));
    return spoilt.first;
  }
  void run() {
    Heap heap;
    Array<uint8_t> result(heap.context);
    must(put_back_spoilt(heap.context, mesh(), 3, &result));
    back = to_vector(result);
  }
};

}  // namespace

TEST_CASE("spoilt: a sound mesh stays as it is") {
  Sheet sheet;
  // Thin, but not without area.
  sheet.position[Sheet::at(1, 1)] = {1e-9, 1.0, 0.0};
  const std::vector<Vec3> before = sheet.position;
  CHECK(sheet.first() == k_none);
  sheet.run();
  CHECK(sheet.back.empty());
  CHECK(sheet.position == before);
  CHECK(sheet.triangle == sheet.unturned);
}

TEST_CASE("spoilt: the patch of a triangle without area goes back, no other") {
  Sheet sheet;
  sheet.position[Sheet::at(4, 1)] = sheet.position[Sheet::at(5, 1)];
  // The first of the triangles with both vertices.
  CHECK(sheet.first() == 2 * 4 + 1);
  sheet.run();
  CHECK(sheet.first() == k_none);
  CHECK(sheet.back == std::vector<uint8_t>{0, 1, 0});
  for (uint32_t x = 1; x < 9; ++x) {
    CAPTURE(x);
    if (x % 3 != 0) CHECK(sheet.went_back(x, 2) == (x / 3 == 1));
  }
}

TEST_CASE("spoilt: needles count as well as vertices that coincide") {
  for (const double height : {1e-9, 1e-11, 0.0}) {
    CAPTURE(height);
    Sheet sheet;
    // A triangle at the rim, its free corner so high above the middle of its edge.
    sheet.position[Sheet::at(1, 1)] = {0.5, height, 0.0};
    sheet.run();
    CHECK(sheet.back.empty() == (height > 1e-10));
    CHECK(sheet.went_back(1, 1) == (height < 1e-10));
  }
}

TEST_CASE("spoilt: a patch that had a thinner triangle before keeps what it has") {
  for (const double before : {2e-12, 1e-13}) {
    CAPTURE(before);
    Sheet sheet;
    // Between the curve's vertices at the corner and one that is held beside their middle.
    sheet.on_curve[Sheet::at(1, 1)] = 1;
    sheet.start[Sheet::at(1, 1)] = sheet.position[Sheet::at(1, 1)] = {0.5, before, 0.0};
    sheet.position[Sheet::at(2, 2)] = {3.0 - 1e-12, 1.5, 0.0};
    sheet.run();
    CHECK(sheet.back.empty() == (before < 1e-12));
  }
}

TEST_CASE("spoilt: a vertex that goes farther than the diagonal takes its patch back") {
  const double diagonal = std::sqrt(9.0 * 9.0 + 3.0 * 3.0);
  for (const double factor : {0.9, 1.1}) {
    CAPTURE(factor);
    Sheet sheet;
    sheet.position[Sheet::at(7, 2)].y -= factor * diagonal;
    CHECK(sheet.first() == (factor < 1.0 ? k_none : 2 * (9 + 6)));
    sheet.run();
    if (factor < 1.0) {
      CHECK(sheet.back.empty());
    } else {
      CHECK(sheet.back == std::vector<uint8_t>{0, 0, 1});
      CHECK(sheet.went_back(7, 2));
      CHECK(!sheet.went_back(1, 1));
    }
  }
}

TEST_CASE("spoilt: edges that were flipped are turned back with their patch") {
  Sheet sheet;
  // The diagonals of one square in the patch that goes back and of one in a patch that stays.
  for (const uint32_t x : {1u, 4u}) {
    const uint32_t a = Sheet::at(x, 1), b = a + 1, c = b + Sheet::k_columns, d = c - 1;
    const uint32_t quad[] = {a, b, d, b, c, d};
    for (uint32_t k = 0; k < 6; ++k) sheet.triangle[3 * 2 * (9 + x) + k] = quad[k];
  }
  const std::vector<uint32_t> turned = sheet.triangle;
  REQUIRE(turned != sheet.unturned);
  sheet.position[Sheet::at(4, 1)] = sheet.position[Sheet::at(5, 1)];
  sheet.run();
  CHECK(sheet.back == std::vector<uint8_t>{0, 1, 0});
  for (size_t h = 0; h < turned.size(); ++h) {
    CAPTURE(h);
    CHECK(sheet.triangle[h] == (sheet.patch[h / 3] == 1 ? sheet.unturned[h] : turned[h]));
  }
}

TEST_CASE("spoilt: soft curves go back where they alone flatten a patch, and so on") {
  Sheet sheet;
  // A curve's vertex has moved into a free one's first place, and a free one of the next patch,
  // where all is well until the curve goes back, to where that vertex was.
  sheet.position[Sheet::at(3, 1)] = sheet.start[Sheet::at(2, 1)];
  sheet.position[Sheet::at(4, 1)] = sheet.start[Sheet::at(3, 1)];
  sheet.position[Sheet::at(3, 2)].z = 0.1;
  sheet.position[Sheet::at(6, 2)].z = 0.1;
  CHECK(sheet.first() == k_none);
  sheet.position[Sheet::at(1, 1)] = sheet.position[Sheet::at(2, 1)];
  sheet.run();
  CHECK(sheet.first() == k_none);
  REQUIRE(sheet.back.size() == 3);
  CHECK(sheet.back == std::vector<uint8_t>{1, 1, 0});
  CHECK(sheet.went_back(3, 1));
  CHECK(sheet.went_back(4, 1));
  CHECK(sheet.went_back(6, 2));   // with the curves of the second patch
  CHECK(!sheet.went_back(7, 2));  // the third is sound with that curve back
}

TEST_CASE("spoilt: the sides of a crease go back together") {
  Sheet sheet;
  // The line between the first two patches is cut: the second has copies of its own.
  std::vector<uint32_t> origin;
  for (uint32_t v = 0; v < sheet.start.size(); ++v) origin.push_back(v);
  for (uint32_t y = 0; y < Sheet::k_rows; ++y) {
    const uint32_t v = Sheet::at(3, y), copy = uint32_t(sheet.start.size());
    for (size_t h = 0; h < sheet.triangle.size(); ++h) {
      if (sheet.patch[h / 3] == 1 && sheet.triangle[h] == v) sheet.triangle[h] = copy;
    }
    sheet.start.push_back(sheet.start[v]);
    sheet.position[v].z = 0.1;
    sheet.position.push_back(sheet.position[v]);
    origin.push_back(v);
  }
  sheet.unturned = sheet.triangle;
  sheet.position[Sheet::at(1, 1)] = sheet.position[Sheet::at(2, 1)];
  Heap heap;
  Array<uint8_t> back(heap.context);
  SmoothedMesh mesh = sheet.mesh();
  mesh.origin = view(origin);
  must(put_back_spoilt(heap.context, mesh, 3, &back));
  CHECK(to_vector(back) == std::vector<uint8_t>{1, 0, 0});
  for (size_t v = Sheet::k_columns * Sheet::k_rows; v < origin.size(); ++v) {
    CHECK(sheet.position[v] == sheet.start[v]);
    CHECK(sheet.position[origin[v]] == sheet.start[origin[v]]);
  }
}

TEST_CASE("spoilt: the triangle named is one that got worse") {
  Sheet sheet;
  sheet.position[Sheet::at(1, 1)] = sheet.start[Sheet::at(1, 1)] = {0.5, 1e-13, 0.0};
  sheet.position[Sheet::at(2, 2)] = sheet.position[Sheet::at(2, 1)];
  const uint32_t first = sheet.first();
  REQUIRE(first != k_none);
  bool at_both = false;
  for (uint32_t k = 0; k < 3; ++k)
    at_both = at_both || sheet.triangle[3 * first + k] == Sheet::at(2, 2);
  CHECK(at_both);
}

TEST_CASE("spoilt: whatever fails meanwhile, all memory is given back") {
  Sheet sheet;
  sheet.position[Sheet::at(4, 1)] = sheet.position[Sheet::at(5, 1)];
  const std::vector<Vec3> smoothed = sheet.position;
  fails_cleanly([&](Context& context) {
    Array<uint8_t> back(context);
    sheet.position = smoothed;
    return put_back_spoilt(context, sheet.mesh(), 3, &back);
  });
}
