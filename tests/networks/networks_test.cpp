#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <random>
#include <string>

#include "closed_forms.h"
#include "cut.h"
#include "io.h"
#include "shipped.h"
#include "trace.h"

using namespace networks;

namespace {

double least_gap(const Network& network) {
  double least = 1e300;
  for (const auto& curve : network.curves) {
    for (size_t i = 1; i < curve.vertices.size(); ++i) {
      least = std::min(least, distance(network.positions[curve.vertices[i - 1]],
                                       network.positions[curve.vertices[i]]));
    }
  }
  return least;
}

double greatest_gap(const Network& network) {
  double greatest = 0.0;
  for (const auto& curve : network.curves) {
    for (size_t i = 1; i < curve.vertices.size(); ++i) {
      greatest = std::max(greatest, distance(network.positions[curve.vertices[i - 1]],
                                             network.positions[curve.vertices[i]]));
    }
  }
  return greatest;
}

// The greatest cosine between a normal and the central difference of its curve.
double greatest_lean(const Network& network) {
  double greatest = 0.0;
  for (const auto& curve : network.curves) {
    for (size_t i = 1; i + 1 < curve.vertices.size(); ++i) {
      const Point chord =
          network.positions[curve.vertices[i + 1]] - network.positions[curve.vertices[i - 1]];
      const double lean = std::fabs(dot(unit(chord), network.normals[curve.vertices[i]]));
      greatest = std::max(greatest, lean);
    }
  }
  return greatest;
}

size_t count_boundary(const Network& network) {
  return static_cast<size_t>(std::count_if(network.curves.begin(), network.curves.end(),
                                           [](const auto& c) { return c.boundary; }));
}

struct Expected {
  const char* name;
  Network network;
  Surface surface;
  size_t vertices, curves, boundary, nodes, patches;
  long euler;
  double spacing;
};

std::vector<Expected> expected_networks() {
  const std::vector<double> quarters = {0.0, 90.0, 180.0, 270.0};
  return {
      {"sphere", sphere_great_circles(62), sphere_surface(1), 738, 3, 0, 6, 8, 2, .0253},
      {"3 half-meridians", sphere_meridians(3, {}, .03), sphere_surface(1), 314, 3, 0, 2, 3, 2,
       .03},
      {"4 half-meridians", sphere_meridians(4, {}, .03), sphere_surface(1), 418, 4, 0, 2, 4, 2,
       .03},
      {"latitudes", sphere_meridians(5, {-30, 30}, .03), sphere_surface(1), 0, 7, 0, 12, 15, 2,
       .03},
      {"torus 4x4", torus(4, 2, quarters, quarters, .12), torus_surface(4, 2), 1236, 8, 0, 16, 16,
       0, .12},
      {"torus 4x2", torus(4, 2, quarters, {0, 180}, .1765), torus_surface(4, 2), 564, 6, 0, 8, 8, 0,
       .1765},
      {"ellipsoid", ellipsoid(1.5, 1, .7, .03), ellipsoid_surface(1.5, 1, .7), 678, 3, 0, 6, 8, 2,
       .03},
      {"bumpy", bumpy_sphere(.0253), bumpy_surface(), 742, 3, 0, 6, 8, 2, .0253},
      {"saddle", saddle(.02), saddle_surface(), 681, 6, 4, 9, 4, 1, .02},
      {"cylinder", cylinder_band(1, .6, 4, .06), cylinder_surface(1), 284, 6, 2, 8, 4, 0, .06},
      {"sections", sphere_sections({.2, -.1, .3}, .03), sphere_surface(1), 0, 3, 0, 6, 8, 2, .03},
      {"catenoid", revolution_band(catenoid_surface(.8), -.5, .7, 5, .03), catenoid_surface(.8), 0,
       7, 2, 10, 5, 0, .03},
      {"cone", revolution_band(cone_surface(1, -.5), -.6, .7, 4, .03), cone_surface(1, -.5), 0, 6,
       2, 8, 4, 0, .03},
      {"hump", graph(hump_surface(.5, .45), {-1, .1, 1}, {-1, -.15, 1}, .03), hump_surface(.5, .45),
       0, 6, 4, 9, 4, 1, .03},
  };
}

}  // namespace

