#include "flow/persistence.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "unit/flow/flow_sets.h"

using namespace wireskin;
using namespace unit;
using flow::Complex;
using flow::ComplexOptions;
using flow::Persistence;

namespace {

struct Found {
  Complex complex;
  Persistence persistence;

  Found(Heap& heap, const Points& points, double jitter = 1e-7, uint64_t seed = 0)
      : complex(heap.context), persistence(heap.context) {
    ComplexOptions options;
    options.jitter = jitter;
    options.seed = seed;
    must(flow::build_complex(heap.context, view(points), options, &complex));
    must(flow::find_persistence(heap.context, complex, &persistence));
  }
  double ratio(size_t i) const {
    return i < persistence.voids.size() ? persistence.voids[i].ratio : 1.0;
  }
};

// Pairs of squared radii (creation, filling) of all voids with a lifetime, by reducing the boundary
// matrix of tetrahedra in the order of their values (Edelsbrunner, Letscher, Zomorodian 2002): slow
// and sharing nothing with the union-find of the dual graph.
std::multiset<std::pair<double, double>> voids_by_reduction(const Complex& c) {
  const auto before = [](const Array<double>& f) {
    return [&f](uint32_t a, uint32_t b) { return f[a] != f[b] ? f[a] < f[b] : a < b; };
  };
  std::vector<uint32_t> tets(c.tet_count()), triangles(c.triangle_count()),
      rank(c.triangle_count());
  for (uint32_t i = 0; i < tets.size(); ++i) tets[i] = i;
  for (uint32_t i = 0; i < triangles.size(); ++i) triangles[i] = i;
  std::sort(tets.begin(), tets.end(), before(c.tet_value));
  std::sort(triangles.begin(), triangles.end(), before(c.triangle_value));
  for (uint32_t i = 0; i < triangles.size(); ++i) rank[triangles[i]] = i;
  std::map<uint32_t, std::set<uint32_t>> column_of_pivot;
  std::multiset<std::pair<double, double>> voids;
  for (const uint32_t t : tets) {
    std::set<uint32_t> column;
    for (uint32_t i = 0; i < 4; ++i) column.insert(rank[c.tet_triangle[4 * t + i]]);
    for (auto it = column_of_pivot.find(*column.rbegin()); it != column_of_pivot.end();
         it = column_of_pivot.find(*column.rbegin())) {
      for (const uint32_t r : it->second) {
        if (!column.insert(r).second) column.erase(r);
      }
      REQUIRE(!column.empty());
    }
    const double birth = c.triangle_value[triangles[*column.rbegin()]];
    if (birth < c.tet_value[t]) voids.insert({birth, c.tet_value[t]});
    column_of_pivot[*column.rbegin()] = column;
  }
  return voids;
}

}  // namespace

TEST_CASE("ratios of simple networks") {
  Heap heap;
  const auto ratio = [&heap](const Points& p, size_t i) { return Found(heap, p).ratio(i); };
  CHECK(ratio(frame(cube_corners(), 50), 0) == doctest::Approx(std::sqrt(2.0)).epsilon(0.005));
  CHECK(ratio(frame(cube_corners(), 50), 1) < 1.01);
  CHECK(ratio(frame(octahedron_corners(), 50), 0) ==
        doctest::Approx(std::sqrt(3.0)).epsilon(0.005));
  CHECK(ratio(frame(tetrahedron_corners(), 50), 0) ==
        doctest::Approx(std::sqrt(1.5)).epsilon(0.005));
  CHECK(ratio(great_circles(100), 0) == doctest::Approx(std::sqrt(3.0)).epsilon(0.005));
  for (const double gap : {0.4, 1.2, 3.0}) {
    const double expected = std::sqrt(1.0 + gap * gap / 4.0) / std::max(1.0, gap / 2.0);
    CHECK(ratio(coaxial_circles(gap, 100), 0) == doctest::Approx(expected).epsilon(0.005));
  }
}

