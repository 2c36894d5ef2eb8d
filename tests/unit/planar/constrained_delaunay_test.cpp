#include "planar/constrained_delaunay.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "num/predicates.h"
#include "planar/insertion_order.h"

using namespace wireskin;
using namespace wireskin::planar;

namespace {

using Edge = std::pair<uint32_t, uint32_t>;

struct Heap {
  static void* allocate(size_t bytes, void*) { return std::malloc(bytes); }
  static void release(void* memory, size_t, void*) { std::free(memory); }
  Context context{Allocator{allocate, release, nullptr}, 0, {}};
};

// Twins point back, neighbours share the edge and its constraint bit, triangles turn left, Euler's
// formula holds and the areas fill the box.
void check_structure(const Triangulation& t) {
  double area = 0.0;
  size_t rim = 0;
  bool sound = true;
  for (uint32_t i = 0; i < t.triangles.size(); ++i) {
    const Triangle& triangle = t.triangles[i];
    const Vec2 a = t.points[triangle.vertex[0]];
    const Vec2 b = t.points[triangle.vertex[1]];
    const Vec2 c = t.points[triangle.vertex[2]];
    sound = sound && orient2d(a, b, c) > 0.0;
    area += cross(b - a, c - a) / 2.0;
    for (uint32_t h = 4 * i; h < 4 * i + 3; ++h) {
      const uint32_t g = t.twin(h);
      if (g == k_none) {
        ++rim;
        continue;
      }
      sound = sound && t.twin(g) == h && t.start(g) == t.end(h) && t.end(g) == t.start(h) &&
              t.constrained(g) == t.constrained(h);
    }
  }
  for (uint32_t v = 0; v < t.points.size(); ++v) sound = sound && t.start(t.leaving[v]) == v;
  CHECK(sound);
  CHECK(rim == 4);
  CHECK(t.triangles.size() == 2 * t.points.size() - 2 - rim);
  const Vec2 box = t.points[2] - t.points[0];
  CHECK(area == doctest::Approx(box.x * box.y).epsilon(1e-9));
}

bool crosses(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  return orient2d(a, b, c) * orient2d(a, b, d) < 0.0 && orient2d(c, d, a) * orient2d(c, d, b) < 0.0;
}

// Every circumcircle against every point. A point inside it must be hidden from the triangle's
// inside; it is enough that a constraint separates it from each of the three vertices' mean.
void check_delaunay(const Triangulation& t) {
  std::vector<Edge> constraints;
  for (uint32_t h = 0; h < 4 * t.triangles.size(); ++h) {
    if ((h & 3) != 3 && t.constrained(h) && t.start(h) < t.end(h)) {
      constraints.push_back({t.start(h), t.end(h)});
    }
  }
  size_t bad = 0;
  for (const Triangle& triangle : t.triangles) {
    const Vec2 a = t.points[triangle.vertex[0]];
    const Vec2 b = t.points[triangle.vertex[1]];
    const Vec2 c = t.points[triangle.vertex[2]];
    const Vec2 inside = (1.0 / 3.0) * (a + b + c);
    for (uint32_t v = 0; v < t.points.size(); ++v) {
      if (incircle(a, b, c, t.points[v]) <= 0.0) continue;
      bool hidden = false;
      for (const Edge& e : constraints) {
        if (e.first == v || e.second == v) continue;
        hidden = hidden || crosses(inside, t.points[v], t.points[e.first], t.points[e.second]);
      }
      if (!hidden) ++bad;
    }
  }
  CHECK(bad == 0);
}

bool has_constraint(const Triangulation& t, uint32_t a, uint32_t b) {
  for (uint32_t h = 0; h < 4 * t.triangles.size(); ++h) {
    if ((h & 3) != 3 && t.constrained(h) && t.start(h) == a && t.end(h) == b) return true;
  }
  return false;
}

Status insert_all(const std::vector<Vec2>& points, Triangulation* t) {
  TRY(begin_box({points.data(), points.size()}, t));
  for (const Vec2& p : points) TRY(insert_point(t, p));
  return {};
}

// What recover_edge should say, found by looking at everything.
bool constraint_is_allowed(const Triangulation& t, const std::vector<Edge>& present, uint32_t a,
                           uint32_t b) {
  const Vec2 pa = t.points[a];
  const Vec2 pb = t.points[b];
  for (uint32_t v = 0; v < t.points.size(); ++v) {
    if (v == a || v == b || orient2d(pa, pb, t.points[v]) != 0.0) continue;
    if (dot(t.points[v] - pa, t.points[v] - pb) < 0.0) return false;
  }
  for (const Edge& e : present) {
    if (crosses(pa, pb, t.points[e.first], t.points[e.second])) return false;
  }
  return true;
}

void constrain_at_random(Triangulation* t, size_t tries, std::mt19937* random) {
  std::vector<Edge> present;
  const uint32_t count = static_cast<uint32_t>(t->points.size());
  for (size_t i = 0; i < tries; ++i) {
    const uint32_t a = k_box_corners + static_cast<uint32_t>((*random)() % (count - k_box_corners));
    const uint32_t b = k_box_corners + static_cast<uint32_t>((*random)() % (count - k_box_corners));
    if (a == b) continue;
    const bool allowed = constraint_is_allowed(*t, present, a, b);
    const Status status = recover_edge(t, a, b);
    CHECK(status.ok() == allowed);
    if (!status.ok()) {
      CHECK(status.code == Code::patch_folded);
      continue;
    }
    present.push_back({a, b});
  }
  for (const Edge& e : present) CHECK(has_constraint(*t, e.first, e.second));
}

std::vector<Vec2> random_points(size_t count, int grid, std::mt19937* random) {
  std::set<std::pair<double, double>> distinct;
  std::vector<Vec2> points;
  for (size_t i = 0; i < count; ++i) {
    Vec2 p;
    if (grid > 0) {
      p = {static_cast<double>((*random)() % static_cast<unsigned>(grid)),
           static_cast<double>((*random)() % static_cast<unsigned>(grid))};
    } else {
      p = {static_cast<double>((*random)()) * 0x1p-32, static_cast<double>((*random)()) * 0x1p-32};
    }
    if (distinct.insert({p.x, p.y}).second) points.push_back(p);
  }
  return points;
}

}  // namespace

