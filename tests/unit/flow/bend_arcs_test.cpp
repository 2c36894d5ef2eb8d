// Bent arcs: circles of few samples become round, straight lines and corners stay what they are.
#include "flow/bend_arcs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "flow/networks.h"
#include "flow/unseen.h"

using namespace flow_tests;
using namespace wireskin::flow;

namespace {

struct Bent {
  unit::Heap heap;
  Arcs before{heap.context}, after{heap.context};

  Bent(const Net& net, double step) {
    const NetArrays arrays(net);
    unit::must(find_arcs(heap.context, arrays.view(), &before));
    unit::must(find_arcs(heap.context, arrays.view(), &after));
    unit::must(bend_arcs(heap.context, step, &after));
  }
};

// The same arcs, the old vertices in the same order among new ones, lengths measured anew.
void check_paths(const Bent& b) {
  REQUIRE(b.after.size() == b.before.size());
  REQUIRE(b.after.is_node.size() == b.after.vertex.size());
  for (uint32_t v = 0; v < b.before.vertex.size(); ++v) {
    CHECK(b.after.vertex[v] == b.before.vertex[v]);
  }
  for (uint32_t a = 0; a < b.before.size(); ++a) {
    std::vector<uint32_t> old, kept, curves, kept_curves;
    for (uint32_t i = b.before.start[a]; i < b.before.start[a + 1]; ++i) {
      old.push_back(b.before.path[i]);
      curves.push_back(b.before.curve[i]);
    }
    double along = 0.0;
    for (uint32_t i = b.after.start[a]; i < b.after.start[a + 1]; ++i) {
      const uint32_t v = b.after.path[i];
      if (i > b.after.start[a]) {
        along += length(b.after.vertex[v] - b.after.vertex[b.after.path[i - 1]]);
        CHECK(b.after.along[i] > b.after.along[i - 1]);
      }
      CHECK(b.after.along[i] == doctest::Approx(along).epsilon(1e-12));
      if (v >= b.after.given) continue;
      kept.push_back(v);
      kept_curves.push_back(b.after.curve[i]);
    }
    CHECK(kept == old);
    CHECK(kept_curves == curves);
  }
}

}  // namespace

TEST_CASE("Circles of few samples become round, to the fourth power of their angle") {
  for (const int pieces : {12, 16, 24, 48}) {
    CAPTURE(pieces);
    Net net;
    add_circle(net, {}, {1, 0, 0}, {0, 1, 0}, pieces, {});
    const Bent b(net, 0.1);
    check_paths(b);
    CHECK(b.after.vertex.size() > b.before.vertex.size());
    const double angle = 2 * k_pi / pieces;
    for (const Vec3& p : b.after.vertex) {
      CHECK(std::fabs(length(p) - 1.0) < 0.01 * std::pow(angle, 4));
    }
  }
}

TEST_CASE("Great circles stay round through their junctions, also backward and in disorder") {
  Net net = great_circles();
  for (auto& curve : net.curve) std::reverse(curve.begin(), curve.end());
  const Bent b(net, 0.02);
  check_paths(b);
  for (const Vec3& p : b.after.vertex) CHECK(std::fabs(length(p) - 1.0) < 1e-4);
}

TEST_CASE("Straight lines and polygons are left alone, bit for bit") {
  for (const Net& net : {lattice(1, 1, 2), octahedron(), pyramid(5, 1.0)}) {
    const Bent b(net, 0.001);
    CHECK(b.after.vertex.size() == b.before.vertex.size());
    check_paths(b);
  }
  Net dense;  // samples nearer than a quarter of the step need nothing
  add_circle(dense, {}, {1, 0, 0}, {0, 1, 0}, 64, {});
  CHECK(Bent(dense, 0.5).after.vertex.size() == 64);
}

TEST_CASE("A long segment beside a short one hardly bends") {
  Net net;
  std::vector<uint32_t> curve;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{10, 0, 0}, Vec3{10.09, 0.04, 0}, Vec3{10.16, 0.1, 0}}) {
    curve.push_back(net.add(p));
  }
  net.curve.push_back(curve);
  const Bent b(net, 0.1);
  check_paths(b);
  for (const Vec3& p : b.after.vertex) {
    if (p.x < 10.0) CHECK(std::fabs(p.y) < 0.03);
  }
}