TEST_CASE("networks on closed forms: sizes, spacing, position, normals, topology") {
  for (const Expected& e : expected_networks()) {
    CAPTURE(e.name);
    const Network& network = e.network;
    if (e.vertices != 0) CHECK(network.positions.size() == e.vertices);
    CHECK(network.curves.size() == e.curves);
    CHECK(count_boundary(network) == e.boundary);
    // No vertex is there twice: what curves share is one vertex.
    std::vector<Point> sorted = network.positions;
    std::sort(sorted.begin(), sorted.end());
    CHECK(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end());
    CHECK(least_gap(network) > 0.9 * e.spacing);
    CHECK(greatest_gap(network) < 1.1 * e.spacing);
    for (size_t i = 0; i < network.positions.size(); ++i) {
      REQUIRE(std::fabs(e.surface.value(network.positions[i])) < 1e-12);
      REQUIRE(std::fabs(length(network.normals[i]) - 1.0) < 1e-14);
      const Point n = normal_at(e.surface, network.positions[i]);
      REQUIRE(distance(network.normals[i], n) < 1e-14);
    }
    CHECK(greatest_lean(network) < 2e-3);
    const Trace result = trace(network);
    CHECK(result.nodes == e.nodes);
    CHECK(result.components == 1);
    CHECK(result.patches.size() == e.patches);
    CHECK(result.euler_characteristic() == e.euler);
  }
}

TEST_CASE("segments of a curve between nodes are of equal length") {
  const Network sphere = sphere_great_circles(62);
  CHECK(greatest_gap(sphere) - least_gap(sphere) < 1e-13);
  // The first quarter of the first section of the ellipsoid; chords of equal arcs differ by the
  // square of spacing times curvature / 24.
  const Network e = ellipsoid(1.5, 1, .7, .03);
  const auto& curve = e.curves[0].vertices;
  double least = 1.0, greatest = 0.0;
  for (size_t i = 1; i <= 66; ++i) {
    const double gap = distance(e.positions[curve[i - 1]], e.positions[curve[i]]);
    least = std::min(least, gap);
    greatest = std::max(greatest, gap);
  }
  CHECK(greatest - least < 1e-5);
}

TEST_CASE("gradients point where the value grows, by its slope") {
  std::mt19937 random(7);
  const auto coordinate = [&] { return static_cast<double>(random()) / 4294967296.0 * 2.0 - 1.0; };
  for (const Surface& s : {sphere_surface(1), torus_surface(4, 2), cylinder_surface(1),
                           ellipsoid_surface(1.5, 1, .7), bumpy_surface(), saddle_surface()}) {
    for (int k = 0; k < 100; ++k) {
      const Point p = s.onto({coordinate(), coordinate(), coordinate()});
      const Point d = {coordinate(), coordinate(), coordinate()};
      const double slope = (s.value(p + 1e-6 * d) - s.value(p - 1e-6 * d)) / 2e-6;
      REQUIRE(std::fabs(s.value(p)) < 1e-12);
      REQUIRE(slope == doctest::Approx(dot(s.gradient(p), d)).epsilon(1e-6));
    }
  }
}

TEST_CASE("the closest point of a point pushed off along the normal is where it came from") {
  std::mt19937 random(11);
  const auto coordinate = [&] { return static_cast<double>(random()) / 4294967296.0 * 2.0 - 1.0; };
  for (const Surface& s : {sphere_surface(1), torus_surface(4, 2), cylinder_surface(1),
                           ellipsoid_surface(1.5, 1, .7), bumpy_surface(), saddle_surface()}) {
    for (int k = 0; k < 200; ++k) {
      Point seed = {coordinate(), coordinate(), coordinate()};
      if (length(seed) < 0.1) seed[0] += 0.5;
      const Point q = s.onto(seed);
      const double offset = 0.1 * coordinate();
      const Point p = q + offset * normal_at(s, q);
      REQUIRE(distance(closest_point(s, p), q) < 1e-10);
      REQUIRE(std::fabs(signed_distance(s, p) - offset) < 1e-12);
    }
  }
  // Far from the surface: the point found is stationary and no sampled point is nearer.
  const Surface s = saddle_surface();
  const Point p = {0.3, -0.2, 0.7};
  const Point q = closest_point(s, p);
  CHECK(length(cross(p - q, s.gradient(q))) < 1e-12);
  for (double x = -1; x <= 1; x += .05) {
    for (double y = -1; y <= 1; y += .05) {
      REQUIRE(distance(p, s.onto({x, y, 0})) > distance(p, q) - 1e-12);
    }
  }
}

