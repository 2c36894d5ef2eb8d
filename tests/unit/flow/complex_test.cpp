#include "flow/complex.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "flow/critical.h"
#include "num/predicates3.h"
#include "unit/flow/flow_sets.h"

using namespace wireskin;
using namespace unit;
using flow::Complex;
using flow::ComplexOptions;

namespace {

Complex build(Heap& heap, const Points& points, double jitter = 1e-7) {
  Complex complex(heap.context);
  ComplexOptions options;
  options.jitter = jitter;
  must(flow::build_complex(heap.context, view(points), options, &complex));
  return complex;
}

size_t wrong_tets(const Complex& c) {
  size_t wrong = 0;
  for (uint32_t t = 0; t < c.tet_count(); ++t) {
    const uint32_t* v = &c.tet[4 * t];
    if (!(orient3d(c.point[v[0]], c.point[v[1]], c.point[v[2]], c.point[v[3]]) > 0.0)) ++wrong;
    for (uint32_t i = 0; i < 4; ++i) {
      const uint32_t triangle = c.tet_triangle[4 * t + i];
      const uint32_t* side = &c.triangle_side[2 * triangle];
      const uint32_t other = c.tet_neighbour[4 * t + i];
      if (!((side[0] == t && side[1] == other) || (side[1] == t && side[0] == other))) ++wrong;
      std::set<uint32_t> corners(v, v + 4);
      corners.erase(v[i]);
      const uint32_t* w = &c.triangle[3 * triangle];
      if (corners != std::set<uint32_t>(w, w + 3)) ++wrong;
      // Counter-clockwise seen from the second side: the first side's corner lies behind.
      const double behind = orient3d(c.point[w[0]], c.point[w[1]], c.point[w[2]], c.point[v[i]]);
      if (side[0] == t ? !(behind < 0.0) : !(behind > 0.0)) ++wrong;
    }
  }
  return wrong;
}

size_t wrong_edges(const Complex& c) {
  size_t wrong = 0;
  std::map<std::pair<uint32_t, uint32_t>, std::set<uint32_t>> triangles;
  for (uint32_t t = 0; t < c.triangle_count(); ++t) {
    const uint32_t* v = &c.triangle[3 * t];
    for (uint32_t k = 0; k < 3; ++k) {
      const std::pair<uint32_t, uint32_t> ends = std::minmax({v[(k + 1) % 3], v[(k + 2) % 3]});
      triangles[ends].insert(t);
      const uint32_t e = c.triangle_edge[3 * t + k];
      if (c.edge[2 * e] != ends.first || c.edge[2 * e + 1] != ends.second) ++wrong;
      if (flow::find_edge(c, ends.second, ends.first) != e) ++wrong;
    }
  }
  if (triangles.size() != c.edge_count()) ++wrong;
  uint32_t e = 0;
  for (const auto& [ends, expected] : triangles) {  // in lexicographic order, as the edges are
    if (c.edge[2 * e] != ends.first || c.edge[2 * e + 1] != ends.second) ++wrong;
    const auto listed = c.triangles_of(e++);
    if (std::set<uint32_t>(listed.begin(), listed.end()) != expected) ++wrong;
    if (listed.size() != expected.size()) ++wrong;
  }
  for (uint32_t u = 0; u < c.point.size(); ++u) {
    for (uint32_t v = 0; v < c.point.size(); ++v) {
      const bool known = triangles.count(std::minmax({u, v})) != 0;
      if ((flow::find_edge(c, u, v) != k_none) != known) ++wrong;
    }
  }
  return wrong;
}

size_t not_monotone(const Complex& c) {
  size_t wrong = 0;
  for (uint32_t t = 0; t < c.triangle_count(); ++t) {
    for (uint32_t k = 0; k < 2; ++k) {
      wrong += c.triangle_value[t] > c.tet_value_of(c.triangle_side[2 * t + k]) ? 1 : 0;
    }
    for (uint32_t k = 0; k < 3; ++k) {
      wrong += c.edge_value[c.triangle_edge[3 * t + k]] > c.triangle_value[t] ? 1 : 0;
    }
    wrong += c.triangle_value[t] > 0.0 ? 0 : 1;
  }
  return wrong;
}

// Every simplex as the sorted places of its corners, with its value: independent of numbers.
using Place = std::array<double, 3>;
std::multimap<std::vector<Place>, double> valued_simplices(const Complex& c) {
  std::multimap<std::vector<Place>, double> all;
  const auto add = [&](const Array<uint32_t>& vertices, const Array<double>& values, size_t n) {
    for (size_t i = 0; i < values.size(); ++i) {
      std::vector<Place> corners;
      for (size_t k = 0; k < n; ++k) {
        const Vec3& p = c.point[vertices[n * i + k]];
        corners.push_back({p.x, p.y, p.z});
      }
      std::sort(corners.begin(), corners.end());
      all.emplace(corners, values[i]);
    }
  };
  add(c.edge, c.edge_value, 2);
  add(c.triangle, c.triangle_value, 3);
  add(c.tet, c.tet_value, 4);
  return all;
}

// Simplices swallowed alone, by equality of values; what critical.h asks of the points.
int64_t euler_by_values(const Complex& c) {
  std::map<double, int64_t> sum;
  for (const double f : c.edge_value) --sum[f];
  for (const double f : c.triangle_value) ++sum[f];
  for (const double f : c.tet_value) --sum[f];
  int64_t euler = 0;
  for (uint32_t i = 0; i < c.same_as.size(); ++i) euler += c.same_as[i] == i ? 1 : 0;
  for (const auto& group : sum) {
    CHECK(std::abs(group.second) <= 1);
    euler += group.second;
  }
  return euler;
}

}  // namespace

