// The exact test for triangles that run into each other: by hand, and against an independent one.
#include "flow/crossings.h"

#include <doctest/doctest.h>

#include <algorithm>
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

namespace {

// The same question in whole numbers: each edge against the other triangle, nothing left out.
struct Whole {
  int64_t x, y, z;
};

int sign(int64_t x) {
  return (x > 0) - (x < 0);
}

int turn(const Whole& a, const Whole& b, const Whole& c, int axis) {
  const auto drop = [axis](const Whole& p) -> std::array<int64_t, 2> {
    if (axis == 0) return {p.y, p.z};
    return axis == 1 ? std::array<int64_t, 2>{p.z, p.x} : std::array<int64_t, 2>{p.x, p.y};
  };
  const auto u = drop(a), v = drop(b), w = drop(c);
  return sign((v[0] - u[0]) * (w[1] - u[1]) - (v[1] - u[1]) * (w[0] - u[0]));
}

int side(const Whole& a, const Whole& b, const Whole& c, const Whole& d) {
  const Whole u = {b.x - a.x, b.y - a.y, b.z - a.z}, v = {c.x - a.x, c.y - a.y, c.z - a.z};
  const Whole w = {d.x - a.x, d.y - a.y, d.z - a.z};
  return sign(u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) +
              u.z * (v.x * w.y - v.y * w.x));
}

// Whether p, on the line ab of their plane, lies between its ends.
bool between(const Whole& p, const Whole& a, const Whole& b) {
  const auto in = [](int64_t x, int64_t y, int64_t z) {
    return std::min(y, z) <= x && x <= std::max(y, z);
  };
  return in(p.x, a.x, b.x) && in(p.y, a.y, b.y) && in(p.z, a.z, b.z);
}

bool meets_in_plane(const Whole& p, const Whole& q, const std::array<Whole, 3>& t) {
  int axis = 0;
  while (axis < 3 && turn(t[0], t[1], t[2], axis) == 0) ++axis;
  if (axis == 3) return false;
  bool inside = true;
  for (size_t k = 0; k < 3; ++k) {
    const Whole &a = t[k], &b = t[(k + 1) % 3];
    const int ab_p = turn(a, b, p, axis), ab_q = turn(a, b, q, axis);
    const int pq_a = turn(p, q, a, axis), pq_b = turn(p, q, b, axis);
    if (ab_p * ab_q < 0 && pq_a * pq_b < 0) return true;
    if ((ab_p == 0 && between(p, a, b)) || (ab_q == 0 && between(q, a, b))) return true;
    if ((pq_a == 0 && between(a, p, q)) || (pq_b == 0 && between(b, p, q))) return true;
    if (ab_p * turn(t[0], t[1], t[2], axis) < 0) inside = false;
  }
  return inside;
}

bool meets(const Whole& p, const Whole& q, const std::array<Whole, 3>& t) {
  const int sp = side(t[0], t[1], t[2], p), sq = side(t[0], t[1], t[2], q);
  if (sp == 0 && sq == 0) return meets_in_plane(p, q, t);
  if (sp * sq > 0) return false;
  const int ab = side(p, q, t[0], t[1]), bc = side(p, q, t[1], t[2]), ca = side(p, q, t[2], t[0]);
  return std::min({ab, bc, ca}) >= 0 || std::max({ab, bc, ca}) <= 0;
}

}  // namespace

TEST_CASE("Corners on a grid: every pair as in whole numbers, without a short cut") {
  Random random(5);
  int found[2] = {}, flat = 0;
  for (int round = 0; round < 60000; ++round) {
    const uint32_t size = 2 + random.below(4), shared = random.below(2);
    std::array<Whole, 6> whole;
    std::vector<Vec3> p;
    for (Whole& w : whole) {
      w = {random.below(size), random.below(size), round % 3 == 0 ? 0 : random.below(size)};
      p.push_back({0.125 * double(w.x), 0.125 * double(w.y), 0.125 * double(w.z)});
    }
    const std::array<uint32_t, 3> a = {0, 1, 2}, b = {shared == 0 ? 3u : 1u, 4, 5};
    const std::array<Whole, 3> s = {whole[a[0]], whole[a[1]], whole[a[2]]};
    const std::array<Whole, 3> t = {whole[b[0]], whole[b[1]], whole[b[2]]};
    bool expected = false;
    if (shared == 1) {
      expected = meets(s[2], s[0], t) || meets(t[1], t[2], s);
    } else {
      for (size_t k = 0; k < 3; ++k) {
        expected = expected || meets(s[k], s[(k + 1) % 3], t) || meets(t[k], t[(k + 1) % 3], s);
      }
    }
    ++found[expected];
    flat += side(s[0], s[1], s[2], t[1]) == 0 && side(s[0], s[1], s[2], t[2]) == 0;
    REQUIRE(cross(p, a, b) == expected);
  }
  CHECK(found[0] > 5000);
  CHECK(found[1] > 5000);
  CHECK(flat > 5000);
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