TEST_CASE("random points with random constraints are constrained Delaunay") {
  std::mt19937 random(1);
  for (int round = 0; round < 600; ++round) {
    Heap heap;
    Triangulation t(heap.context);
    REQUIRE(insert_all(random_points(2 + random() % 40, 0, &random), &t).ok());
    check_structure(t);
    check_delaunay(t);
    constrain_at_random(&t, 1 + random() % 20, &random);
    check_structure(t);
    check_delaunay(t);
  }
}

TEST_CASE("grid points, most of them on common lines and circles") {
  std::mt19937 random(2);
  for (int round = 0; round < 600; ++round) {
    Heap heap;
    Triangulation t(heap.context);
    const int grid = 2 + static_cast<int>(random() % 7);
    const std::vector<Vec2> points = random_points(2 + random() % 40, grid, &random);
    if (points.size() < 2) continue;
    REQUIRE(insert_all(points, &t).ok());
    check_delaunay(t);
    constrain_at_random(&t, 1 + random() % 20, &random);
    check_structure(t);
    check_delaunay(t);
  }
}

TEST_CASE("points on circles and needles across many triangles") {
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    Heap heap;
    Triangulation t(heap.context);
    std::vector<Vec2> points;
    const int count = 5 + static_cast<int>(random() % 30);
    for (int i = 0; i < count; ++i) {
      const double angle = 6.283185307179586 * i / count;
      points.push_back({std::cos(angle), std::sin(angle)});
      points.push_back({0.5 * std::cos(angle), 1e-9 * std::sin(angle)});
    }
    points.erase(std::remove_if(points.begin() + 1, points.end(),
                                [&](Vec2 p) { return p.x == points[0].x && p.y == points[0].y; }),
                 points.end());
    std::vector<Vec2> distinct;
    for (const Vec2& p : points) {
      bool seen = false;
      for (const Vec2& q : distinct) seen = seen || (q.x == p.x && q.y == p.y);
      if (!seen) distinct.push_back(p);
    }
    REQUIRE(insert_all(distinct, &t).ok());
    constrain_at_random(&t, 20, &random);
    check_structure(t);
    check_delaunay(t);
  }
}

