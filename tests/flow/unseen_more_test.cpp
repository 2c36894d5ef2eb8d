// The second family of networks made here, in turns, orders, draws of the jitter and twice as fine.
#include <doctest/doctest.h>

#include "flow/run.h"
#include "flow/unseen_more.h"

using namespace flow_tests;

namespace {

bool as_wished(const Expected& wish, const Run& r) {
  return std::equal(r.betti, r.betti + 3, wish.betti) && r.patches == wish.patches &&
         r.annuli == wish.annuli && r.bare == 0 && r.open == 0 && r.missing == 0 &&
         r.crossings == 0 && r.euler == 1;
}

Run plain_run(const Net& net, double eps = 0.02, uint64_t seed = 0) {
  return run(net, {eps, seed, -1, false, false});
}

}  // namespace

static void check_family(const std::vector<Expected>& family) {
  for (const Expected& wish : family) {
    const std::string name = wish.name;
    CAPTURE(name);
    for (int turn = 0; turn <= 3; ++turn) {
      CAPTURE(turn);
      const Run r = plain_run(turned(wish.net, turn));
      CHECK(as_wished(wish, r));
      if (turn != 1) continue;
      const Betti own = {r.betti[0], r.betti[1], r.betti[2]};
      CHECK((betti_of(r, r.raw_triangle) == own));
    }
    CHECK(as_wished(wish, plain_run(reordered(wish.net, 4))));
    CHECK(as_wished(wish, plain_run(wish.net, 0.02, 11)));
    CHECK(as_wished(wish, plain_run(wish.net, 0.01)));
  }
}

TEST_CASE("Wireframes, solids and cages become what a person sees") {
  check_family(more_unseen_networks());
}

TEST_CASE("Notches, holes, handles and plates become what a person sees") {
  check_family(notched_networks());
}

// The same shape with eight corners and with so many that it is round: a greater end that is round
// is as good as a rim.
TEST_CASE("Polygons close towards the outside, round ends do not") {
  CHECK(plain_run(tower(8, {{1, 0}, {0.5, 1.5}})).betti[2] == 1);
  CHECK(plain_run(tower(32, {{1, 0}, {0.5, 1.5}})).betti[2] == 0);
}

// Squares in one plane, and two sheets hinged on a line: nothing is enclosed.
TEST_CASE("Flat grids and folded sheets enclose nothing") {
  Net grid = lattice(3, 3, 0);
  const Run flat = plain_run(grid);
  CHECK(flat.patches == 9);
  CHECK(flat.betti[2] == 0);
  for (Vec3& p : grid.vertex) {
    if (p.x > 1.5) p = {1.5 + 0.3 * (p.x - 1.5), p.y, p.x - 1.5};
  }
  const Run folded = plain_run(turned(grid, 1));
  CHECK(folded.patches == 9);
  CHECK(folded.betti[2] == 0);
}
