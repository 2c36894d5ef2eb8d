#include "network/group_rings.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>

#include "network/group.h"
#include "support/curve_nets.h"

using namespace unit;
using namespace wireskin::network;

namespace {

// A circle about the z axis with its normals in the half plane through it.
struct Hoop {
  double r, z, nr, nz;
  bool boundary = false;
};

// Turned in space, so that nothing is along an axis.
Vec3 turned(const Vec3& p) {
  const Vec3 u = wireskin::unit({1, 2, -1}), v = wireskin::unit(wireskin::reject({0, 1, 1}, u));
  return p.x * u + p.y * v + p.z * wireskin::cross(u, v);
}

CurveNet hoops(const std::vector<Hoop>& list) {
  CurveNet net;
  for (const Hoop& h : list) {
    net.add(64, true, h.boundary, [&](double t) {
      const Vec3 out = {std::cos(2 * k_pi * t), std::sin(2 * k_pi * t), 0};
      const Vec3 axis = {0, 0, 1};
      return std::make_pair(turned(h.r * out + h.z * axis),
                            turned(wireskin::unit(h.nr * out + h.nz * axis)));
    });
  }
  return net;
}

// The curves of each patch.
using Patches = std::multiset<std::set<uint32_t>>;

Patches patches_of(const CurveNet& net) {
  Stages s(net);
  REQUIRE_MESSAGE(s.group(0.15), std::string(s.status.sentence));
  Patches all;
  for (uint32_t p = 0; p < s.network.patches(); ++p) {
    std::set<uint32_t> curves;
    for (uint32_t h : s.network.cycle(p)) curves.insert(s.network.segment[h / 2].curve);
    all.insert(curves);
  }
  return all;
}

// One ring after the other, and back to the first one.
Patches round_and_round(uint32_t n) {
  Patches all;
  for (uint32_t i = 0; i < n; ++i) all.insert({i, (i + 1) % n});
  return all;
}

// One ring after the other, closed at both ends.
Patches chain(uint32_t n) {
  Patches all = {{0}, {n - 1}};
  for (uint32_t i = 0; i + 1 < n; ++i) all.insert({i, i + 1});
  return all;
}

}  // namespace

TEST_CASE("rings: a pipe with a thick wall") {
  for (double inner : {0.3, 0.6, 0.9, 0.97}) {
    for (double height : {0.6, 2.0, 6.0}) {
      CAPTURE(inner);
      CAPTURE(height);
      CHECK(patches_of(hoops(
                {{1, 0, 1, 0}, {1, height, 1, 0}, {inner, height, -1, 0}, {inner, 0, -1, 0}})) ==
            round_and_round(4));
      const double middle = 0.5 * (1 + inner), lip = 0.5 * (1 - inner);
      CHECK(patches_of(hoops({{1, 0, 1, 0},
                              {1, height, 1, 0},
                              {middle, height + lip, 0, 1},
                              {inner, height, -1, 0},
                              {inner, 0, -1, 0},
                              {middle, -lip, 0, -1}})) == round_and_round(6));
    }
  }
}

TEST_CASE("rings: a cup with a thick wall and floor") {
  for (double inner : {0.6, 0.8, 0.9}) {
    for (double height : {1.0, 2.0, 4.0}) {
      CAPTURE(inner);
      CAPTURE(height);
      const double floor = 2.0 * (1.0 - inner);
      CHECK(patches_of(hoops({{0.7, 0, 0, -1},
                              {1, height, 1, 0},
                              {inner, height, -1, 0},
                              {0.7 * inner, floor, 0, 1}})) == chain(4));
      CHECK(patches_of(hoops({{0.9, 0, 1, -1},
                              {1, height, 1, 0},
                              {inner, height, -1, 0},
                              {0.9 * inner, floor, -1, 1}})) == chain(4));
    }
  }
}

TEST_CASE("rings: one tube in another stays one") {
  for (double height : {1.0, 2.0, 4.0}) {
    CAPTURE(height);
    CHECK(patches_of(hoops({{1, 0, 1, 0, true},
                            {1, height, 1, 0, true},
                            {0.6, 0, 1, 0, true},
                            {0.6, height, 1, 0, true}})) == Patches{{0, 1}, {2, 3}});
  }
}

TEST_CASE("rings: a torus of parallels") {
  for (uint32_t n : {2, 3, 4, 5, 6}) {
    for (double tube : {0.5, 1.0}) {
      for (double first : {0.0, 0.1, 0.3}) {
        // Two parallels at top and bottom are rather a drum.
        if (n == 2 && first > 0.0) continue;
        CAPTURE(n);
        CAPTURE(tube);
        CAPTURE(first);
        std::vector<Hoop> list;
        for (uint32_t i = 0; i < n; ++i) {
          const double a = 2 * k_pi * (i + first) / n, c = std::cos(a), s = std::sin(a);
          list.push_back({4 + tube * c, tube * s, c, s});
        }
        CHECK(patches_of(hoops(list)) == round_and_round(n));
      }
    }
  }
}

TEST_CASE("rings: a sphere of parallels, an hourglass, a bell") {
  for (uint32_t n : {2, 3, 4, 5, 9}) {
    CAPTURE(n);
    std::vector<Hoop> sphere, hourglass;
    for (uint32_t i = 0; i < n; ++i) {
      const double a = k_pi * ((i + 0.5) / n - 0.5), c = std::cos(a), s = std::sin(a);
      sphere.push_back({c, s, c, s});
      const double z = 2.0 * i / (n - 1) - 1.0;
      hourglass.push_back({0.4 + 0.6 * z * z, z, 1, -1.2 * z});
    }
    CHECK(patches_of(hoops(sphere)) == chain(n));
    hourglass[0].nz = hourglass[n - 1].nz = 0.0;
    CHECK(patches_of(hoops(hourglass)) == chain(n));
  }
}

TEST_CASE("rings: three boundary rings are one patch") {
  for (double distance : {1.5, 2.0, 3.0}) {
    CurveNet net;
    for (int k = 0; k < 3; ++k) {
      const double a = 2 * k_pi * k / 3;
      const Vec3 axis = {std::cos(a), std::sin(a), 0}, u = {-axis.y, axis.x, 0}, v = {0, 0, 1};
      net.add(64, true, true, [&](double t) {
        const Vec3 n = std::cos(2 * k_pi * t) * u + std::sin(2 * k_pi * t) * v;
        return std::make_pair(turned(distance * axis + 0.6 * n), turned(n));
      });
    }
    CHECK(patches_of(net) == Patches{{0, 1, 2}});
  }
}

TEST_CASE("rings: the order in which they are given does not matter") {
  std::vector<Hoop> list = {{0.7, 0, 0, -1}, {1, 2, 1, 0}, {0.8, 2, -1, 0}, {0.56, 0.4, 0, 1}};
  std::vector<uint32_t> order = {0, 1, 2, 3};
  const Patches expected = chain(4);
  do {
    std::vector<Hoop> mixed;
    for (uint32_t i : order) mixed.push_back(list[i]);
    Patches found;
    for (const std::set<uint32_t>& p : patches_of(hoops(mixed))) {
      std::set<uint32_t> back;
      for (uint32_t c : p) back.insert(order[c]);
      found.insert(back);
    }
    CHECK(found == expected);
  } while (std::next_permutation(order.begin(), order.end()));
}