TEST_CASE("points added after the constraints see only their own side") {
  std::mt19937 random(4);
  for (int round = 0; round < 300; ++round) {
    Heap heap;
    Triangulation t(heap.context);
    std::vector<Vec2> points = random_points(12, round % 2 == 0 ? 0 : 9, &random);
    points.push_back({-1.0, -1.0});
    points.push_back({10.0, 11.0});
    REQUIRE(insert_all(points, &t).ok());
    constrain_at_random(&t, 8, &random);
    for (int i = 0; i < 20; ++i) {
      const Vec2 p = random_points(1, round % 2 == 0 ? 0 : 9, &random)[0];
      const size_t before = t.points.size();
      const Status status = insert_point(&t, p);
      CHECK(t.points.size() == before + (status.ok() ? 1 : 0));
      if (!status.ok()) CHECK(status.code == Code::patch_folded);
    }
    check_structure(t);
    check_delaunay(t);
  }
}

TEST_CASE("an edge of the corridor that hangs into it") {
  // The middle point hangs from the top by an edge whose two sides both face the segment.
  Heap heap;
  Triangulation t(heap.context);
  const std::vector<Vec2> points = {{-10, 0},    {10, 0},    {0, 8},  {0, 0.125},
                                    {-1, -0.01}, {1, -0.01}, {-4, 4}, {4, 4}};
  REQUIRE(insert_all(points, &t).ok());
  REQUIRE(recover_edge(&t, 4 + 2, 4 + 3).ok());
  REQUIRE(recover_edge(&t, 4 + 0, 4 + 1).ok());
  CHECK(has_constraint(t, 6, 7));
  CHECK(has_constraint(t, 4, 5));
  check_structure(t);
  check_delaunay(t);
}

TEST_CASE("a flip and its inverse") {
  Heap heap;
  Triangulation t(heap.context);
  REQUIRE(insert_all({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {3, 3}}, &t).ok());
  uint32_t diagonal = k_none;
  for (uint32_t h = 0; h < 4 * t.triangles.size(); ++h) {
    if ((h & 3) == 3) continue;
    const Vec2 d = t.points[t.end(h)] - t.points[t.start(h)];
    if (std::fabs(d.x) == 1.0 && std::fabs(d.y) == 1.0 && t.start(h) < 8 && t.end(h) < 8) {
      diagonal = h;
    }
  }
  REQUIRE(diagonal != k_none);
  const uint32_t a = t.start(diagonal);
  flip(&t, diagonal);
  check_structure(t);
  check_delaunay(t);
  CHECK(t.start(Triangulation::next(diagonal)) != a);
}

TEST_CASE("the refusals") {
  Heap heap;
  Triangulation t(heap.context);
  REQUIRE(insert_all({{0, 0}, {4, 0}, {2, 2}, {2, -2}, {2, 1}}, &t).ok());
  CHECK(insert_point(&t, {2, 1}).code == Code::patch_folded);
  CHECK(insert_point(&t, {100, 1}).code == Code::bad_argument);
  REQUIRE(recover_edge(&t, 4, 5).ok());
  CHECK(recover_edge(&t, 4, 5).ok());
  CHECK(insert_point(&t, {1, 0}).code == Code::patch_folded);
  CHECK(recover_edge(&t, 6, 7).code == Code::patch_folded);
  CHECK(recover_edge(&t, 8, 7).code == Code::patch_folded);
  check_structure(t);
  check_delaunay(t);
}

TEST_CASE("the outside ends at closed constraints") {
  Heap heap;
  Triangulation t(heap.context);
  REQUIRE(insert_all({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {2, 3}, {7, 7}}, &t).ok());
  for (uint32_t i = 0; i < 4; ++i) REQUIRE(recover_edge(&t, 4 + i, 4 + (i + 1) % 4).ok());
  REQUIRE(mark_outside(&t).ok());
  double inside = 0.0;
  for (const Triangle& triangle : t.triangles) {
    if ((triangle.flags & k_outside) != 0) continue;
    const Vec2 a = t.points[triangle.vertex[0]];
    inside += cross(t.points[triangle.vertex[1]] - a, t.points[triangle.vertex[2]] - a) / 2.0;
  }
  CHECK(inside == 16.0);
}
