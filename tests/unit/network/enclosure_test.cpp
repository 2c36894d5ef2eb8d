#include "network/enclosure.h"

#include <doctest/doctest.h>

#include "support/curve_nets.h"

using namespace unit;
using namespace wireskin::network;

namespace {

// A disc of radius 4 with another circle, `boundary` or not, somewhere.
Stages meshed(Vec3 centre, double radius) {
  CurveNet net;
  net.add_circle({}, 4, true);
  net.add_circle(centre, radius, true);
  return Stages(net);
}

Status status_of(Vec3 centre, double radius) {
  Stages s(meshed(centre, radius));
  s.mesh_patches(0.5);
  return s.status;
}

}  // namespace

TEST_CASE("enclosure: a curve inside a patch is named") {
  const Status s = status_of({0.5, 0.5, 0}, 1);
  CHECK(s.code == Code::patch_several_loops);
  CHECK(s.place.curve == 1);
  CHECK(s.place.patch == 0);
  CHECK(status_of({3.4, 0, 0}, 0.3).code == Code::patch_several_loops);
  CHECK(status_of({0, 0, 0.35}, 1).code == Code::patch_several_loops);  // a little above
}

TEST_CASE("enclosure: curves beside, far above and across are not inside") {
  CHECK(status_of({9, 0, 0}, 1).ok());
  CHECK(status_of({0, 0, 1}, 1).ok());
  CHECK(status_of({0, 0, -3}, 2).ok());
  CHECK(status_of({4, 0, 0}, 1).ok());  // crosses the border without a node, which is no hole
}

TEST_CASE("enclosure: the other patches of the own component do not count") {
  Stages s(octant_net());
  CHECK(s.mesh_patches(0.3));
  Stages saddle(saddle_net());
  CHECK(saddle.mesh_patches(0.3));
}

TEST_CASE("enclosure: a point in a component of many segments") {
  CurveNet net;
  net.add_circle({}, 4, true);
  net.add_circle({}, 1, false);
  net.add_line({1, 0, 0}, {-1, 0, 0}, {0, 0, 1});  // joined to the inner circle only
  Stages s(net);
  s.mesh_patches(0.3);
  CHECK(s.status.code == Code::patch_several_loops);
}
