#include "flow/jitter.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "unit/flow/flow_sets.h"

using namespace wireskin;
using namespace unit;

namespace {

Points jittered(const Points& p, double amount, uint64_t seed) {
  Points moved(p.size());
  flow::jitter_points(view(p), amount, seed, span(moved));
  return moved;
}

}  // namespace

TEST_CASE("points move by at most the amount, evenly, along each axis") {
  Random random(1);
  const Points p = random_points(3000, random);
  const double reach = 1e-3 * flow::box_diagonal(view(p));
  const Points moved = jittered(p, 1e-3, 0);
  Vec3 least, most, sum;
  for (size_t i = 0; i < p.size(); ++i) {
    const Vec3 by = (1.0 / reach) * (moved[i] - p[i]);
    least = {std::min(least.x, by.x), std::min(least.y, by.y), std::min(least.z, by.z)};
    most = {std::max(most.x, by.x), std::max(most.y, by.y), std::max(most.z, by.z)};
    sum += by;
  }
  for (const double x : {-least.x, -least.y, -least.z, most.x, most.y, most.z}) {
    CHECK(x > 0.99);
    CHECK(x < 1.0 + 1e-9);
  }
  CHECK(length(sum) < 0.05 * static_cast<double>(p.size()));
}

TEST_CASE("the same place moves the same way, other seeds move it another way") {
  Points p = {{0, 0, 0}, {1, 2, 3}, {-0.0, 0, 0}, {1, 2, 4}, {1, 2, 3}};
  const Points moved = jittered(p, 1e-7, 0);
  CHECK(moved[0] == moved[2]);
  CHECK(moved[1] == moved[4]);
  CHECK(moved[1] != moved[3]);
  CHECK(moved[1] != jittered(p, 1e-7, 1)[1]);
  std::reverse(p.begin(), p.end());
  Points back = jittered(p, 1e-7, 0);
  std::reverse(back.begin(), back.end());
  CHECK(std::equal(back.begin(), back.end(), moved.begin()));
}

TEST_CASE("no amount keeps every point, a single place has no diagonal") {
  const Points p = {{0.1, 0.2, 0.3}, {1, 2, 3}};
  const Points moved = jittered(p, 0.0, 0);
  CHECK(moved[0] == p[0]);
  CHECK(moved[1] == p[1]);
  CHECK(flow::box_diagonal({}) == 0.0);
  CHECK(flow::box_diagonal(view(p)) == doctest::Approx(std::sqrt(0.81 + 3.24 + 7.29)));
  CHECK(jittered({{5, 5, 5}, {5, 5, 5}}, 1e-7, 0)[1] == Vec3{5, 5, 5});
}
