#include "network/network.h"

#include <doctest/doctest.h>

#include <set>

#include "support/curve_nets.h"

using namespace unit;
using namespace wireskin::network;

namespace {

// Checks what holds of every network: patches are closed chains of half-segments, each at most
// once, and inner segments have a patch on both sides, boundary ones on one.
void check_cycles(const Stages& s) {
  std::vector<int> used(2 * s.network.segment.size(), 0);
  const auto tail = [&](uint32_t h) {
    return h % 2 ? s.network.segment[h / 2].to : s.network.segment[h / 2].from;
  };
  for (uint32_t p = 0; p < s.network.patches(); ++p) {
    const Span<const uint32_t> cycle = s.network.cycle(p);
    REQUIRE(cycle.size() > 0);
    for (size_t i = 0; i < cycle.size(); ++i) {
      ++used[cycle[i]];
      CHECK(tail(opposite(cycle[i])) == tail(cycle[(i + 1) % cycle.size()]));
    }
  }
  for (size_t k = 0; k < s.network.segment.size(); ++k) {
    CHECK(used[2 * k] <= 1);
    CHECK(used[2 * k + 1] <= 1);
    CHECK(used[2 * k] + used[2 * k + 1] == (s.network.segment[k].boundary ? 1 : 2));
  }
}

std::multiset<size_t> patch_sizes(const Stages& s) {
  std::multiset<size_t> sizes;
  for (uint32_t p = 0; p < s.network.patches(); ++p) sizes.insert(s.network.cycle(p).size());
  return sizes;
}

using Sizes = std::multiset<size_t>;

Sizes times(size_t count, size_t size) {
  Sizes sizes;
  while (count-- > 0) sizes.insert(size);
  return sizes;
}

void check_net(const CurveNet& net, size_t nodes, size_t segments, const Sizes& sizes) {
  const Stages s(net);
  REQUIRE_MESSAGE(s.status.ok(), s.status.sentence);
  CHECK(s.nodes.size() == nodes);
  CHECK(s.network.segment.size() == segments);
  CHECK(patch_sizes(s) == sizes);
  check_cycles(s);
}

}  // namespace

TEST_CASE("network: closed surfaces") {
  check_net(octant_net(), 6, 12, times(8, 3));
  check_net(torus_net(4, 4), 16, 32, times(16, 4));
  check_net(torus_net(2, 2), 4, 8, times(4, 4));
  // Along a single parallel every patch has it on both sides: bands, and it lies inside them.
  const Stages s(torus_net(2, 1));
  REQUIRE(s.status.ok());
  CHECK(s.network.patches() == 2);
  CHECK(s.network.loop.count() == 4);
  CHECK(s.network.inner[0].size() == 1);
  // One meridian and one parallel: a patch with a handle.
  CHECK(Stages(torus_net(1, 1)).status.code == Code::patch_several_loops);
}

TEST_CASE("network: surfaces with border drop what lies outside") {
  check_net(cylinder_net(4), 8, 12, times(4, 4));
  check_net(saddle_net(), 9, 12, times(4, 4));
}

TEST_CASE("network: nothing yet is no patch") {
  Heap heap;
  CHECK(Network(heap.context).patches() == 0);
}

TEST_CASE("network: closed curves without node") {
  CurveNet disc;
  disc.add_circle({}, 1, true);
  check_net(disc, 0, 1, {1});
  Stages s(disc);
  CHECK(s.network.cycle(0)[0] == 0);  // counter-clockwise is inside
  // The same circle the other way round: the other side is inside.
  CurveNet turned = disc;
  std::reverse(turned.curves[0].position.begin(), turned.curves[0].position.end());
  Stages t(turned);
  REQUIRE(t.network.patches() == 1);
  CHECK(t.network.cycle(0)[0] == 1);
  disc.curves[0].boundary = false;
  check_net(disc, 0, 1, {1, 1});
}

TEST_CASE("network: two boundary curves touch in a node") {
  // An eight in the plane: the two lobes are patches, the outside is none.
  CurveNet eight;
  eight.add_circle({-1, 0, 0}, 1, true, 48, 0.0);
  eight.add_circle({1, 0, 0}, 1, true, 48, k_pi);
  check_net(eight, 1, 2, {1, 1});
}

TEST_CASE("network: curves that touch at a node are told apart by their secants") {
  CurveNet net;
  net.add_circle({0, 2, 0}, 2, true, 64, -0.5 * k_pi);
  net.add_circle({0, 1, 0}, 1, false, 64, -0.5 * k_pi);
  check_net(net, 1, 2, {1, 2});
}

TEST_CASE("network: a node of valence 100") {
  CurveNet net;
  net.add_circle({}, 1, true, 300);
  for (int k = 0; k < 100; ++k) {
    const double a = 2 * k_pi * k / 100;
    net.add_line({}, {std::cos(a), std::sin(a), 0}, {0, 0, 1});
  }
  check_net(net, 101, 200, times(100, 3));
}

