#include "planar/region.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <utility>

#include "num/predicates.h"
#include "planar/polygon_mesh.h"
#include "support/context.h"

using namespace unit;
using namespace wireskin;
using namespace wireskin::planar;

namespace {

constexpr double k_pi = 3.14159265358979323846;

struct Scene {
  std::vector<Vec2> points;
  std::vector<uint32_t> border, lines;
  bool join = true;

  Region region() const { return {view(points), view(border), view(lines), join}; }
  uint32_t next() const { return static_cast<uint32_t>(points.size()); }

  void loop(const std::vector<Vec2>& corners) {
    const uint32_t first = next(), count = static_cast<uint32_t>(corners.size());
    for (uint32_t i = 0; i < count; ++i) {
      points.push_back(corners[i]);
      border.push_back(first + i);
      border.push_back(first + (i + 1) % count);
    }
  }
  void polyline(const std::vector<Vec2>& corners) {
    const uint32_t first = next();
    for (uint32_t i = 0; i < corners.size(); ++i) {
      points.push_back(corners[i]);
      if (i > 0) lines.insert(lines.end(), {first + i - 1, first + i});
    }
  }
};

std::vector<Vec2> square(double low, double high) {
  return {{low, low}, {high, low}, {high, high}, {low, high}};
}

std::vector<Vec2> circle(Vec2 centre, double radius, int count) {
  std::vector<Vec2> result;
  for (int i = 0; i < count; ++i) {
    const double t = 2.0 * k_pi * i / count;
    result.push_back(centre + radius * Vec2{std::cos(t), std::sin(t)});
  }
  return result;
}

struct Result {
  Status status;
  Conflict conflict;
  std::vector<Vec2> points;
  std::vector<uint32_t> triangles, joined;
  double area = 0.0, least = 180.0, median = 0.0;
  std::set<std::pair<uint32_t, uint32_t>> edges;

  bool has(uint32_t a, uint32_t b) const { return edges.count({a, b}) + edges.count({b, a}) > 0; }
};

double least_angle(const Vec2& a, const Vec2& b, const Vec2& c) {
  const auto at = [](const Vec2& u, const Vec2& v) {
    return std::atan2(std::fabs(cross(u, v)), dot(u, v)) * 180.0 / k_pi;
  };
  return std::min({at(b - a, c - a), at(c - b, a - b), at(a - c, b - c)});
}

Result mesh(const Scene& scene, double spacing) {
  Heap heap;
  Result r;
  PolygonMesh result(heap.context);
  r.status = mesh_region(heap.context, scene.region(), spacing, &result);
  r.conflict = result.conflict;
  r.points = to_vector(result.points);
  r.triangles = to_vector(result.triangles);
  r.joined = to_vector(result.joined);
  std::vector<double> angles;
  for (size_t i = 0; i < r.triangles.size(); i += 3) {
    const uint32_t* v = &r.triangles[i];
    const Vec2 a = r.points[v[0]], b = r.points[v[1]], c = r.points[v[2]];
    CHECK(orient2d(a, b, c) > 0.0);
    r.area += 0.5 * cross(b - a, c - a);
    angles.push_back(least_angle(a, b, c));
    for (int k = 0; k < 3; ++k) CHECK(r.edges.insert({v[k], v[(k + 1) % 3]}).second);
  }
  if (!r.status.ok()) {
    CHECK(r.points.empty());
    return r;
  }
  CHECK(std::memcmp(r.points.data(), scene.points.data(), scene.points.size() * sizeof(Vec2)) == 0);
  std::sort(angles.begin(), angles.end());
  r.least = angles[0];
  r.median = angles[angles.size() / 2];
  return r;
}

}  // namespace

TEST_CASE("a disc with three holes, a line and a point keeps all their edges and good angles") {
  Scene s;
  s.loop(circle({0, 0}, 1.0, 126));
  s.loop(circle({0.3, 0.2}, 0.2, 25));
  s.loop(circle({-0.4, 0.0}, 0.3, 38));
  std::vector<Vec2> clockwise = circle({0.1, -0.5}, 0.15, 19);
  std::reverse(clockwise.begin(), clockwise.end());
  s.loop(clockwise);
  std::vector<Vec2> wave;
  for (int i = 0; i <= 20; ++i) wave.push_back({-0.5 + 0.05 * i, 0.6 + 0.1 * std::sin(0.5 * i)});
  s.polyline(wave);
  s.points.push_back({0.7, -0.3});
  const Result r = mesh(s, 0.05);
  REQUIRE(r.status.ok());
  for (const auto* list : {&s.border, &s.lines}) {
    for (size_t i = 0; i < list->size(); i += 2) CHECK(r.has((*list)[i], (*list)[i + 1]));
  }
  CHECK(std::count(r.triangles.begin(), r.triangles.end(), s.next() - 1) >= 5);
  CHECK(r.least >= 25.0);
  CHECK(r.median >= 55.0);
}

