#include "network/sight.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "support/ribbon.h"

using namespace unit;
using namespace wireskin::network;

namespace {

// Loops, each of a patch of its own; `common`: a vertex that it has, or k_none.
struct Scene {
  Heap heap;
  Lists corner{heap.context};
  SightMap map{heap.context, corner};

  void add(const Border& border, uint32_t common = k_none) {
    const uint32_t patch = static_cast<uint32_t>(map.loop.size());
    must(add_sight_loop(border, 0, patch, false, &map));
    must(corner.item.push(common != k_none ? common : 1000000 + patch));
    must(corner.close());
  }
  void add_circle(double radius, double z, bool counter_clockwise, double tilt,
                  uint32_t common = k_none) {
    RibbonBorder one;
    one.add_circle(radius, z, counter_clockwise, tilt);
    add(one.border, common);
  }
  // What all places of a loop see, and with which cosine and way in the mean.
  Sight all_see(uint32_t loop, const std::vector<uint32_t>& hiding = {}) {
    std::vector<uint8_t> hidden(map.loop.size(), 0);
    for (uint32_t h : hiding) hidden[h] = 1;
    Sight all;
    const SightLoop& l = map.loop[loop];
    for (uint32_t i = l.first; i < l.first + l.count; ++i) {
      const Sight s = look(&map, i, view(hidden));
      if (i == l.first) all.loop = s.loop;
      CHECK(s.loop == all.loop);
      all.way += s.way / l.count;
      all.cosine += s.cosine / l.count;
    }
    return all;
  }
};

double curvature_of(const Border& border, bool reversed = false) {
  Heap heap;
  Lists none(heap.context);
  SightMap map(heap.context, none);
  must(add_sight_loop(border, 0, 0, reversed, &map));
  CHECK(knows_normals(border, 0));
  return map.loop[0].curvature;
}

}  // namespace

TEST_CASE("sight: the curvature inside a loop, by Gauss and Bonnet") {
  for (double tilt : {0.0, 0.3, 1.0, k_pi / 2, 2.5}) {  // of a sphere cut at that angle
    CAPTURE(tilt);
    RibbonBorder cap;
    cap.add_circle(std::sin(tilt) + 0.01, 0.0, true, tilt, 400);
    const double inside = 2 * k_pi * (1 - std::cos(tilt));
    CHECK(curvature_of(cap.border) == doctest::Approx(inside).epsilon(0.001));
    CHECK(curvature_of(cap.border, true) == doctest::Approx(4 * k_pi - inside).epsilon(0.001));
  }
  RibbonBorder square;  // corners turn as well
  square.add(4, [](double a) {
    return std::make_pair(Vec3{std::cos(a), std::sin(a), 0}, Vec3{0, 0, 1});
  });
  CHECK(std::fabs(curvature_of(square.border)) < 1e-12);
  RibbonBorder unknown;
  unknown.add(4, [](double a) {
    return std::make_pair(Vec3{std::cos(a), std::sin(a), 0}, a == 0.0 ? Vec3{} : Vec3{0, 0, 1});
  });
  CHECK(!knows_normals(unknown.border, 0));
}

TEST_CASE("sight: the ends of a tube see each other, the nearest first") {
  Scene s;
  for (double z : {2.0, 5.0, 3.0}) s.add_circle(1.0, z, false, k_pi / 2);
  s.add_circle(1.0, 0.0, true, k_pi / 2);
  must(build_sight_tree(&s.map));
  const Sight near = s.all_see(3);
  CHECK(near.loop == 0);
  CHECK(near.way == doctest::Approx(2.0).epsilon(0.01));
  CHECK(near.cosine == doctest::Approx(1.0).epsilon(0.01));
  // What would rather look at something nearer counts as farther off in that proportion: 5 is the
  // way to ring 1, which is not the one that ring 1 looks at, and so for ring 2.
  CHECK(s.all_see(3, {0}).loop == 2);
  CHECK(s.all_see(3, {0, 2}).loop == 1);
  CHECK(s.all_see(3, {0, 1, 2}).loop == k_none);
  // Loops that pass the same vertex do not see each other.
  Scene touching;
  touching.add_circle(1.0, 1.0, false, k_pi / 2, 7);
  touching.add_circle(1.0, 2.0, false, k_pi / 2);
  touching.add_circle(1.0, 0.0, true, k_pi / 2, 7);
  must(build_sight_tree(&touching.map));
  CHECK(touching.all_see(2).loop == 1);
}

TEST_CASE("sight: a disc sees itself across, a hole what is round it") {
  Scene s;
  s.add_circle(4.0, 0.0, true, 0.0);
  must(build_sight_tree(&s.map));
  const Sight across = s.all_see(0);
  CHECK(across.loop == 0);
  CHECK(across.way > 1.0);
  Scene hole;
  hole.add_circle(4.0, 0.0, true, 0.0);
  hole.add_circle(1.0, 0.0, false, 0.0);
  must(build_sight_tree(&hole.map));
  CHECK(hole.all_see(1).loop == 0);
  CHECK(hole.all_see(1).way == doctest::Approx(3.0).epsilon(0.02));
  CHECK(hole.all_see(1).cosine == doctest::Approx(1.0).epsilon(0.01));
}

