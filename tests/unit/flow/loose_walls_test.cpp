#include "flow/loose_walls.h"

#include <doctest/doctest.h>

#include "unit/flow/prisms.h"

using namespace unit;
using flow_tests::Net;
using wireskin::flow::Flatness;
using wireskin::flow::Persistence;

namespace {

// Rooms as growing balls find them, and as they are without the loose walls.
struct Rooms : FlowOf {
  Persistence plain{heap.context}, joined{heap.context};
  Array<Flatness> flatness{heap.context};
  Array<uint8_t> loose{heap.context};

  explicit Rooms(const Net& net) : FlowOf(net) {
    must(find_persistence(heap.context, flow.complex, &plain));
    must(find_persistence_of_faces(heap.context, flow.complex, flow.samples, flow.curves, &flatness,
                                   &joined, &loose));
  }
  static int count(const Persistence& persistence) {
    int rooms = 0;
    for (const auto& v : persistence.voids) rooms += !v.loose && v.ratio > 1.02;
    return rooms;
  }
  double loose_area() const {
    double sum = 0.0;
    for (uint32_t t = 0; t < loose.size(); ++t) sum += loose[t] ? area_of(t) : 0.0;
    return sum;
  }
};

}  // namespace

TEST_CASE("a cube has no loose walls: the voids are those of the balls, bit for bit") {
  const Rooms cube(prism({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 1.0));
  CHECK(cube.loose_area() == 0.0);
  REQUIRE(cube.joined.voids.size() == cube.plain.voids.size());
  for (size_t i = 0; i < cube.plain.voids.size(); ++i) {
    CHECK(cube.joined.voids[i].creator == cube.plain.voids[i].creator);
    CHECK(cube.joined.voids[i].ratio == cube.plain.voids[i].ratio);
  }
  CHECK(Rooms::count(cube.joined) == 1);
}

TEST_CASE("a box is one room, whatever walls of noise there are in it") {
  const Rooms box(prism({{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}}, 2.0));
  CHECK(Rooms::count(box.plain) == 1);
  CHECK(Rooms::count(box.joined) == 1);
}

TEST_CASE("an L is one room, which walls in mid-air part") {
  for (const double width : {0.5, 0.7}) {
    const Rooms l(l_prism(width, 0.5));
    CHECK(Rooms::count(l.plain) > 1);
    CHECK(Rooms::count(l.joined) == 1);
    CHECK(l.loose_area() > 0.0);
  }
}

TEST_CASE("a wall that curves hold along most of its border parts two rooms") {
  const Rooms waisted(waisted_prism(0.05, 1.5));
  CHECK(Rooms::count(waisted.plain) == 2);
  CHECK(Rooms::count(waisted.joined) == 2);
  CHECK(waisted.loose_area() == 0.0);
}

TEST_CASE("no triangle of a flat face is loose, and loose voids are those that loose walls close") {
  const Rooms l(l_prism(0.5, 0.5));
  for (uint32_t t = 0; t < l.loose.size(); ++t) {
    if (l.loose[t]) CHECK(l.flatness[t] == Flatness::none);
  }
  for (const auto& v : l.joined.voids) CHECK(v.loose == (l.loose[v.creator] != 0));
}
