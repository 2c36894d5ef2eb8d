#include "flow/delaunay.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "num/predicates3.h"
#include "support/context.h"

using namespace wireskin;
using namespace unit;
using flow::Delaunay;
using flow::Tetrahedron;

namespace {

constexpr uint32_t k_many = 1u << 24;

struct Result {
  std::vector<Tetrahedron> tets;
  std::vector<uint32_t> same_as;
  uint32_t places;
  int dimension;
};

Result run(const std::vector<Vec3>& points) {
  Heap heap;
  Result result;
  {
    Delaunay d(heap.context);
    must(flow::triangulate(heap.context, view(points), k_many, &d));
    result = {to_vector(d.tets), to_vector(d.same_as), d.places, d.dimension};
  }
  CHECK(heap.allocator.clean());
  return result;
}

double side(const std::vector<Vec3>& p, const std::array<uint32_t, 4>& v) {
  return orient3d(p[v[0]], p[v[1]], p[v[2]], p[v[3]]);
}

// Links are mutual and across the same three vertices, orientations positive.
size_t wrong_links(const std::vector<Vec3>& p, const Result& r) {
  size_t wrong = 0;
  for (uint32_t t = 0; t < r.tets.size(); ++t) {
    const Tetrahedron& tet = r.tets[t];
    if (!(side(p, {tet.vertex[0], tet.vertex[1], tet.vertex[2], tet.vertex[3]}) > 0.0)) ++wrong;
    for (uint32_t i = 0; i < 4; ++i) {
      if (tet.across[i] == k_none) continue;
      const Tetrahedron& other = r.tets[tet.across[i] >> 2];
      const uint32_t back = tet.across[i] & 3;
      if (other.across[back] != 4 * t + i) ++wrong;
      std::multiset<uint32_t> mine(tet.vertex, tet.vertex + 4),
          others(other.vertex, other.vertex + 4);
      mine.erase(tet.vertex[i]);
      others.erase(other.vertex[back]);
      if (mine != others) ++wrong;
    }
  }
  return wrong;
}

// Points inside circumscribed balls, every tetrahedron against every point.
size_t wrong_balls(const std::vector<Vec3>& p, const Result& r) {
  size_t wrong = 0;
  for (const Tetrahedron& t : r.tets) {
    for (const Vec3& q : p) {
      if (insphere(p[t.vertex[0]], p[t.vertex[1]], p[t.vertex[2]], p[t.vertex[3]], q) > 0.0)
        ++wrong;
    }
  }
  return wrong;
}

// Every face of the hull has all points behind it or on it: with the links, this and the Euler
// characteristic say that the tetrahedra fill the convex hull exactly once.
size_t wrong_hull(const std::vector<Vec3>& p, const Result& r) {
  size_t wrong = 0;
  for (const Tetrahedron& t : r.tets) {
    for (uint32_t i = 0; i < 4; ++i) {
      if (t.across[i] != k_none) continue;
      for (const Vec3& q : p) {
        Vec3 v[4];
        for (uint32_t k = 0; k < 4; ++k) v[k] = k == i ? q : p[t.vertex[k]];
        if (orient3d(v[0], v[1], v[2], v[3]) < 0.0) ++wrong;
      }
    }
  }
  return wrong;
}

int64_t euler(const Result& r) {
  std::set<uint32_t> vertices;
  std::set<std::pair<uint32_t, uint32_t>> edges;
  std::set<std::array<uint32_t, 3>> triangles;
  for (const Tetrahedron& t : r.tets) {
    std::array<uint32_t, 4> v = {t.vertex[0], t.vertex[1], t.vertex[2], t.vertex[3]};
    std::sort(v.begin(), v.end());
    vertices.insert(v.begin(), v.end());
    for (int i = 0; i < 4; ++i) {
      for (int k = i + 1; k < 4; ++k) edges.insert({v[i], v[k]});
    }
    triangles.insert({v[0], v[1], v[2]});
    triangles.insert({v[0], v[1], v[3]});
    triangles.insert({v[0], v[2], v[3]});
    triangles.insert({v[1], v[2], v[3]});
  }
  CHECK(vertices.size() == r.places);
  return static_cast<int64_t>(vertices.size()) - static_cast<int64_t>(edges.size()) +
         static_cast<int64_t>(triangles.size()) - static_cast<int64_t>(r.tets.size());
}

// The tetrahedra as sets of places, to compare results with different numberings.
std::set<std::vector<std::array<double, 3>>> as_places(const std::vector<Vec3>& p,
                                                       const Result& r) {
  std::set<std::vector<std::array<double, 3>>> all;
  for (const Tetrahedron& t : r.tets) {
    std::vector<std::array<double, 3>> corners;
    for (uint32_t v : t.vertex) corners.push_back({p[v].x, p[v].y, p[v].z});
    std::sort(corners.begin(), corners.end());
    all.insert(corners);
  }
  return all;
}

void check_all(const std::vector<Vec3>& p, bool permute) {
  const Result r = run(p);
  if (r.dimension < 3) {
    CHECK(r.tets.empty());
    for (size_t i = 0; i + 3 < p.size(); ++i) {
      CHECK(orient3d(p[0], p[i + 1], p[i + 2], p[i + 3]) == 0.0);
    }
    return;
  }
  CHECK(wrong_links(p, r) == 0);
  CHECK(wrong_balls(p, r) == 0);
  CHECK(wrong_hull(p, r) == 0);
  CHECK(euler(r) == 1);
  if (!permute) return;
  std::vector<Vec3> reversed(p.rbegin(), p.rend());
  std::rotate(reversed.begin(), reversed.begin() + static_cast<long>(p.size() / 3), reversed.end());
  CHECK(as_places(p, r) == as_places(reversed, run(reversed)));
}

Vec3 on_sphere(Random& random) {
  return wireskin::unit(Vec3{random(), random(), random()});
}

// One small point set out of many kinds, most of them as degenerate as can be.
std::vector<Vec3> adversarial(uint32_t kind, Random& random) {
  std::vector<Vec3> p;
  const uint32_t n = 4 + random.below(16);
  const auto integer = [&](uint32_t most) { return static_cast<double>(random.below(most)); };
  const auto ulps = [&](double x) { return x + (integer(5) - 2.0) * 0x1p-52; };
  static const Vec3 k_ring[12] = {{5, 0, 0},  {3, 4, 0},  {4, 3, 0},   {0, 5, 0},
                                  {-3, 4, 0}, {-5, 0, 0}, {-4, -3, 0}, {0, -5, 0},
                                  {0, 3, 4},  {0, -3, 4}, {0, 0, 5},   {4, 0, 3}};
  for (uint32_t i = 0; i < n; ++i) {
    const double angle = 3.14159265 * random();
    switch (kind % 12) {
      case 0:
        p.push_back({random(), random(), random()});
        break;
      case 1:
        p.push_back({integer(3), integer(3), integer(3)});
        break;
      case 2:
        p.push_back({integer(4), integer(4), i == 0 ? 1.0 : 0.0});
        break;
      case 3:
        p.push_back(on_sphere(random));
        break;
      case 4:
        p.push_back(k_ring[random.below(12)]);
        break;
      case 5:
        p.push_back({ulps(1.0 + integer(2)), ulps(1.0 + integer(2)), ulps(1.0 + integer(2))});
        break;
      case 6:
        p.push_back({std::cos(angle), std::sin(angle), i % 2 == 0 ? 0.0 : 1.0});
        break;
      case 7:
        p.push_back(i % 2 == 0 ? Vec3{integer(9), 0, 0} : Vec3{0, integer(9), 1});
        break;
      case 8:
        p.push_back({0x1p140 * integer(3), 0x1p140 * random(), 0x1p140 * integer(3)});
        break;
      case 9:
        p.push_back(
            {0x1p-98 * (1 + integer(3)), 0x1p-98 * (1 + integer(3)), 0x1p-98 * (1 + integer(2))});
        break;
      case 10:
        p.push_back({std::ldexp(1.0, -static_cast<int>(random.below(40))), integer(2), random()});
        break;
      case 11:
        p.push_back({random(), 0x1p-40 * integer(3), 1e6 + integer(2)});
        break;
    }
  }
  return p;
}

std::vector<Vec3> grid(uint32_t n) {
  std::vector<Vec3> p;
  for (uint32_t i = 0; i < n * n * n; ++i) {
    p.push_back({static_cast<double>(i % n), static_cast<double>(i / n % n),
                 static_cast<double>(i / n / n)});
  }
  return p;
}

}  // namespace