TEST_CASE("network: the order round a node follows its normal") {
  // Seen from below everything is mirrored: the same patches, run through the other way.
  CurveNet net = saddle_net();
  for (NetCurve& c : net.curves) {
    for (Vec3& n : c.normal) n = -n;
  }
  check_net(net, 9, 12, times(4, 4));
  const Stages up(saddle_net()), down(net);
  CHECK(up.network.cycle(0)[0] != down.network.cycle(0)[0]);
}

TEST_CASE("network: a border that is not tagged becomes a patch of its own") {
  check_net(cylinder_net(4, false), 8, 12, {4, 4, 4, 4, 4, 4});
  check_net(saddle_net(false), 9, 12, {4, 4, 4, 4, 8});
}

TEST_CASE("network: an inner curve tagged as boundary is named") {
  CurveNet net = saddle_net();
  net.curves[5].boundary = true;
  const Stages s(net);
  CHECK(s.status.code == Code::open_network);
  CHECK(s.status.place.curve == 5);
}

// Each side of it is named as a patch that fails, so neither may stand for the other.
TEST_CASE("network: a border given three times is no ring") {
  CurveNet net;
  for (int k = 0; k < 3; ++k) net.add_circle({0, 0, 0}, 1.0, true, 6);
  Stages s(net);
  CHECK(s.status.code == Code::inconsistent_normals);
  Network n(s.heap.context);
  Array<Status> faults(s.heap.context);
  must(find_patches(s.curves, view(s.boundary), s.nodes.span(), &n, &faults));
  for (const Status& fault : faults) CHECK(!fault.ok());
  REQUIRE(n.patches() >= 2);
  for (uint32_t p = 0; p < n.patches(); ++p) CHECK(n.ring[p] == 0);
}

TEST_CASE("network: dangling ends are named") {
  CurveNet net = saddle_net();
  net.add_line({0, 0, 0}, {0.3, 0.4, 0}, {0, 0, 1});
  Stages s(net);
  CHECK(s.status.code == Code::open_network);
  CHECK(s.status.place.curve == 6);
  CHECK(s.status.place.sample == 12);
  std::reverse(net.curves[6].position.begin(), net.curves[6].position.end());
  CHECK(Stages(net).status.place.sample == 0);
}

TEST_CASE("network: a curve passed on both sides lies inside its patch") {
  // A ring on a string inside a disc.
  CurveNet net;
  net.add_circle({}, 4, true);
  net.add_circle({}, 1, false);
  net.add_line({1, 0, 0}, {4, 0, 0}, {0, 0, 1});
  const Stages s(net);
  REQUIRE(s.status.ok());
  REQUIRE(s.network.patches() == 2);
  const uint32_t annulus = s.network.inner[0].empty() ? 1 : 0;
  CHECK(s.network.patch_start[annulus + 1] - s.network.patch_start[annulus] == 2);
  REQUIRE(s.network.inner[annulus].size() == 1);
  CHECK(s.network.segment[s.network.inner[annulus][0]].curve == 2);
  CHECK(s.network.inner[1 - annulus].empty());
}

TEST_CASE("network: a normal along a curve is named") {
  CurveNet net = saddle_net();
  for (size_t i = 9; i <= 11; ++i) net.curves[4].normal[i] = {1, 0, 0};
  for (size_t i = 9; i <= 11; ++i) net.curves[5].normal[i] = {1, 0, 0};
  const Stages s(net);
  CHECK(s.status.code == Code::tangent_normal);
  CHECK(s.status.place.curve == 4);
  CHECK(s.status.place.sample == 10);
  CHECK(s.status.place.node != k_none);
}

TEST_CASE("network: curves that leave a node in the same direction have no order") {
  CurveNet net;
  for (double height : {1.0, 0.0}) {  // seen from above they cover each other
    net.add(40, false, true, [=](double t) {
      const double x = 2 * t - 1;
      return std::make_pair(Vec3{x, 0, height * (1 - x * x)}, Vec3{0, 0, 1});
    });
  }
  const Stages s(net);
  CHECK(s.status.code == Code::inconsistent_normals);
  CHECK(s.status.place.node != k_none);
}

TEST_CASE("network: a small loop at a node and samples merged into one") {
  // Never a hang or a not-a-number, whatever becomes of it.
  CurveNet net = saddle_net();
  NetCurve& c = net.curves[4];
  c.position.insert(c.position.begin() + 11,
                    {c.position[10] + Vec3{1e-3, 1e-3, 0}, c.position[10]});
  c.normal.insert(c.normal.begin() + 11, {c.normal[10], c.normal[10]});
  Stages s(net);
  for (double t : s.curves.knot) CHECK(t == t);
  for (const Vec3& m : s.curves.position_moment) CHECK(wireskin::length(m) < 1e300);
  s.mesh_patches(0.1);
  CHECK(!s.status.ok());
}
