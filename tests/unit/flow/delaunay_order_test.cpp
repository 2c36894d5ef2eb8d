#include "flow/delaunay_order.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "unit/flow/flow_sets.h"

using namespace wireskin;
using namespace unit;

namespace {

struct Order {
  std::vector<uint32_t> order, same_as;
};

Order order_of(const Points& p) {
  Heap heap;
  Array<uint32_t> order(heap.context), same_as(heap.context);
  must(flow::delaunay_order(heap.context, view(p), &order, &same_as));
  return {to_vector(order), to_vector(same_as)};
}

}  // namespace

TEST_CASE("the curve goes from cell to neighbouring cell") {
  Points grid;
  for (int i = 0; i < 512; ++i) grid.push_back({double(i % 8), double(i / 8 % 8), double(i / 64)});
  const std::vector<uint32_t> order = order_of(grid).order;
  CHECK(std::set<uint32_t>(order.begin(), order.end()).size() == 512);
  size_t jumps = 0;
  for (size_t i = 1; i < 512; ++i) {
    jumps += length(grid[order[i]] - grid[order[i - 1]]) == 1.0 ? 0 : 1;
  }
  CHECK(jumps == 0);
}

TEST_CASE("many points come in rounds: early ones are few and spread out") {
  Random random(1);
  const Points p = random_points(20000, random);
  const std::vector<uint32_t> order = order_of(p).order;
  CHECK(std::set<uint32_t>(order.begin(), order.end()).size() == p.size());
  std::set<int> octants;
  for (size_t i = 0; i < 450; ++i) {
    const Vec3& q = p[order[i]];
    octants.insert((q.x > 0 ? 1 : 0) + (q.y > 0 ? 2 : 0) + (q.z > 0 ? 4 : 0));
  }
  CHECK(octants.size() == 8);
  double last_round_steps = 0.0;
  for (size_t i = 10000; i < 20000; ++i) {
    last_round_steps += length(p[order[i]] - p[order[i - 1]]) / 10000.0;
  }
  CHECK(last_round_steps < 0.12);  // of a cube of side two; a random order makes steps of 1.3
}

TEST_CASE("the order is one of places, and each place has its least number") {
  Random random(2);
  Points p = random_points(700, random);
  // One cell holds many places, some places have many points, and zero has two signs.
  for (int i = 0; i < 60; ++i) p.push_back({1e-9 * random.below(4), 0.0, i % 2 == 0 ? 0.0 : -0.0});
  Points reversed(p.rbegin(), p.rend());
  const Order a = order_of(p), b = order_of(reversed);
  REQUIRE(a.order.size() == b.order.size());
  CHECK(a.order.size() <= 704);
  CHECK(a.order.size() > 700);
  size_t wrong = 0;
  for (size_t i = 0; i < a.order.size(); ++i) {
    wrong += p[a.order[i]] == reversed[b.order[i]] ? 0 : 1;
  }
  for (uint32_t i = 0; i < p.size(); ++i) {
    uint32_t least = 0;
    while (!(p[least] == p[i])) ++least;
    wrong += a.same_as[i] == least ? 0 : 1;
  }
  CHECK(wrong == 0);
  CHECK(order_of({}).order.empty());
}
