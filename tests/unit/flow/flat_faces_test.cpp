#include "flow/flat_faces.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "flow/robustness.h"
#include "unit/flow/faces.h"

using namespace unit;
using flow_tests::Net;
using wireskin::flow::FlatFaces;
using wireskin::flow::StraightLines;

namespace {

// The faces, each with the area of its projection: layers of flat tetrahedra count once.
struct Faces : FacesOf {
  using FacesOf::FacesOf;
  // What a face's border encloses, by the arcs round it.
  double area(uint32_t f) const {
    const auto& samples = flow.samples;
    double twice = 0.0;
    for (uint32_t i = faces.rim_start[f]; i < faces.rim_start[f + 1]; ++i) {
      const uint32_t a = faces.rim[i].arc;
      for (uint32_t k = samples.start[a]; k + 1 < samples.start[a + 1]; ++k) {
        const Vec3 p = samples.position[samples.at[k]], q = samples.position[samples.at[k + 1]];
        const Vec3 across = cross(p, q) - cross(samples.position[0], q - p);
        const bool left = dot(cross(faces.normal[f], q - p), faces.rim[i].into) > 0.0;
        twice += (left ? 1.0 : -1.0) * dot(across, faces.normal[f]);
      }
    }
    return 8.0 * twice;  // in the units of the net
  }
  double whole_area() const {
    double sum = 0.0;
    for (uint32_t f = 0; f < faces.size(); ++f) sum += area(f);
    return sum;
  }
  std::vector<uint32_t> rim_counts() const {
    std::vector<uint32_t> counts;
    for (uint32_t f = 0; f < faces.size(); ++f) {
      counts.push_back(faces.rim_start[f + 1] - faces.rim_start[f]);
    }
    std::sort(counts.begin(), counts.end());
    return counts;
  }
};

}  // namespace