TEST_CASE("incidences agree with each other and values are monotone") {
  Random random(1);
  for (const Points& p : {random_points(150, random), great_circles(24), frame(cube_corners(), 6),
                          coaxial_circles(0.3, 30)}) {
    for (const double jitter : {0.0, 1e-7}) {
      Heap heap;
      const Complex c = build(heap, p, jitter);
      CHECK(wrong_tets(c) == 0);
      CHECK(wrong_edges(c) == 0);
      CHECK(not_monotone(c) == 0);
      CHECK(c.tet_count() > 60);
    }
  }
}

TEST_CASE("values of one regular and one flat tetrahedron") {
  Heap heap;
  const Complex c = build(heap, tetrahedron_corners(), 0.0);  // edges of length sqrt 8
  REQUIRE(c.tet_count() == 1);
  CHECK(c.tet_value[0] == doctest::Approx(3.0).epsilon(1e-14));
  for (const double f : c.triangle_value) CHECK(f == doctest::Approx(8.0 / 3.0).epsilon(1e-14));
  for (const double f : c.edge_value) CHECK(f == doctest::Approx(2.0).epsilon(1e-14));
  // A low pyramid on an equilateral base: the apex lies in the ball of the base, and the base is
  // swallowed with the tetrahedron.
  const double s = std::sqrt(0.75);
  const Complex flat = build(heap, {{1, 0, 0}, {-0.5, s, 0}, {-0.5, -s, 0}, {0, 0, 0.5}}, 0.0);
  REQUIRE(flat.tet_count() == 1);
  CHECK(flat.tet_value[0] == doctest::Approx(25.0 / 16.0));
  const uint32_t apex = flat.tet[0] == 3 ? 0 : flat.tet[1] == 3 ? 1 : flat.tet[2] == 3 ? 2 : 3;
  const uint32_t base = flat.tet_triangle[apex];
  CHECK(flat.triangle_gabriel[base] == 0);
  CHECK(flat.triangle_value[base] == flat.tet_value[0]);
}

TEST_CASE("values sum to Euler characteristic one, simplex by simplex, after the jitter") {
  Random random(2);
  for (const Points& p : {random_points(400, random), great_circles(48), frame(cube_corners(), 16),
                          frame(octahedron_corners(), 16), coaxial_circles(0.4, 60)}) {
    Heap heap;
    const Complex c = build(heap, p);
    CHECK(euler_by_values(c) == 1);
    flow::CriticalPoints critical(heap.context);
    must(flow::find_critical_points(c, &critical));
    CHECK(critical.euler() == 1);
  }
}