TEST_CASE("the band as a mesh: counts, orientation, borders, tilted normals") {
  const BandMesh band = band_mesh(1.0, 0.6, 0.06, 30.0);
  CHECK(band.positions.size() == 2310 + 210);
  CHECK(std::count(band.constrained.begin(), band.constrained.end(), 1) == 210);
  CHECK(band.triangles.size() == 2 * 105 * 23);
  std::map<std::pair<uint32_t, uint32_t>, int> uses;
  double area = 0.0;
  for (const auto& t : band.triangles) {
    const Point n = cross(band.positions[t[1]] - band.positions[t[0]],
                          band.positions[t[2]] - band.positions[t[0]]);
    area += 0.5 * length(n);
    REQUIRE(dot(unit(n), band.positions[t[0]]) > 0.9);
    for (size_t i = 0; i < 3; ++i) REQUIRE(++uses[{t[i], t[(i + 1) % 3]}] == 1);
  }
  CHECK(area == doctest::Approx(2 * 3.14159265358979 * 1.2).epsilon(2e-3));
  size_t border = 0;
  for (const auto& [edge, count] : uses) {
    if (uses.count({edge.second, edge.first}) != 0) continue;
    ++border;
    CHECK(band.constrained[edge.first] == 1);
    CHECK(band.positions[edge.first][2] == band.positions[edge.second][2]);
  }
  CHECK(border == 210);
  for (size_t i = 0; i < band.positions.size(); ++i) {
    const Point& p = band.positions[i];
    REQUIRE(std::fabs(std::hypot(p[0], p[1]) - 1.0) < 1e-14);
    const double axial = band.constrained[i] != 0 ? std::copysign(0.5, p[2]) : 0.0;
    REQUIRE(std::fabs(band.normals[i][2] - axial) < 1e-14);
    REQUIRE(std::fabs(length(band.normals[i]) - 1.0) < 1e-14);
  }
}

