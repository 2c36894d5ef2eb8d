#include "network/ring_bands.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "support/ribbon.h"

using namespace unit;
using namespace wireskin::network;

namespace {

struct Scene {
  Heap heap;
  RingBands bands{heap.context};

  void add(double radius, double z, bool counter_clockwise, double tilt) {
    RibbonBorder one;
    one.add_circle(radius, z, counter_clockwise, tilt, 96);
    const uint32_t own = static_cast<uint32_t>(bands.side.size());
    RingSide side;
    side.patch = side.component = own;
    must(add_ring_side(one.border, side, &bands));
  }
  void add_disc(const Vec3& centre, double radius) {
    RibbonBorder one;
    one.add(96, [=](double a) {
      return std::make_pair(centre + radius * Vec3{std::cos(a), std::sin(a), 0}, Vec3{0, 0, 1});
    });
    RingSide side;
    side.patch = side.component = static_cast<uint32_t>(bands.side.size());
    must(add_ring_side(one.border, side, &bands));
  }
};

}  // namespace

TEST_CASE("rings: the band of a tube is its area, less for looking straight at each other") {
  for (double height : {0.2, 1.0, 7.0}) {
    Scene s;
    s.add(1.0, 0.0, true, k_pi / 2);
    s.add(1.0, height, false, k_pi / 2);
    const RingBand band = band_between(s.bands, 1, 0);
    CHECK(band.a == 0);
    CHECK(band.b == 1);
    CHECK(band.cosine == doctest::Approx(1.0).epsilon(1e-3));
    CHECK(band.cost * band_weight(1.0) == doctest::Approx(2 * k_pi * height).epsilon(0.02));
    // The same bits whichever side asks.
    CHECK(band.cost == band_between(s.bands, 0, 1).cost);
  }
}

TEST_CASE("rings: a rim that bends back is four times as long as its chord") {
  Scene s;
  s.add(1.0, 0.0, true, k_pi / 2);    // looks up, normals outwards
  s.add(0.8, 0.0, false, -k_pi / 2);  // looks up, normals inwards
  const RingBand band = band_between(s.bands, 0, 1);
  CHECK(std::fabs(band.cosine) < 1e-6);
  CHECK(band.cost * band_weight(0.0) == doctest::Approx(4 * 0.2 * 0.9 * 2 * k_pi).epsilon(0.02));
}

TEST_CASE("rings: normals on the wrong side make a band long") {
  Scene s;
  s.add(1.0, 0.0, true, k_pi / 2);
  s.add(1.0, 1.0, false, k_pi / 2);
  s.add(1.0, 1.0, true, -k_pi / 2);
  CHECK(band_between(s.bands, 0, 2).cost > 5.0 * band_between(s.bands, 0, 1).cost);
}

TEST_CASE("rings: the bands listed are the least ones of each side") {
  std::mt19937 random(3);
  const auto uniform = [&random] { return random() / 4294967296.0; };
  Scene s;
  for (int k = 0; k < 60; ++k) {
    s.add(0.5 + uniform(), 20.0 * uniform(), k % 2 == 0, k_pi * uniform());
  }
  must(list_ring_bands(&s.bands));
  const auto listed = [&s](uint32_t a, uint32_t b) {
    return std::any_of(s.bands.band.begin(), s.bands.band.end(), [=](const RingBand& band) {
      return band.a == std::min(a, b) && band.b == std::max(a, b);
    });
  };
  for (uint32_t i = 1; i < s.bands.band.size(); ++i) {
    CHECK(s.bands.band[i - 1].cost <= s.bands.band[i].cost);
  }
  for (uint32_t a = 0; a < 60; ++a) {
    double least = DBL_MAX;
    uint32_t best = k_none;
    for (uint32_t b = 0; b < 60; ++b) {
      const double cost = a == b ? DBL_MAX : band_between(s.bands, a, b).cost;
      if (cost < least) best = b;
      least = std::min(least, cost);
    }
    CHECK(listed(a, best));
  }
}

// Small discs round the foot of a tube give no band with it; a few dozen do not keep it from its
// other end, but with thousands every side would look at every other one.
TEST_CASE("rings: a side gives up after many others that give no band") {
  for (uint32_t discs : {30u, 60u, 100u, 400u}) {
    CAPTURE(discs);
    Scene s;
    s.add(1.0, 0.0, true, k_pi / 2);
    s.add(1.0, 4.0, false, k_pi / 2);
    for (uint32_t k = 0; k < discs; ++k) {
      const double a = 2 * k_pi * k / discs;
      const Vec3 centre = {3.0 * std::cos(a), 3.0 * std::sin(a), -2.0};
      s.add_disc(centre, 0.1);
      REQUIRE(band_between(s.bands, 0, 2 + k).cost == DBL_MAX);
    }
    must(list_ring_bands(&s.bands));
    bool found = false;
    for (const RingBand& band : s.bands.band) found = found || (band.a == 0 && band.b == 1);
    CHECK(found == (discs <= 60));
  }
}
