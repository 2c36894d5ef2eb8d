#include "network/facing.h"

#include <doctest/doctest.h>

#include "support/ribbon.h"

using namespace unit;
using namespace wireskin::network;

namespace {

struct Circles {
  RibbonBorder ribbon;
  Array<Facing> facing{ribbon.heap.context};
  Array<Probe> probes{ribbon.heap.context};

  // Its own patch; normals as in RibbonBorder::add_circle.
  void add(double radius, double z, bool counter_clockwise, double tilt, bool reversed = false) {
    RibbonBorder one;
    one.add_circle(radius, z, counter_clockwise, tilt);
    const double cosine = counter_clockwise ? std::cos(tilt) : -std::cos(tilt);
    must(add_facing(one.border, 0, static_cast<uint32_t>(facing.size()), reversed,
                    reversed ? -cosine : cosine, k_pi * radius * radius, &facing, &probes));
  }
  double half(uint32_t a, uint32_t b, double least = 0.2) {
    return half_band(facing[a], facing[b], probes.span(), least);
  }
};

}  // namespace

TEST_CASE("facing: probes lie on the loop and look into the patch") {
  Circles c;
  c.add(2.0, 1.0, true, 0.0);        // a disc
  c.add(2.0, 1.0, true, 0.0, true);  // what is round it
  c.add(2.0, 1.0, true, k_pi / 2);   // up a tube
  const double inwards[] = {1.0, -1.0, 0.0}, upwards[] = {0.0, 0.0, 1.0};
  for (uint32_t k = 0; k < 3; ++k) {
    const Facing& f = c.facing[k];
    CHECK(f.patch == k);
    CHECK(f.count == 64);
    CHECK(length(f.centre - Vec3{0, 0, 1}) < 0.02);
    CHECK(f.radius == doctest::Approx(2.0).epsilon(0.01));
    double length_of_loop = 0.0;
    for (const Probe& p : c.probes.span().part(f.first, f.count)) {
      length_of_loop += p.share;
      CHECK(dot(p.conormal, wireskin::unit(Vec3{0, 0, 1} - p.position)) ==
            doctest::Approx(inwards[k]));
      CHECK(p.conormal.z == doctest::Approx(upwards[k]));
    }
    CHECK(length_of_loop == doctest::Approx(4 * k_pi).epsilon(0.001));
  }
}

TEST_CASE("facing: the cap over a loop costs what it bends") {
  Circles c;
  for (double cosine : {1.0, 0.6, 0.4, 0.0, -0.5}) {
    c.add(1.0, 0.0, true, std::acos(cosine));
    const double m = 1.0 + cosine;
    CHECK(c.facing.back().alone == doctest::Approx(8 * k_pi / (m * m * m)));
    CHECK(c.facing.back().needy == (cosine < 0.5));
  }
}

TEST_CASE("facing: half a band between two rings of a tube") {
  for (double height : {0.5, 2.0}) {
    Circles c;
    c.add(1.0, 0.0, true, k_pi / 2);
    c.add(1.0, height, false, k_pi / 2);
    CHECK(c.half(0, 1) == doctest::Approx(k_pi * height).epsilon(0.01));
    CHECK(c.half(1, 0) == doctest::Approx(k_pi * height).epsilon(0.01));
  }
}

TEST_CASE("facing: no band where conormals lead elsewhere, or loops touch") {
  Circles away;
  away.add(1.0, 0.0, false, k_pi / 2);
  away.add(1.0, 1.0, true, k_pi / 2);
  CHECK(away.half(0, 1) < 0.0);
  CHECK(away.half(1, 0) < 0.0);
  Circles slanting;  // the other loop stands at a cosine of about .7
  slanting.add(1.0, 0.0, true, k_pi / 2);
  slanting.add(2.0, 1.0, false, k_pi / 4);
  const double half = slanting.half(0, 1);
  CHECK(half ==
        doctest::Approx(k_pi * std::sqrt(2.0) * 2.0 / (1.0 + std::sqrt(0.5))).epsilon(0.01));
  CHECK(slanting.half(0, 1, 0.6) == half);
  CHECK(slanting.half(0, 1, 0.8) < 0.0);
  Circles touching;
  touching.add(1.0, 0.0, true, k_pi / 2);
  touching.add(1.0, 0.0, false, k_pi / 2);
  CHECK(touching.half(0, 1) < 0.0);
}
