// The exact test for triangles that run into each other: by hand, and against an independent one.
#include "flow/crossings.h"

#include <doctest/doctest.h>

#include <array>

#include "support/context.h"

using namespace unit;
using wireskin::flow::find_crossings;
using wireskin::flow::triangles_cross;

static bool cross(const std::vector<Vec3>& p, std::array<uint32_t, 3> a,
                  std::array<uint32_t, 3> b) {
  const bool one = triangles_cross(view(p), a.data(), b.data());
  CHECK(triangles_cross(view(p), b.data(), a.data()) == one);
  return one;
}

TEST_CASE("Triangles that share nothing") {
  const std::vector<Vec3> p = {{0, 0, 0},     {1, 0, 0},     {0, 1, 0},     {0.2, 0.2, -1},
                               {0.2, 0.2, 1}, {0.3, 5, 0},   {2, 2, -1},    {2, 2, 1},
                               {3, 2, 0},     {0.1, 0.1, 0}, {0.3, 0.1, 0}, {0.1, 0.3, 0}};
  CHECK(cross(p, {0, 1, 2}, {3, 4, 5}));
  CHECK(!cross(p, {0, 1, 2}, {6, 7, 8}));
  CHECK(cross(p, {0, 1, 2}, {9, 10, 11}));  // inside, in the same plane
}

TEST_CASE("Triangles that share a vertex or an edge") {
  const std::vector<Vec3> p = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},  {-1, 0, 0},   {0, -1, 0},
                               {0, 0, 1}, {1, 1, 1}, {1, 1, -1}, {0.2, 0.5, 0}};
  CHECK(!cross(p, {0, 1, 2}, {0, 3, 4}));  // only the vertex
  CHECK(cross(p, {0, 1, 2}, {0, 6, 7}));   // pierced
  CHECK(!cross(p, {0, 1, 2}, {0, 1, 5}));  // hinged
  CHECK(!cross(p, {0, 1, 2}, {1, 0, 4}));  // flat neighbours
  CHECK(cross(p, {0, 1, 2}, {0, 1, 8}));   // folded over
  CHECK(cross(p, {0, 1, 2}, {2, 0, 1}));   // the same
  CHECK(cross(p, {0, 1, 2}, {0, 0, 5}));   // one that is none
  CHECK(cross(p, {0, 1, 2}, {2, 2, 4}));   // collapsed
  CHECK(cross(p, {0, 1, 2}, {0, 5, 0}));
}

TEST_CASE("Random pairs against a search along their edges") {
  Random random(3);
  int found = 0;
  for (int round = 0; round < 2000; ++round) {
    std::vector<Vec3> p;
    for (int i = 0; i < 6; ++i) p.push_back({random(), random(), random()});
    // An edge crosses a triangle where its line parameter and barycentric coordinates are inside.
    const auto hits = [&](int a, int b, int t) {
      const Vec3 d = p[size_t(b)] - p[size_t(a)], e = p[size_t(t + 1)] - p[size_t(t)];
      const Vec3 f = p[size_t(t + 2)] - p[size_t(t)], s = p[size_t(a)] - p[size_t(t)];
      const Vec3 h = wireskin::cross(d, f), q = wireskin::cross(s, e);
      const double det = dot(e, h), u = dot(s, h) / det, v = dot(d, q) / det;
      const double w = dot(f, q) / det;
      return u > 0 && v > 0 && u + v < 1 && w > 0 && w < 1;
    };
    bool expected = false;
    for (int k = 0; k < 3; ++k) {
      expected = expected || hits(k, (k + 1) % 3, 3) || hits(3 + k, 3 + (k + 1) % 3, 0);
    }
    found += expected;
    CHECK(cross(p, {0, 1, 2}, {3, 4, 5}) == expected);
  }
  CHECK(found > 100);
  CHECK(found < 1900);
}

TEST_CASE("All pairs of a mesh are found") {
  Heap heap;
  Random random(8);
  std::vector<Vec3> p;
  std::vector<uint32_t> t;
  for (uint32_t i = 0; i < 300; ++i) {
    const Vec3 centre = {random(), random(), random()};
    for (uint32_t k = 0; k < 3; ++k) {
      p.push_back(centre + 0.15 * Vec3{random(), random(), random()});
      t.push_back(3 * i + k);
    }
  }
  size_t expected = 0;
  for (uint32_t i = 0; i < 300; ++i) {
    for (uint32_t k = i + 1; k < 300; ++k) {
      expected += triangles_cross(view(p), &t[3 * i], &t[3 * k]);
    }
  }
  Array<uint32_t> pairs(heap.context);
  must(find_crossings(heap.context, view(p), view(t), 100000, &pairs));
  CHECK(pairs.size() == 2 * expected);
  CHECK(expected > 10);
}
