#include "planar/insertion_order.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

using namespace wireskin;
using namespace wireskin::planar;

namespace {

void* allocate(size_t bytes, void*) {
  return std::malloc(bytes);
}
void release(void* memory, size_t, void*) {
  std::free(memory);
}

std::vector<uint32_t> order_of(const std::vector<Vec2>& points) {
  Context context({allocate, release, nullptr}, 0, {});
  Array<uint32_t> order(context);
  REQUIRE(insertion_order({points.data(), points.size()}, &order).ok());
  return {order.begin(), order.end()};
}

std::vector<Vec2> random_points(size_t count) {
  std::mt19937 random(1);
  std::vector<Vec2> points;
  for (size_t i = 0; i < count; ++i) {
    points.push_back(
        {static_cast<double>(random()) * 0x1p-32, static_cast<double>(random()) * 0x1p-32});
  }
  return points;
}

}  // namespace

TEST_CASE("every point comes once") {
  for (const size_t count : {0u, 1u, 2u, 255u, 256u, 5000u}) {
    std::vector<uint32_t> order = order_of(random_points(count));
    std::sort(order.begin(), order.end());
    REQUIRE(order.size() == count);
    for (uint32_t i = 0; i < count; ++i) CHECK(order[i] == i);
  }
  CHECK(order_of(std::vector<Vec2>(7, Vec2{3.0, 4.0})).size() == 7);
}

TEST_CASE("neighbours in the order are neighbours in the plane") {
  const std::vector<Vec2> points = random_points(20000);
  const std::vector<uint32_t> order = order_of(points);
  double path = 0.0;
  for (size_t i = 1; i < order.size(); ++i) path += length(points[order[i]] - points[order[i - 1]]);
  // A Hilbert curve's path is about 0.92 sqrt(n); random order would give 0.52 n.
  CHECK(path < 2.0 * std::sqrt(20000.0));
}

TEST_CASE("early points are spread over all of the set") {
  const std::vector<Vec2> points = random_points(20000);
  const std::vector<uint32_t> order = order_of(points);
  int quarter[4] = {0, 0, 0, 0};
  for (size_t i = 0; i < 80; ++i) {
    const Vec2 p = points[order[i]];
    ++quarter[(p.x > 0.5 ? 1 : 0) + (p.y > 0.5 ? 2 : 0)];
  }
  for (const int count : quarter) CHECK(count > 5);
}

TEST_CASE("scaling and shifting by powers of two does not change the order") {
  std::vector<Vec2> points = random_points(2000);
  const std::vector<uint32_t> order = order_of(points);
  for (Vec2& p : points) p = 0x1p-70 * p;
  CHECK(order_of(points) == order);
}
