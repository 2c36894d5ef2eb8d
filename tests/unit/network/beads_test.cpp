#include "network/beads.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "support/strung_beads.h"

using namespace wireskin;
using namespace wireskin::network;
using namespace unit;

TEST_CASE(
    "beads made between samples stand in the order of the curve, whatever order they came in") {
  StrungBeads net;
  net.add(line({0, 0, 0}, {3, 0, 0}, 3));
  net.string(2);
  const uint32_t late = net.beads.make_bead({1, 0.75}), early = net.beads.make_bead({1, 0.25});
  CHECK(net.beads.bead[1].next == early);
  CHECK(net.beads.bead[early].next == late);
  CHECK(net.beads.bead[late].next == 2);
  CHECK(net.beads.bead[2].previous == late);
  CHECK(net.beads.bead[early].to_next == doctest::Approx(0.5));
  CHECK(net.beads.make_bead({1, 0.25}) == early);  // there is one already
  CHECK(net.beads.make_bead({1, 0.0}) == 1);       // a sample serves
  const BeadPlace place = net.beads.locate({1, 0.5});
  CHECK(place.bead == early);
  CHECK(place.behind == doctest::Approx(0.25));
}

namespace {

// Beads made on one edge, one after the other at these parts of it: each stands in the order of the
// edge and is found there.
struct Crowd : StrungBeads {
  size_t count;

  explicit Crowd(const std::vector<double>& parts) : count(parts.size()) {
    add(line({0, 0, 0}, {1, 0, 0}, 1));
    string(count);
    std::vector<std::pair<double, uint32_t>> made;
    for (const double part : parts) made.push_back({part, beads.make_bead({0, part})});
    std::sort(made.begin(), made.end());
    uint32_t before = 0;
    for (const auto& [part, b] : made) {
      REQUIRE(beads.locate({0, std::nextafter(part, 0.0)}).bead == before);
      REQUIRE(beads.locate({0, part}).bead == b);
      REQUIRE(beads.bead[before].next == b);
      before = b;
    }
    CHECK(beads.bead[before].next == 1);
  }
  // How many beads are passed at most on the way to one.
  uint32_t longest_way() const {
    uint32_t longest = 0;
    size_t seen = 0;
    std::vector<std::pair<uint32_t, uint32_t>> todo = {{beads.bead[0].upper, 1}};
    while (!todo.empty()) {
      const auto [b, depth] = todo.back();
      todo.pop_back();
      if (b == k_none) continue;
      ++seen;
      longest = std::max(longest, depth);
      todo.push_back({beads.bead[b].lower, depth + 1});
      todo.push_back({beads.bead[b].upper, depth + 1});
    }
    CHECK(seen == count);
    return longest;
  }
};

}  // namespace

TEST_CASE("beads of an edge are found without passing the others, whatever order they came in") {
  // Ever nearer to an end or to a place between, each far enough from the last for its own bead.
  std::vector<double> ascending, descending, inward, halving;
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 10000; ++i) {
    const double step = 1.0 / 512.0, left = std::pow(1.0 - step, i);
    ascending.push_back(1.0 - left * (1.0 - step));
    descending.push_back(left * (1.0 - step));
    (i % 2 == 0 ? low : high) += (i % 2 == 0 ? step : -step) * (high - low);
    inward.push_back(i % 2 == 0 ? low : high);
  }
  for (uint32_t gaps = 1; gaps < (1u << 17); gaps *= 2) {
    for (uint32_t i = 0; i < gaps; ++i) halving.push_back((i + 0.5) / gaps);
  }
  for (const auto& parts : {ascending, descending, inward, halving}) {
    CHECK(Crowd(parts).longest_way() < 60);  // twice the natural logarithm is about the mean
  }
}

TEST_CASE("the nearest special bead: an end within its reach, a node within its own, else none") {
  StrungBeads net;
  net.add(line({0, 0, 0}, {10, 0, 0}, 10));
  net.add(line({6, 0, 0}, {6, 5, 0}, 5));
  net.string(1);
  CHECK(net.beads.special_near({2, 0.0}, 2.5, 2.5) == 0);
  CHECK(net.beads.special_near({9, 0.0}, 2.5, 2.5) == 10);
  CHECK(net.beads.special_near({3, 0.0}, 2.5, 2.5) == k_none);
  CHECK(net.beads.special_near({5, 0.0}, 2.5, 1.5) == 6);
  CHECK(net.beads.special_near({5, 0.0}, 2.5, 0.5) == k_none);
  // A node beyond its reach does not hide the end behind it.
  CHECK(net.beads.special_near({8, 0.0}, 2.5, 0.5) == 10);
}

TEST_CASE("the nearest place is looked for along the curve, within the reach alone") {
  StrungBeads net;
  net.add(line({0, 0, 0}, {10, 0, 0}, 10));
  net.string(1);
  const WirePlace place = net.beads.nearest_place({4, 0.0}, {5.5, 1, 0}, 3.0);
  CHECK(place.edge == 5);
  CHECK(place.part == doctest::Approx(0.5));
  CHECK(net.beads.nearest_place({1, 0.0}, {9.5, 0, 0}, 2.0).edge < 6);
}

TEST_CASE("directions follow the curve, at its last sample too, and normals go over into others") {
  StrungBeads net;
  net.add(line({0, 0, 0}, {2, 0, 0}, 2), false, {{0, 1, 0}, {0, 0, 1}, {0, 0, 1}});
  net.string(1);
  for (const WirePlace place : {WirePlace{0, 0.0}, WirePlace{0, 0.99}, WirePlace{2, 0.0}}) {
    CHECK(length(wireskin::unit(net.beads.direction_at(place)) - Vec3{1, 0, 0}) < 1e-12);
  }
  CHECK(net.beads.normal_at({0, 0.25}) == Vec3{0, 0.75, 0.25});
  CHECK(net.beads.normal_at({2, 0.0}) == Vec3{0, 0, 1});
}

TEST_CASE("a point has no direction") {
  StrungBeads net;
  net.add({{1, 2, 3}});
  net.string(1);
  CHECK(net.beads.direction_at({0, 0.0}) == Vec3{});
}

TEST_CASE("new nodes next to each other on a curve become one, old ones do not") {
  StrungBeads net;
  net.add(line({0, 0, 0}, {4, 0, 0}, 4));
  net.add(line({1, 0, 0}, {1, 2, 0}, 2));
  net.add(line({2, 0, 0}, {2, 2, 0}, 2));
  net.string(2);
  must(net.beads.unite_close(1.5));
  CHECK(net.beads.sets.find(1) != net.beads.sets.find(2));
  net.beads.unite(3, 10);  // the far end of the last curve
  must(net.beads.unite_close(0.5));
  CHECK(net.beads.sets.find(2) != net.beads.sets.find(3));
  must(net.beads.unite_close(1.5));
  CHECK(net.beads.sets.find(2) == net.beads.sets.find(3));
}