TEST_CASE("nested loops: every second ring is inside") {
  Scene s;
  for (double high : {8.0, 6.0, 4.0, 2.0}) s.loop(square(-high, high));
  CHECK(mesh(s, 1.0).area == doctest::Approx(256.0 - 144.0 + 64.0 - 16.0));
}

TEST_CASE("a hole that touches the border: at a point of both by index, or by place") {
  Scene s;
  s.points = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 2}, {2, 1}};
  s.border = {0, 1, 1, 2, 2, 3, 3, 0, 0, 4, 4, 5, 5, 0};
  s.join = false;
  Result r = mesh(s, 2.0);
  REQUIRE(r.status.ok());
  CHECK(r.area == doctest::Approx(14.5));
  Scene placed;
  placed.loop(square(0, 4));
  placed.loop({{0, 0}, {1, 2}, {2, 1}});
  r = mesh(placed, 2.0);
  REQUIRE(r.status.ok());
  CHECK(r.area == doctest::Approx(14.5));
  CHECK(r.joined[4] == 0);
  CHECK(r.joined[5] == 5);
  placed.join = false;
  r = mesh(placed, 2.0);
  CHECK(r.status.code == Code::patch_folded);
  CHECK(std::min(r.conflict.point[0], r.conflict.point[1]) == 0);
  CHECK(std::max(r.conflict.point[0], r.conflict.point[1]) == 4);
}

TEST_CASE(
    "lines end on the border, share points and close; runs of points on one line are joined") {
  Scene s;
  s.loop({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {4, 4}, {0, 4}});
  s.points.insert(s.points.end(), {{2, 2}, {3, 1}, {3, 3}});
  s.lines = {2, 7, 7, 8, 8, 9, 9, 7};
  Result r = mesh(s, 1.0);
  REQUIRE(r.status.ok());
  for (size_t i = 0; i < s.lines.size(); i += 2) CHECK(r.has(s.lines[i], s.lines[i + 1]));
  // A line along four edges of the border adds nothing.
  s.lines.insert(s.lines.end(), {0, 4});
  CHECK(mesh(s, 1.0).status.ok());
  s.join = false;
  r = mesh(s, 1.0);
  CHECK(r.status.code == Code::patch_folded);
  CHECK(r.conflict.edge[0] == 11);
  CHECK(r.conflict.point[0] >= 1);
  CHECK(r.conflict.point[0] <= 3);
}

TEST_CASE("a border edge given twice divides nothing but stays an edge") {
  Scene s;
  s.loop(square(0, 4));
  s.points.insert(s.points.end(), {{1, 1}, {3, 3}});
  s.border.insert(s.border.end(), {4, 5, 5, 4});
  const Result r = mesh(s, 10.0);
  REQUIRE(r.status.ok());
  CHECK(r.area == doctest::Approx(16.0));
  CHECK(r.has(4, 5));
}

