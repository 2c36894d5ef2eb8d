#include "network/snap_order.h"

#include <doctest/doctest.h>

#include "network/snap_walk.h"
#include "support/strung_beads.h"

using namespace wireskin;
using namespace wireskin::network;
using namespace unit;

namespace {

struct Planned : StrungBeads {
  SnapPlan snaps{heap.context};

  // The passes of the approaches in the order of their edges.
  void plan(double tolerance, bool complete = false) {
    string(0);
    Array<Approach> approaches(heap.context);
    Array<uint32_t> walk(heap.context);
    must(find_approaches(wires, beads.curve.span(), tolerance, &approaches));
    must(count_walks(wires, tolerance, &walk));
    must(plan_snaps(beads, tolerance, complete, approaches.span(), walk.span(), &snaps));
  }
  uint32_t count(SnapPass pass) const {
    uint32_t found = 0;
    for (const SnapPass p : snaps.pass) found += p == pass;
    return found;
  }
};

}  // namespace

static const Vec3 k_up = {0, 0, 1};

// A grid of curves in a plane that cross exactly, with a stub that ends on one of them.
static void add_grid(Planned* net) {
  for (const double at : {1.0, 2.0, 3.0}) {
    net->add(line({at, 0.5, 0}, {at, 3.5, 0}, 12), false, std::vector<Vec3>(13, k_up));
    net->add(line({0.55, at, 0}, {3.5, at, 0}, 12), false, std::vector<Vec3>(13, k_up));
  }
  net->add(line({1.4, 1.001, 0}, {1.5, 1.45, 0}, 2), false, std::vector<Vec3>(3, k_up));
}

TEST_CASE("curves that cross exactly are exact: ends are settled before crossings") {
  Planned net;
  add_grid(&net);
  net.plan(0.05);
  CHECK(net.snaps.exact);
  CHECK(net.count(SnapPass::settled) == 1);
  CHECK(net.count(SnapPass::crosses) >= 9);
  CHECK(net.count(SnapPass::beside) == 0);
}

TEST_CASE("a curve that runs beside another in the surface comes last, one above it does not") {
  for (const bool above : {false, true}) {
    Planned net;
    add_grid(&net);
    const Vec3 off = above ? Vec3{0, 0, 0.03} : Vec3{0, 0.03, 0};
    net.add({Vec3{2.2, 3, 0} + off, Vec3{2.8, 3, 0} + off}, false, {k_up, k_up});
    net.plan(0.05);
    CHECK(net.snaps.exact);
    CHECK((net.count(SnapPass::beside) > 0) == !above);
  }
}

TEST_CASE("sketched curves, and complete networks, have one pass") {
  Planned sketched;
  sketched.add(line({-1, 0, 0}, {1, 0, 0}, 10));
  sketched.add(line({0, -1, 0.04}, {0, 1, 0.04}, 10));
  sketched.plan(0.05);
  CHECK(!sketched.snaps.exact);
  CHECK(sketched.count(SnapPass::crosses) == sketched.snaps.pass.size());
  REQUIRE(sketched.snaps.pass.size() == 1);

  Planned complete;
  add_grid(&complete);
  complete.plan(0.05, true);
  CHECK(!complete.snaps.exact);
  CHECK(complete.count(SnapPass::crosses) == complete.snaps.pass.size());
}

TEST_CASE("curves run along each other either way") {
  CHECK(run_along({1, 0, 0}, wireskin::unit(Vec3{-1, 0.1, 0})));
  CHECK(!run_along({1, 0, 0}, wireskin::unit(Vec3{1, 0.3, 0})));
}
