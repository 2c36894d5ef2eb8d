#include "flow/point_grid.h"

#include <doctest/doctest.h>

#include <vector>

#include "support/context.h"

using namespace wireskin;
using flow::PointGrid;
using unit::Random;

namespace {

struct Query {
  std::vector<uint8_t> times;  // of each point
  size_t visits = 0;
};

Query all_near(const PointGrid& grid, size_t points, const Vec3& center, double radius) {
  Query query;
  query.times.assign(points, 0);
  CHECK_FALSE(grid.any_near(center, radius, [&](uint32_t i) {
    ++query.times.at(i);
    ++query.visits;
    return false;
  }));
  return query;
}

// Of few different coordinates, so that many points coincide and lie in a plane; half of them crowd
// in one place.
std::vector<Vec3> coarse_points(Random& random, size_t count, uint32_t places) {
  std::vector<Vec3> points(count);
  for (Vec3& p : points) {
    p = {double(random.below(places)), double(random.below(places)), double(random.below(3))};
    if (random.below(2) == 0) p = 0x1p-10 * p;
  }
  return points;
}

}  // namespace

TEST_CASE("Every point in the ball is visited once, and none twice") {
  Random random(11);
  for (size_t round = 0; round < 300; ++round) {
    const std::vector<Vec3> points = coarse_points(random, round, 1 + random.below(30));
    unit::Heap heap;
    PointGrid grid(heap.context);
    unit::must(grid.build(unit::span(points)));
    const double scale = random.below(2) == 0 ? 0x1p-10 : 1.0;
    const Vec3 center = scale * Vec3{double(random.below(30)), double(random.below(30)), 0.5};
    const double radius = scale * random.below(40) / 4.0;
    const Query query = all_near(grid, points.size(), center, radius);
    for (size_t i = 0; i < points.size(); ++i) {
      CHECK(query.times[i] <= 1);
      if (length(points[i] - center) <= radius) CHECK(query.times[i] == 1);
    }
  }
}

TEST_CASE("A visit that says yes ends the query") {
  Random random(12);
  const std::vector<Vec3> points = coarse_points(random, 500, 10);
  unit::Heap heap;
  PointGrid grid(heap.context);
  unit::must(grid.build(unit::span(points)));
  size_t visits = 0;
  CHECK(grid.any_near({5, 5, 1}, 20.0, [&](uint32_t) { return ++visits == 7; }));
  CHECK(visits == 7);
}

// Two lines a hundred thousandth apart, which the fuzzer found to cost the square of their samples.
TEST_CASE("A query among points on two long lines visits few of them") {
  const size_t count = 40000;
  std::vector<Vec3> points;
  for (size_t i = 0; i < count; ++i) {
    const double t = double(i) / count;
    points.push_back({0.0, t, t});
    points.push_back({1e-5, t, t});
  }
  unit::Heap heap;
  PointGrid grid(heap.context);
  unit::must(grid.build(unit::span(points)));
  size_t most = 0;
  for (size_t i = 0; i < points.size(); i += 97) {
    const Query query = all_near(grid, points.size(), points[i], 2.0 / count);
    if (query.visits > most) most = query.visits;
  }
  CHECK(most < 150);
}
