// Round ends: closed where asked for, the only one of a network by itself, and never those that are
// sections of a body or lie in its holes.
#include "flow/round.h"

#include <doctest/doctest.h>

#include "flow/run.h"

using namespace flow_tests;
using wireskin::flow::Lids;

namespace {

Run run_with(const Net& net, Lids lids, double eps = 0.02, uint64_t seed = 0) {
  RunOptions options = {eps, seed, -1, false, false};
  options.lids = lids;
  return run(net, options);
}

void check_whole(const Expected& wish, const Run& r) {
  for (int k = 0; k < 3; ++k) CHECK(r.betti[k] == wish.betti[k]);
  CHECK(r.patches == wish.patches);
  CHECK(r.annuli == wish.annuli);
  CHECK(r.bare == 0);
  CHECK(r.open == 0);
  CHECK(r.open_lids == 0);
  CHECK(r.crossings == 0);
  CHECK(r.euler == 1);
  const Betti own = {r.betti[0], r.betti[1], r.betti[2]};
  CHECK((betti_of(r, r.raw_triangle) == own));
}

void check_turned(const Expected& wish, Lids lids) {
  const std::string name = wish.name;
  CAPTURE(name);
  for (int turn = 0; turn <= 2; ++turn) {
    CAPTURE(turn);
    check_whole(wish, run_with(turned(wish.net, turn), lids));
  }
  check_whole(wish, run_with(reordered(wish.net, 5), lids, 0.02, 7));
  check_whole(wish, run_with(wish.net, lids, 0.013));
}

}  // namespace

TEST_CASE("Cans, frusta, steps and vases are closed where lids are asked for") {
  for (const Expected& wish : round_networks()) check_turned(wish, Lids::all);
}

TEST_CASE("Cones, domes and knobs have one round end, which is closed by itself") {
  for (const Expected& wish : capped_networks()) check_turned(wish, Lids::single);
}

TEST_CASE("A tube is open at one end unless lids are asked for, and that is told") {
  const Net can = stack({{1, 0}, {1, 2}}, 4);
  const Run left = run_with(can, Lids::single);
  CHECK(left.betti[2] == 0);
  CHECK(left.patches == 5);
  CHECK(left.open_lids == 1);
  const Run none = run_with(dome(6, 1.0), Lids::none);
  CHECK(none.betti[2] == 0);
  CHECK(none.open_lids == 1);
}

// Parallels, meridians and great circles are sections of what they are drawn on.
TEST_CASE("Lids change nothing where there are none") {
  for (const Net& net : {great_circles(), torus_net(10, 6, 0.4, 8), torus_net(12, 8, 0.6, 6),
                         box_with_circles(), lattice(2, 1, 1)}) {
    const Run plain = run_with(net, Lids::none), all = run_with(net, Lids::all);
    CHECK(std::equal(plain.betti, plain.betti + 3, all.betti));
    CHECK(plain.patches == all.patches);
    CHECK(all.open_lids == 0);
    CHECK(plain.open_lids == 0);
  }
}