TEST_CASE("small sets of every degenerate kind against every ball") {
#ifdef WIRESKIN_TESTS_SANITIZED
  constexpr uint32_t k_sets = 2000;
#else
  constexpr uint32_t k_sets = 6000;
#endif
  Random random(1);
  for (uint32_t i = 0; i < k_sets; ++i) {
    CAPTURE(i);
    check_all(adversarial(i, random), i % 4 == 0);
  }
}

TEST_CASE("a grid: every ball ties with others") {
  check_all(grid(6), true);
  const Result r = run(grid(8));
  double volume = 0.0;
  const std::vector<Vec3> p = grid(8);
  for (const Tetrahedron& t : r.tets) {
    volume += side(p, {t.vertex[0], t.vertex[1], t.vertex[2], t.vertex[3]}) / 6.0;
  }
  CHECK(volume == doctest::Approx(343.0).epsilon(1e-13));
}

TEST_CASE("larger sets: random, on a sphere, on two linked circles") {
  Random random(2);
  std::vector<Vec3> cloud, sphere, circles;
  for (int i = 0; i < 600; ++i) cloud.push_back({random(), random(), random()});
  for (int i = 0; i < 300; ++i) sphere.push_back(on_sphere(random));
  for (int i = 0; i < 40; ++i) {
    const double a = 6.283185307179586 * i / 40;
    circles.push_back({std::cos(a), std::sin(a), 0.0});
    circles.push_back({1.0 + std::cos(a + 0.01), 0.0, std::sin(a + 0.01)});
  }
  check_all(cloud, true);
  check_all(sphere, true);
  check_all(circles, true);
}