TEST_CASE("the complex is the same for any order of the points, ties included") {
  Random random(3);
  for (const Points& p :
       {random_points(200, random), frame(cube_corners(), 8), great_circles(16)}) {
    for (const double jitter : {0.0, 1e-7}) {
      Points other(p.rbegin(), p.rend());
      std::rotate(other.begin(), other.begin() + static_cast<long>(p.size() / 3), other.end());
      Heap heap;
      CHECK(valued_simplices(build(heap, p, jitter)) ==
            valued_simplices(build(heap, other, jitter)));
    }
  }
}

TEST_CASE("fewer than four places") {
  Heap heap;
  const Complex none = build(heap, {});
  CHECK(none.edge_count() == 0);
  CHECK(none.tet_count() == 0);
  const Complex one = build(heap, {{1, 2, 3}, {1, 2, 3}});
  CHECK(one.edge_count() == 0);
  CHECK(flow::find_edge(one, 0, 1) == k_none);
  const Complex two = build(heap, {{0, 0, 0}, {0, 0, 0}, {0, 2, 0}, {0, 0, 0}}, 0.0);
  REQUIRE(two.edge_count() == 1);
  CHECK(two.edge_value[0] == 1.0);
  CHECK(two.triangles_of(0).empty());
  CHECK(flow::find_edge(two, 2, 0) == 0);
  CHECK(flow::find_edge(two, 0, 1) == k_none);
  CHECK(flow::find_edge(two, 2, 3) == k_none);
  const Complex three = build(heap, {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}, 0.0);
  REQUIRE(three.triangle_count() == 1);
  CHECK(three.edge_count() == 3);
  CHECK(three.triangle_side[0] == k_none);
  CHECK(three.triangle_value[0] == doctest::Approx(6.25));
  CHECK(three.edge_value[flow::find_edge(three, 0, 1)] == 4.0);
  CHECK(three.edge_value[flow::find_edge(three, 0, 2)] == 2.25);
  CHECK(wrong_edges(three) == 0);
  const Complex line = build(heap, {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, 0.0);
  REQUIRE(line.triangle_count() == 1);  // three places on a line: a triangle without area
  CHECK(line.edge_value[flow::find_edge(line, 0, 1)] == 0.25);
  CHECK(not_monotone(line) == 0);
}

TEST_CASE("flat, straight, too many and bad points") {
  Heap heap;
  Points line, plane;
  for (int i = 0; i < 30; ++i) line.push_back({0.1 * i, 0.2 * i, -0.1 * i});
  for (int i = 0; i < 36; ++i) plane.push_back({double(i % 6), double(i / 6), 0.0});
  for (const Points& p : {line, plane}) {
    const Complex c = build(heap, p);
    CHECK(wrong_tets(c) == 0);
    CHECK(wrong_edges(c) == 0);
    CHECK(not_monotone(c) == 0);
    Complex flat(heap.context);
    ComplexOptions options;
    options.jitter = 0.0;
    CHECK(flow::build_complex(heap.context, view(p), options, &flat).code == Code::bad_argument);
    options.jitter = 1e-7;
    options.most_tets = 20;
    CHECK(flow::build_complex(heap.context, view(p), options, &flat).code == Code::too_large);
  }
  line[7].y = std::nan("");
  Complex c(heap.context);
  const Status status = flow::build_complex(heap.context, view(line), {}, &c);
  CHECK(status.code == Code::bad_argument);
  CHECK(c.tet_count() == 0);
}

TEST_CASE("the complex survives every failed allocation and every cancellation") {
  const Points p = frame(cube_corners(), 12);
  for (const bool cancel : {false, true}) {
    size_t failures = 0;
    for (bool done = false; !done; ++failures) {
      Heap heap;
      (cancel ? heap.cancel_at : heap.allocator.fail_at) = failures;
      {
        Complex c(heap.context);
        const Status status = flow::build_complex(heap.context, view(p), {}, &c);
        done = status.ok();
        if (!done) CHECK(status.code == (cancel ? Code::cancelled : Code::out_of_memory));
      }
      CHECK(heap.allocator.clean());
      REQUIRE(failures < 300);
    }
    CHECK(failures > (cancel ? 4 : 25));
  }
}
