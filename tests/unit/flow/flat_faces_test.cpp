#include "flow/flat_faces.h"

#include <doctest/doctest.h>

#include <cmath>

#include "unit/flow/prisms.h"

using namespace unit;
using flow_tests::Net;
using wireskin::flow::Flatness;
using wireskin::flow::Persistence;
using wireskin::flow::Sheet;

namespace {

// The walls of all rooms, and the area of those in flat faces.
struct Faces : FlowOf {
  Array<Flatness> flatness{heap.context};

  explicit Faces(const Net& net) : FlowOf(net) {
    Persistence rooms(heap.context);
    must(find_persistence(heap.context, flow.complex, &rooms));
    Sheet walls(heap.context);
    must(start_sheet(flow.complex, &walls));
    for (uint32_t t = 0; t < flow.complex.triangle_count(); ++t) {
      const bool closes = rooms.void_of[t] != k_none;
      if (closes || rooms.creator[t] == 0) add_to_sheet(flow.complex, t, &walls);
    }
    peel(flow.complex, flow.curves, wireskin::flow::Protect::curves, &walls);
    must(find_flat_faces(heap.context, flow.complex, flow.samples, flow.curves, walls, &flatness));
  }
  double area(Flatness which) const {
    double sum = 0.0;
    for (uint32_t t = 0; t < flatness.size(); ++t) sum += flatness[t] == which ? area_of(t) : 0.0;
    return sum;
  }
};

}  // namespace

TEST_CASE("the faces of a cube are polygons, each covered once") {
  const Faces cube(prism({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 2.0));
  CHECK(cube.area(Flatness::polygon) == doctest::Approx(24.0).epsilon(1e-4));
  CHECK(cube.area(Flatness::plane) == 0.0);
}

TEST_CASE("faces need not be convex") {
  const Faces l(l_prism(0.5, 0.5));
  CHECK(l.area(Flatness::polygon) == doctest::Approx(2 * 1.75 + 8 * 0.5).epsilon(1e-4));
}

TEST_CASE("a corner out of its planes leaves the faces that do not have it") {
  Net lifted = prism({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 2.0);
  lifted.vertex[6] = {2.4, 2.4, 2.4};
  const Faces faces(lifted);
  CHECK(faces.area(Flatness::polygon) == doctest::Approx(12.0).epsilon(1e-4));
  CHECK(faces.area(Flatness::plane) == 0.0);
}

TEST_CASE("caps of a cylinder are flat but no polygons, its side is neither") {
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
  CHECK(cylinder.area(Flatness::plane) == doctest::Approx(6.283185307179586).epsilon(0.01));
  CHECK(cylinder.area(Flatness::polygon) == 0.0);
}