TEST_CASE("sets without volume say what they span") {
  CHECK(run({}).dimension == -1);
  CHECK(run({{1, 2, 3}}).dimension == 0);
  CHECK(run({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}).dimension == 0);
  CHECK(run({{1, 2, 3}, {1, 2, 4}}).dimension == 1);
  CHECK(run({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {3, 6, 9}, {-1, -2, -3}}).dimension == 1);
  CHECK(run({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {0, 0, 1}}).dimension == 2);
  CHECK(run({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}).dimension == 3);
  CHECK(run({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}).tets.size() == 1);
}

TEST_CASE("points at the same place are one") {
  const Result r =
      run({{0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {-0.0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -0.0, 1}});
  CHECK(r.places == 4);
  CHECK(r.same_as == std::vector<uint32_t>{0, 1, 2, 1, 4, 0, 0});
  REQUIRE(r.tets.size() == 1);
  for (const uint32_t v : r.tets[0].vertex) CHECK(r.same_as[v] == v);
}

TEST_CASE("bad coordinates and too many tetrahedra are statuses") {
  Heap heap;
  Delaunay d(heap.context);
  std::vector<Vec3> p = grid(3);
  for (const double bad : {std::nan(""), HUGE_VAL, -0x1p151, 0x1p-120}) {
    p[5].y = bad;
    const Status status = flow::triangulate(heap.context, view(p), k_many, &d);
    CHECK(status.code == Code::bad_argument);
    CHECK(status.place.sample == 5);
  }
  p = grid(5);
  CHECK(flow::triangulate(heap.context, view(p), 200, &d).code == Code::too_large);
  must(flow::triangulate(heap.context, view(p), k_many, &d));
  CHECK(d.tets.size() > 200);
}

TEST_CASE("every failed allocation and every cancellation ends cleanly") {
  Random random(3);
  std::vector<Vec3> p;
  for (int i = 0; i < 1500; ++i) p.push_back({random(), random(), random()});
  size_t failures = 0;
  for (size_t k = 0; k < 200; ++k) {
    Heap heap;
    heap.allocator.fail_at = k;
    Status status;
    {
      Delaunay d(heap.context);
      status = flow::triangulate(heap.context, view(p), k_many, &d);
    }
    CHECK(heap.allocator.clean());
    if (status.ok()) break;
    CHECK(status.code == Code::out_of_memory);
    ++failures;
  }
  CHECK(failures > 8);
  CHECK(failures < 200);
  Heap heap;
  heap.cancel_at = 3;
  {
    Delaunay d(heap.context);
    CHECK(flow::triangulate(heap.context, view(p), k_many, &d).code == Code::cancelled);
  }
  CHECK(heap.allocator.clean());
}