TEST_CASE("what cannot be meshed is named") {
  Scene crossing;
  crossing.loop(square(0, 4));
  crossing.polyline({{1, 1}, {3, 3}});
  crossing.polyline({{1, 3}, {3, 1}});
  Result r = mesh(crossing, 1.0);
  CHECK(r.status.code == Code::patch_folded);
  CHECK(std::min(r.conflict.edge[0], r.conflict.edge[1]) == 4);
  CHECK(std::max(r.conflict.edge[0], r.conflict.edge[1]) == 5);

  Scene open;
  open.loop(square(0, 4));
  open.border.pop_back();
  open.border.pop_back();
  r = mesh(open, 1.0);
  CHECK(r.status.code == Code::open_network);
  CHECK(r.status.place.vertex == 0);

  Scene outside;
  outside.loop(square(0, 4));
  outside.loop(square(1, 3));
  outside.points.push_back({2, 2});
  r = mesh(outside, 1.0);
  CHECK(r.status.code == Code::bad_argument);
  CHECK(r.conflict.point[0] == 8);

  Scene chord;  // from one tooth of a comb to the next, through the open
  chord.loop({{0, 0}, {5, 0}, {5, 5}, {4, 5}, {4, 1}, {1, 1}, {1, 5}, {0, 5}});
  chord.lines = {3, 6};
  r = mesh(chord, 1.0);
  CHECK(r.status.code == Code::bad_argument);
  CHECK(r.conflict.edge[0] == 8);

  Scene bad;
  bad.loop(square(0, 4));
  bad.lines = {0, 17};
  r = mesh(bad, 1.0);
  CHECK(r.status.code == Code::index_out_of_range);
  CHECK(r.conflict.edge[0] == 4);
  bad.lines = {0};
  CHECK(mesh(bad, 1.0).status.code == Code::bad_argument);
  bad.lines.clear();
  bad.points[2].x = std::numeric_limits<double>::quiet_NaN();
  r = mesh(bad, 1.0);
  CHECK(r.status.code == Code::not_a_number);
  CHECK(r.status.place.vertex == 2);
  CHECK(mesh(Scene(), 1.0).status.code == Code::patch_without_plane);
}

TEST_CASE("angles and sizes on shapes: coarse sides, fine holes, short edges, thin rings") {
  for (const double ratio : {2.0, 4.0, 8.0}) {
    CAPTURE(ratio);
    Scene s;
    s.loop(circle({0, 0}, 1.0, 200));
    s.loop(circle({0, 0}, 0.3, static_cast<int>(60 / ratio)));
    const Result r = mesh(s, 2.0 * k_pi / 200);
    REQUIRE(r.status.ok());
    CHECK(r.least >= 24.0);
    CHECK(r.median >= 50.0);
    // Coarse at the hole: the triangles on its edges are about as large as those.
    for (size_t i = 0; i < r.triangles.size(); i += 3) {
      const uint32_t* v = &r.triangles[i];
      for (int k = 0; k < 3; ++k) {
        const uint32_t a = v[k], b = v[(k + 1) % 3];
        if (a < 200 || b < 200 || a >= s.next() || b >= s.next()) continue;
        const Vec2 apex = r.points[v[(k + 2) % 3]];
        const double edge = length(r.points[a] - r.points[b]);
        CHECK(length(apex - 0.5 * (r.points[a] + r.points[b])) > 0.35 * edge);
      }
    }
  }
  for (const double part : {0.5, 0.2, 0.1}) {
    CAPTURE(part);
    std::vector<Vec2> points = circle({0, 0}, 1.0, 100);
    const double t = -2.0 * k_pi * part / 100;
    points.push_back({std::cos(t), std::sin(t)});
    Scene s;
    s.loop(points);
    const Result r = mesh(s, 2.0 * k_pi / 100);
    REQUIRE(r.status.ok());
    CHECK(r.least >= 20.0);
  }
  Scene ring;
  ring.loop(circle({0, 0}, 1.0, 200));
  ring.loop(circle({0, 0}, 0.9, 180));
  CHECK(mesh(ring, 2.0 * k_pi / 200).least >= 25.0);
}

TEST_CASE("many edges at one point and long edges across many triangles stay cheap") {
  // A hub with 1000 spokes, then a strip of 1000 points on both sides of one long line.
  Scene wheel;
  const int count = 1000;
  wheel.loop(circle({0, 0}, 1.0, count));
  wheel.points.push_back({0, 0});
  for (uint32_t i = 0; i < count; ++i) wheel.lines.insert(wheel.lines.end(), {count, i});
  CHECK(mesh(wheel, 1.0).status.ok());
  Scene strip;
  std::vector<Vec2> outline;
  for (int i = 0; i <= count; ++i) outline.push_back({i + 0.0, -1.0 - 1e-3 * i - 1e-8 * i * i});
  for (int i = count; i >= 0; --i) outline.push_back({i + 0.5, 1.0 + 1e-3 * i + 1e-8 * i * i});
  outline.push_back({-1.0, 0.0});
  strip.loop(outline);
  strip.points.push_back({count - 1.0, 0.0});
  strip.lines = {strip.next() - 2, strip.next() - 1};
  CHECK(mesh(strip, 1e6).status.ok());
}
