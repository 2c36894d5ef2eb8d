#include "network/enclosure.h"

#include <doctest/doctest.h>

#include "support/curve_nets.h"

using namespace unit;
using namespace wireskin::network;

namespace {

// A disc of radius 4 with another circle, tagged or not, somewhere; the patch that encloses the
// latter.
uint32_t encloses(Vec3 centre, double radius) {
  CurveNet net;
  net.add_circle({}, 4, true);
  net.add_circle(centre, radius, true);
  Stages s(net);
  REQUIRE(s.resample(0.5));
  Components components(s.heap.context);
  Array<Enclosing> enclosing(s.heap.context);
  must(find_components(s.network, s.vertices, &components));
  must(find_enclosing(s.network, s.vertices, components, &enclosing));
  REQUIRE(enclosing.size() == 2);
  return enclosing[1].patch;
}

}  // namespace

TEST_CASE("enclosure: a curve inside a patch is found") {
  CHECK(encloses({0.5, 0.5, 0}, 1) == 0);
  CHECK(encloses({3.4, 0, 0}, 0.3) == 0);
  CHECK(encloses({0, 0, 0.35}, 1) == 0);  // a little above
}

TEST_CASE("enclosure: curves beside, far above and across are not inside") {
  CHECK(encloses({9, 0, 0}, 1) == k_none);
  CHECK(encloses({0, 0, 1}, 1) == k_none);
  CHECK(encloses({0, 0, -3}, 2) == k_none);
  CHECK(encloses({4, 0, 0}, 1) == k_none);  // crosses the border without a node, which is no hole
}

TEST_CASE("enclosure: of nested patches the innermost") {
  CurveNet net;
  for (double radius : {1.0, 4.0, 2.0, 3.0}) net.add_circle({}, radius, false);
  Stages s(net);
  REQUIRE(s.resample(0.5));
  Components components(s.heap.context);
  Array<Enclosing> enclosing(s.heap.context);
  must(find_components(s.network, s.vertices, &components));
  must(find_enclosing(s.network, s.vertices, components, &enclosing));
  const auto curve_of = [&](uint32_t component) {
    const uint32_t patch = enclosing[component].patch;
    return patch == k_none ? k_none : s.network.segment[s.network.cycle(patch)[0] / 2].curve;
  };
  CHECK(curve_of(0) == 2);
  CHECK(curve_of(1) == k_none);
  CHECK(curve_of(2) == 3);
  CHECK(curve_of(3) == 1);
}

TEST_CASE("enclosure: the other patches of the own component do not count") {
  Stages s(octant_net());
  CHECK(s.mesh_patches(0.3));
  Stages saddle(saddle_net());
  CHECK(saddle.mesh_patches(0.3));
}