namespace {

// Longitudes and latitudes of a torus as a closed grid of 2 * m * n triangles.
Mesh torus_grid(uint32_t m, uint32_t n) {
  Mesh mesh;
  const double turn = 2.0 * 3.14159265358979323846;
  for (uint32_t i = 0; i < m; ++i) {
    for (uint32_t j = 0; j < n; ++j) {
      const double u = turn * i / m, v = turn * j / n;
      const double rho = 2.0 + std::cos(v);
      mesh.positions.push_back({rho * std::cos(u), rho * std::sin(u), std::sin(v)});
      const uint32_t a = i * n + j, b = (i + 1) % m * n + j;
      const uint32_t c = (i + 1) % m * n + (j + 1) % n, d = i * n + (j + 1) % n;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

Mesh octahedron(int rounds) {
  Mesh mesh;
  mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (; rounds > 0; --rounds) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto next = static_cast<uint32_t>(mesh.positions.size());
      const auto [found, added] = middles.insert({std::minmax(a, b), next});
      if (added) mesh.positions.push_back(unit(mesh.positions[a] + mesh.positions[b]));
      return found->second;
    };
    std::vector<std::array<uint32_t, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const std::array<uint32_t, 3>& t :
           {std::array<uint32_t, 3>{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
        finer.push_back(t);
      }
    }
    mesh.triangles = finer;
  }
  return mesh;
}

Mesh square_sheet(uint32_t n) {
  Mesh mesh;
  for (uint32_t i = 0; i <= n; ++i) {
    for (uint32_t j = 0; j <= n; ++j) {
      const double x = 2.0 * i / n - 1.0, y = 2.0 * j / n - 1.0;
      mesh.positions.push_back({x, y, 0.25 * (x * x - y * y)});
      if (i == n || j == n) continue;
      const uint32_t a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return mesh;
}

void check_cut(const Network& network) {
  for (const Point& n : network.normals) REQUIRE(std::fabs(length(n) - 1.0) < 1e-14);
  CHECK(least_gap(network) > 0.0);
  std::vector<Point> sorted = network.positions;
  std::sort(sorted.begin(), sorted.end());
  CHECK(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end());
}

}  // namespace

TEST_CASE("a sphere's mesh cut in general position") {
  const Mesh mesh = octahedron(4);
  REQUIRE(mesh.triangles.size() == 8 * 256);
  const Network network =
      cut(mesh, {{{1, .01, .02}, .03}, {{.02, 1, .01}, -.04}, {{.01, -.02, 1}, .05}});
  check_cut(network);
  CHECK(network.curves.size() == 3);
  CHECK(std::all_of(network.curves.begin(), network.curves.end(),
                    [](const auto& c) { return c.closed && !c.boundary; }));
  const Trace result = trace(network);
  CHECK(result.nodes == 6);
  CHECK(result.segments == 12);
  CHECK(result.patches.size() == 8);
  CHECK(result.euler_characteristic() == 2);
  for (const Patch& patch : result.patches) CHECK(patch.robust);
  for (size_t i = 0; i < network.positions.size(); ++i) {
    REQUIRE(distance(unit(network.positions[i]), network.normals[i]) < 0.02);
  }
}

TEST_CASE("planes through vertices and along edges") {
  // The coordinate planes run along edges of the octahedron and meet in its vertices.
  for (int rounds : {1, 2, 4}) {
    const Network network =
        cut(octahedron(rounds), {{{1, 0, 0}, 0}, {{0, 1, 0}, 0}, {{0, 0, 1}, 0}});
    check_cut(network);
    const Trace result = trace(network);
    CHECK(result.nodes == 6);
    CHECK(result.patches.size() == 8);
    CHECK(result.euler_characteristic() == 2);
  }
}

TEST_CASE("random planes through a torus keep the Euler characteristic of discs consistent") {
  std::mt19937 random(3);
  const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 * 2.0 - 1.0; };
  const Mesh mesh = torus_grid(40, 20);
  for (int k = 0; k < 50; ++k) {
    std::vector<Plane> planes;
    for (int p = 0; p < 6; ++p) planes.push_back({{number(), number(), number()}, 0.5 * number()});
    const Network network = cut(mesh, planes, 0.0);
    check_cut(network);
    const Trace result = trace(network);
    // Each node has two curves crossing, so twice as many segments as nodes.
    size_t alone = 0;
    std::vector<int> uses(network.positions.size(), 0);
    for (const auto& c : network.curves) {
      REQUIRE(c.closed);
      for (uint32_t v : c.vertices) REQUIRE(++uses[v] <= 2);
    }
    for (const auto& c : network.curves) {
      alone += std::all_of(c.vertices.begin(), c.vertices.end(),
                           [&](uint32_t v) { return uses[v] == 1; });
    }
    CHECK(result.segments == 2 * (result.nodes - alone) + alone);
    // Faces that are no discs, or several components, only raise V - E + F above 0.
    CHECK(result.euler_characteristic() >= 0);
  }
}

TEST_CASE("a torus cut into discs") {
  const Network network = cut(torus_grid(48, 24), {{{1, 0, 0}, 0}, {{0, 1, 0}, 0}, {{0, 0, 1}, 0}});
  check_cut(network);
  CHECK(network.curves.size() == 6);
  const Trace result = trace(network);
  CHECK(result.nodes == 8);
  CHECK(result.patches.size() == 8);
  CHECK(result.euler_characteristic() == 0);
}

TEST_CASE("three planes that meet in one triangle") {
  // A single triangle of the mesh holds all three crossings, in general position or in one point.
  Mesh mesh;
  mesh.positions = {{-3, -2, 0}, {3, -2, 0}, {0, 4, 0}};
  mesh.triangles = {{0, 1, 2}};
  const Plane a = {{1, 0, 0}, .1};
  const Plane b = {{1, 2, 0}, .2};
  const Trace apart = trace(cut(mesh, {a, b, {{-1, 2, 0}, 1.0}}));
  CHECK(apart.euler_characteristic() == 1);
  CHECK(apart.patches.size() == 7);
  CHECK(apart.nodes == 3 + 3 + 6);
  const Trace together = trace(cut(mesh, {a, b, {{-1, 2, 0}, 0.0}}));
  CHECK(together.euler_characteristic() == 1);
  CHECK(together.patches.size() == 6);
  CHECK(together.nodes == 1 + 3 + 6);
}

TEST_CASE("an open sheet: border curves with corners and the ends of cuts") {
  for (const double offset : {0.0, 0.013}) {
    const Network network = cut(square_sheet(20), {{{1, 0, 0}, offset}, {{0, 1, 0}, -offset}});
    check_cut(network);
    CHECK(network.curves.size() == 6);
    CHECK(count_boundary(network) == 4);
    const Trace result = trace(network);
    CHECK(result.nodes == 9);
    CHECK(result.segments == 12);
    CHECK(result.patches.size() == 4);
    CHECK(result.euler_characteristic() == 1);
    for (const Patch& patch : result.patches) CHECK(patch.robust);
  }
}

TEST_CASE("meshes that are no oriented manifolds are refused") {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
  CHECK_THROWS_AS(cut(mesh, {{{1, 0, 0}, .5}}), std::runtime_error);
  mesh.triangles = {{0, 0, 2}};
  CHECK_THROWS_AS(cut(mesh, {{{1, 0, 0}, .5}}), std::runtime_error);
}

TEST_CASE("OBJ meshes with polygons, slashes and negative indices") {
  const std::string path = "networks_test_mesh.obj";
  std::ofstream(path) << "# two faces\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nvt 0 0\n"
                         "f 1/1 2/1/1 3//1 4\nf -4 -1 -3\n";
  const Mesh mesh = read_obj(path);
  std::remove(path.c_str());
  CHECK(mesh.positions.size() == 5);
  const std::vector<std::array<uint32_t, 3>> wanted = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};
  CHECK(mesh.triangles == wanted);
  for (const Point& n : vertex_normals(mesh)) CHECK(n == Point{0, 0, 1});
}

TEST_CASE("files read back to the same bits") {
  for (const Expected& e : expected_networks()) {
    for (const Network& back : {from_net(to_net(e.network)), from_obj(to_obj(e.network))}) {
      REQUIRE(back.positions == e.network.positions);
      REQUIRE(back.normals == e.network.normals);
      REQUIRE(back.curves.size() == e.network.curves.size());
      for (size_t k = 0; k < back.curves.size(); ++k) {
        CHECK(back.curves[k].vertices == e.network.curves[k].vertices);
        CHECK(back.curves[k].closed == e.network.curves[k].closed);
        CHECK(back.curves[k].boundary == e.network.curves[k].boundary);
      }
    }
  }
  CHECK_THROWS_AS(from_net("3\n1 2 3 0 0 1\n"), std::runtime_error);
}

TEST_CASE("a polygon that crosses itself in projection is seen as folded") {
  // A figure of eight on the plane, as the only curve.
  Network network;
  for (int i = 0; i < 40; ++i) {
    const double t = 2 * 3.14159265358979 * (i + .5) / 40;
    network.positions.push_back({std::sin(2 * t), 1.5 * std::sin(t), 0.1 * std::cos(t)});
    network.normals.push_back({0, 0, 1});
  }
  Network::Curve curve;
  curve.closed = true;
  for (uint32_t i = 0; i < 40; ++i) curve.vertices.push_back(i);
  network.curves.push_back(curve);
  for (const Patch& patch : trace(network).patches) CHECK_FALSE(patch.simple);
}

namespace {

void check_same(const Network& file, const Network& made) {
  REQUIRE(file.positions.size() == made.positions.size());
  REQUIRE(file.curves.size() == made.curves.size());
  for (size_t i = 0; i < made.positions.size(); ++i) {
    REQUIRE(distance(file.positions[i], made.positions[i]) < 1e-12);
    REQUIRE(distance(file.normals[i], made.normals[i]) < 1e-12);
  }
  for (size_t k = 0; k < made.curves.size(); ++k) {
    CHECK(file.curves[k].vertices == made.curves[k].vertices);
    CHECK(file.curves[k].closed == made.curves[k].closed);
    CHECK(file.curves[k].boundary == made.curves[k].boundary);
  }
}

}  // namespace

TEST_CASE("the committed files are what the generator makes") {
  for (const Shipped& shipped : shipped_closed_forms()) {
    CAPTURE(shipped.file);
    check_same(read_network(std::string(NETWORKS_DATA) + "/" + shipped.file), shipped.network);
  }
  const std::string mesh = std::string(WIRESKIN_TEST_DATA) + "/common-meshes/spot.obj";
  if (std::ifstream(mesh)) {
    check_same(read_network(NETWORKS_DATA "/spot.net"), shipped_spot(read_obj(mesh)).network);
  } else {
    MESSAGE("spot.net is not compared: no common-meshes/spot.obj in WIRESKIN_TEST_DATA");
  }
}

TEST_CASE("every patch of the committed networks can be projected") {
  const std::map<std::string, long> euler = {{"sphere.net", 2},   {"torus.net", 0},
                                             {"saddle.obj", 1},   {"bumpy.net", 2},
                                             {"cylinder.net", 0}, {"spot.net", 2}};
  for (const auto& entry : euler) {
    const std::string& file = entry.first;
    CAPTURE(file);
    const Trace result = trace(read_network(std::string(NETWORKS_DATA) + "/" + file));
    CHECK(result.components == 1);
    CHECK(result.euler_characteristic() == entry.second);
    for (const Patch& patch : result.patches) {
      CHECK(patch.robust);
      CHECK(patch.mean_normal > 0.4);
    }
  }
}
