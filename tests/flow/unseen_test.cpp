// Shapes that the method was not tuned to: polyhedra, prisms, lattices, tori, floating circles.
#include "flow/unseen.h"

#include <doctest/doctest.h>

#include "flow/run.h"

using namespace flow_tests;

static void check_expected(const Expected& wish, const Run& r) {
  for (int k = 0; k < 3; ++k) CHECK(r.betti[k] == wish.betti[k]);
  CHECK(r.patches == wish.patches);
  CHECK(r.annuli == wish.annuli);
  CHECK(r.bare == 0);
  CHECK(r.open == 0);
  CHECK(r.missing == 0);
  CHECK(r.crossings == 0);
  CHECK(r.euler == 1);
}

TEST_CASE("Shapes made for this test become what they are") {
  for (const Expected& wish : unseen_networks()) {
    const std::string name = wish.name;
    CAPTURE(name);
    const Run r = run(wish.net, {0.02, 0, wish.voids, false, true});
    check_expected(wish, r);
    const Betti own = {r.betti[0], r.betti[1], r.betti[2]};
    CHECK((betti_of(r, r.raw_triangle) == own));
    CHECK(count_crossings(r.raw_position, r.raw_triangle) == 0);
    CHECK(count_crossings(r.position, r.triangle) == 0);
  }
}

TEST_CASE("They do so turned and with another jitter") {
  for (const Expected& wish : unseen_networks()) {
    const std::string name = wish.name;
    CAPTURE(name);
    check_expected(wish, run(turned(wish.net, 2), {0.02, 0, wish.voids, false, false}));
    check_expected(wish, run(reordered(wish.net, 3), {0.02, 11, wish.voids, false, false}));
  }
}

TEST_CASE("Ratios of regular shapes are known") {
  CHECK(run(octahedron()).ratio == doctest::Approx(std::sqrt(3.0)).epsilon(0.005));
  CHECK(run(great_circles()).ratio == doctest::Approx(std::sqrt(3.0)).epsilon(0.005));
  CHECK(run(lattice(1, 1, 1)).ratio == doctest::Approx(std::sqrt(2.0)).epsilon(0.005));
}

TEST_CASE("Flat faces keep their area") {
  CHECK(run(octahedron()).area == doctest::Approx(4.0 * std::sqrt(3.0)).epsilon(1e-6));
  CHECK(run(icosahedron()).area == doctest::Approx(20.0 * std::sqrt(3.0)).epsilon(1e-6));
  CHECK(run(lattice(2, 2, 2)).area == doctest::Approx(36.0).epsilon(1e-6));
}

TEST_CASE("Taking a curve away changes only what lies beside it") {
  Net net = torus_net(10, 6, 0.4, 8);
  const Run whole = run(net);
  net.curve.erase(net.curve.begin() + 3);  // a meridian: six pairs of patches become one each
  const Run less = run(net);
  CHECK(less.betti[1] == 2);
  CHECK(less.betti[2] == 1);
  CHECK(less.patches == whole.patches - 6);
  // All patches but those six are there again, with the same area.
  std::vector<double> before = whole.areas, after = less.areas;
  size_t same = 0;
  for (const double area : after) {
    for (double& other : before) {
      if (std::fabs(other - area) > 1e-3 * area) continue;
      other = -1.0;
      ++same;
      break;
    }
  }
  CHECK(same >= after.size() - 6);
}