TEST_CASE("radii and the place of the cube's void") {
  Heap heap;
  const Found found(heap, frame(cube_corners(), 50));
  REQUIRE(!found.persistence.voids.empty());
  const flow::Void& v = found.persistence.voids[0];
  CHECK(v.creation == doctest::Approx(0.5).epsilon(0.001));
  CHECK(v.filling == doctest::Approx(std::sqrt(0.5)).epsilon(0.001));
  CHECK(found.persistence.creator[v.creator] == 1);
  CHECK(found.persistence.void_of[v.creator] == 0);
}

TEST_CASE("two cubes that share a face have two voids") {
  Points p = frame(cube_corners(), 40);
  const size_t half = p.size();
  for (size_t i = 0; i < half; ++i) p.push_back({p[i].x + 1.0, p[i].y, p[i].z});
  Heap heap;
  const Found found(heap, p);
  CHECK(found.ratio(0) == doctest::Approx(std::sqrt(2.0)).epsilon(0.005));
  CHECK(found.ratio(1) == doctest::Approx(std::sqrt(2.0)).epsilon(0.005));
  CHECK(found.ratio(2) < 1.05);
}

TEST_CASE("voids are those of the reduced boundary matrix") {
  Random random(4);
  for (const Points& p : {random_points(60, random), random_points(120, random), great_circles(12),
                          frame(cube_corners(), 4), coaxial_circles(1.0, 16)}) {
    for (const double jitter : {0.0, 1e-7}) {
      Heap heap;
      const Found found(heap, p, jitter);
      std::multiset<std::pair<double, double>> expected, got;
      const double cap = 0.375 * found.complex.diagonal * found.complex.diagonal;
      for (const auto& v : voids_by_reduction(found.complex)) {
        const double ratio = std::sqrt(std::min(v.second, cap) / std::min(v.first, cap));
        if (ratio > 1.0 + 1e-6) expected.insert(v);
      }
      for (const flow::Void& v : found.persistence.voids) {
        got.insert({found.complex.triangle_value[v.creator], found.complex.tet_value[v.maximum]});
      }
      CHECK(got == expected);
    }
  }
}

TEST_CASE("creators are a spanning tree of the tetrahedra and the outside; voids come by ratio") {
  Random random(5);
  Heap heap;
  const Found found(heap, random_points(300, random));
  size_t creators = 0;
  for (const uint8_t c : found.persistence.creator) creators += c;
  CHECK(creators == found.complex.tet_count());
  const auto& voids = found.persistence.voids;
  CHECK(voids.size() > 100);
  std::set<uint32_t> maxima;
  for (size_t i = 0; i < voids.size(); ++i) {
    if (i > 0) CHECK(voids[i].ratio <= voids[i - 1].ratio);
    CHECK(voids[i].ratio > 1.0);
    CHECK(maxima.insert(voids[i].maximum).second);
    CHECK(found.persistence.void_of[voids[i].creator] == i);
  }
}

TEST_CASE("other draws of the jitter do not change what matters") {
  Heap heap;
  for (const uint64_t seed : {7, 8, 9}) {
    CHECK(Found(heap, frame(cube_corners(), 20), 1e-7, seed).ratio(0) ==
          doctest::Approx(std::sqrt(2.0)).epsilon(1e-4));
  }
}

TEST_CASE("persistence of few points, and with failing memory") {
  Heap heap;
  CHECK(Found(heap, {}).persistence.voids.empty());
  CHECK(Found(heap, {{0, 0, 0}, {1, 0, 0}}).persistence.voids.empty());
  const Found triangle(heap, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  REQUIRE(triangle.persistence.creator.size() == 1);
  CHECK(triangle.persistence.creator[0] == 0);
  const Found found(heap, great_circles(24));
  for (size_t k = 0;; ++k) {
    REQUIRE(k < 50);
    heap.allocator.fail_at = heap.allocator.calls + k;
    Persistence persistence(heap.context);
    const Status status = flow::find_persistence(heap.context, found.complex, &persistence);
    if (status.ok()) {
      CHECK(k >= 6);
      break;
    }
    CHECK(status.code == Code::out_of_memory);
  }
  heap.allocator.fail_at = scenes::FaultyAllocator::k_never;
  heap.cancel_at = heap.checkpoints;
  Persistence persistence(heap.context);
  CHECK(flow::find_persistence(heap.context, found.complex, &persistence).code == Code::cancelled);
}