TEST_CASE("the faces of a cube are polygons of four arcs") {
  const Faces cube(prism({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 2.0));
  CHECK((cube.rim_counts() == std::vector<uint32_t>(6, 4)));
  CHECK(cube.whole_area() == doctest::Approx(24.0).epsilon(1e-6));
}

TEST_CASE("edges that are not quite straight bound faces as well") {
  for (uint32_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    const Faces faces(flow_tests::noisy(flow_tests::pyramid(5, 2.0), 1e-4, seed));
    CHECK((faces.rim_counts() == std::vector<uint32_t>{3, 3, 3, 3, 3, 5}));
  }
}

TEST_CASE("with noise a corner may be farther off the plane of a face") {
  Net cube = prism({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 2.0);
  for (uint32_t v = 0; v < 8; ++v) cube.vertex[v] += Vec3{0, 0, (v * 5 % 8) % 3 * 0.03};
  CHECK(Faces(cube).faces.size() < 6);
  CHECK(Faces(cube, 0.25 * 0.02).faces.size() == 6);
}

TEST_CASE("faces need not be convex, nor those of the hull end at it") {
  const Faces l(l_prism(0.5, 0.5));
  CHECK((l.rim_counts() == std::vector<uint32_t>{4, 4, 4, 4, 4, 4, 6, 6}));
  CHECK(l.whole_area() == doctest::Approx(2 * 1.75 + 8 * 0.5).epsilon(1e-6));
}

TEST_CASE("a face may have a hole in it, which is a face of its own") {
  Net net = prism({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}}, 1.0);
  const uint32_t n = uint32_t(net.vertex.size());
  for (const Vec3& p : {Vec3{1, 1, 1}, Vec3{2, 1, 1}, Vec3{2, 2, 1}, Vec3{1, 2, 1}}) net.add(p);
  for (uint32_t i = 0; i < 4; ++i) net.edge(n + i, n + (i + 1) % 4);
  const Faces faces(net);
  CHECK((faces.rim_counts() == std::vector<uint32_t>{4, 4, 4, 4, 4, 4, 8}));
  CHECK(faces.whole_area() == doctest::Approx(30.0).epsilon(1e-6));
}

TEST_CASE("a corner out of its planes leaves the faces that do not have it") {
  Net lifted = prism({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 2.0);
  lifted.vertex[6] = {2.4, 2.4, 2.4};
  const Faces faces(lifted);
  CHECK(faces.faces.size() == 3);
  CHECK(faces.whole_area() == doctest::Approx(12.0).epsilon(1e-6));
}

TEST_CASE("a cross section that curves close is a face, too, until more is known") {
  Net net = prism({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 1.0);
  const uint32_t top = net.add({0.5, 0.5, 1.7});
  for (uint32_t i = 4; i < 8; ++i) net.edge(i, top);
  CHECK(Faces(net).faces.size() == 10);
}

TEST_CASE("round caps of a cylinder are discs, its side is no plane") {
  Net net;
  const uint32_t n = 48;
  for (uint32_t i = 0; i < 2 * n; ++i) {
    const double angle = 6.283185307179586 * (i % n) / n;
    net.add({std::cos(angle), std::sin(angle), i < n ? 0.0 : 1.0});
  }
  for (uint32_t k = 0; k < 8; ++k) {
    std::vector<uint32_t> quarter;
    for (uint32_t i = 0; i <= n / 4; ++i) quarter.push_back(k / 4 * n + (k * n / 4 + i) % n);
    net.curve.push_back(quarter);
    if (k < 4) net.edge(k * n / 4, n + k * n / 4);
  }
  const Faces cylinder(net);
  REQUIRE(cylinder.faces.size() == 2);
  CHECK(cylinder.faces.polygon[0] + cylinder.faces.polygon[1] == 0);
  CHECK(cylinder.whole_area() == doctest::Approx(6.283185307179586).epsilon(0.01));
}

TEST_CASE("what another curve goes through is no face") {
  Net net;
  for (int ring = 0; ring < 2; ++ring) {
    std::vector<uint32_t> circle;
    for (int i = 0; i < 48; ++i) {
      const double x = std::cos(6.283185307179586 * i / 48),
                   y = std::sin(6.283185307179586 * i / 48);
      circle.push_back(net.add(ring == 0 ? Vec3{x, y, 0} : Vec3{1 + x, 0, y}));
    }
    circle.push_back(circle.front());
    net.curve.push_back(circle);
  }
  CHECK(Faces(net).faces.size() == 0);
  for (uint32_t i = 48; i < 96; ++i) net.vertex[i].x += 3.0;
  CHECK(Faces(net).faces.size() == 2);
}

namespace {

// Straight lines to and fro in a plane, and a point off it.
Net hatch(uint32_t lines) {
  Net net;
  for (uint32_t i = 0; i < 2 * lines; ++i) {
    const double at = double(i / 2) / (lines - 1);
    const double near = i % 2 == 0 ? 0.0 : 1.0;
    net.add(i / 2 % 2 == 0 ? Vec3{near, at, 0} : Vec3{at, near, 0});
    if (i % 2 == 1) net.edge(i - 1, i);
  }
  net.edge(0, net.add({0, 0, 1}));
  return net;
}

}  // namespace

TEST_CASE(
    "faces as dense as a bound on the work forbids are given up, and what is looked at may "
    "be stopped all the while") {
  FlowOf drawn(hatch(40));
  StraightLines lines(drawn.heap.context);
  const wireskin::flow::Drawing drawing = {drawn.flow.complex, drawn.flow.samples,
                                           drawn.flow.curves, lines};
  const auto find = [&](size_t most) {
    FlatFaces faces(drawn.heap.context);
    must(find_flat_faces(drawn.heap.context, drawing, 0.0, &faces, most));
    CHECK((!faces.given_up || faces.size() == 0));
    return faces.given_up;
  };
  must(find_straight_lines(drawn.flow.complex, drawn.flow.samples, &lines));
  const size_t before = drawn.heap.checkpoints;
  CHECK_FALSE(find(SIZE_MAX));
  const size_t whole = drawn.heap.checkpoints - before;
  CHECK(whole > 8);
  CHECK(find(1000));
}