TEST_CASE("sight: the way counts turns and twists, either way the same") {
  const auto place = [](Vec3 p, Vec3 c, Vec3 n, uint32_t loop) {
    return SightPlace{p, c, n, loop};
  };
  const SightPlace p = place({0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 0);
  CHECK(way_between(p, place({3, 0, 0}, {-1, 0, 0}, {0, 0, 1}, 1)) == 3.0);
  CHECK(way_between(p, place({-3, 0, 0}, {-1, 0, 0}, {0, 0, 1}, 1)) < 0.0);
  CHECK(way_between(p, place({3, 0, 0}, {1, 0, 0}, {0, 0, 1}, 1)) < 0.0);
  CHECK(way_between(p, place({3, 0, 0}, {-1, 0, 0}, {0, 0, -1}, 1)) < 0.0);
  CHECK(way_between(p, p) < 0.0);
  const double c = std::sqrt(0.5);
  CHECK(way_between(p, place({3, 0, 0}, {-1, 0, 0}, {0, c, c}, 1)) ==
        doctest::Approx(3.0 * 2.0 / (1.0 + c)));
  // A quarter of a circle of radius 3: half a right angle at either end, and no twist.
  const SightPlace up = place({3, 0, 3}, {0, 0, -1}, {-1, 0, 0}, 1);
  CHECK(way_between(p, up) ==
        doctest::Approx(3.0 * std::sqrt(2.0) * 4.0 / ((1.0 + c) * (1.0 + c))));
  std::mt19937 random(5);
  const auto uniform = [&random] { return 2.0 * random() / 4294967296.0 - 1.0; };
  int seen = 0;
  for (int k = 0; k < 2000; ++k) {
    SightPlace q[2];
    for (uint32_t i = 0; i < 2; ++i) {
      const Vec3 n = wireskin::unit({uniform(), uniform(), uniform()});
      const Vec3 o = wireskin::unit(wireskin::reject({uniform(), uniform(), uniform()}, n));
      q[i] = place({uniform(), uniform(), uniform()}, o, n, i);
    }
    const double there = way_between(q[0], q[1]);
    seen += there > 0.0;
    CHECK(there == doctest::Approx(way_between(q[1], q[0])));
    if (there > 0.0) CHECK(there >= length(q[1].position - q[0].position));
  }
  CHECK(seen > 100);
}

TEST_CASE("sight: the tree finds what all pairs would") {
  std::mt19937 random(11);
  const auto uniform = [&random] { return 2.0 * random() / 4294967296.0 - 1.0; };
  Scene s;
  for (int k = 0; k < 40; ++k) {
    const Vec3 centre = {4 * uniform(), 4 * uniform(), 4 * uniform()};
    const Vec3 axis = wireskin::unit({uniform(), uniform(), uniform()});
    const Vec3 u = wireskin::unit(wireskin::reject({uniform(), uniform(), uniform()}, axis));
    const Vec3 v = wireskin::cross(axis, u);
    const double r = 0.6 + 0.4 * uniform(), tilt = 1.5 + uniform();
    RibbonBorder one;
    one.add(30, [&](double a) {
      const Vec3 out = std::cos(a) * u + std::sin(a) * v;
      return std::make_pair(centre + r * out, std::sin(tilt) * out + std::cos(tilt) * axis);
    });
    s.add(one.border, k % 5 == 0 ? 7 : k_none);
  }
  must(build_sight_tree(&s.map));
  const auto may_see = [](uint32_t a, uint32_t b) { return a == b || a % 5 != 0 || b % 5 != 0; };
  const size_t n = s.map.place.size();
  std::vector<double> nearest(n);
  for (size_t i = 0; i < n; ++i) nearest[i] = s.map.loop[s.map.place[i].loop].reach;
  const auto way = [&](size_t i, size_t j) {
    const SightPlace &p = s.map.place[i], &q = s.map.place[j];
    const double w = way_between(p, q);
    return w > 0.0 && may_see(p.loop, q.loop) ? w : DBL_MAX;
  };
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < n; ++j) nearest[i] = std::min(nearest[i], way(i, j));
  }
  std::vector<uint8_t> hidden(s.map.loop.size(), 0);
  hidden[3] = hidden[17] = 1;
  size_t seen = 0;
  for (uint32_t i = 0; i < n; ++i) {
    double least = s.map.loop[s.map.place[i].loop].reach;
    uint32_t best = k_none;
    for (uint32_t j = 0; j < n; ++j) {
      const uint32_t loop = s.map.place[j].loop;
      const double w = way(i, j);
      if (w == DBL_MAX || (hidden[loop] && loop != s.map.place[i].loop)) continue;
      if (w * std::max(w / nearest[j], 1.0) < least) {
        least = w * std::max(w / nearest[j], 1.0);
        best = loop;
      }
    }
    const Sight found = look(&s.map, i, view(hidden));
    CHECK(found.loop == best);
    if (best == k_none) continue;
    ++seen;
    CHECK(found.way == doctest::Approx(least).epsilon(1e-12));
  }
  CHECK(seen > n / 2);
}
