#include "sparse/nested_dissection.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "matrices.h"
#include "sparse/ordering.h"

using namespace matrices;
using namespace wireskin::sparse;
using wireskin::Code;
using wireskin::Vec3;

namespace {

struct Places {
  std::vector<uint32_t> vertex;
  std::vector<Vec3> position;
  std::vector<uint32_t> patch;

  Geometry geometry() const { return {span(vertex), span(position), span(patch)}; }
};

// The points of a w x h grid, cut into strips of patches along x.
Places grid_places(uint32_t w, uint32_t h, uint32_t patches) {
  Places places;
  for (uint32_t y = 0; y < h; ++y) {
    for (uint32_t x = 0; x < w; ++x) {
      places.position.push_back({0.1 * x, 0.1 * y, 0.01 * (x + y)});
      places.patch.push_back(x * patches / w);
    }
  }
  return places;
}

std::vector<uint32_t> order_of(const Symmetric& a, const Places& places) {
  Heap heap;
  Array<uint32_t> order(heap.context);
  must(nested_dissection(a.csc(heap.context), places.geometry(), &order));
  return {order.begin(), order.end()};
}

void check_permutation(std::vector<uint32_t> order, uint32_t n) {
  std::sort(order.begin(), order.end());
  REQUIRE(order == natural_order(n));
}

}  // namespace

TEST_CASE("nested dissection: nothing, one column, and a matrix without entries") {
  CHECK(order_of(Symmetric(0), {}).empty());
  CHECK(order_of(Symmetric(1), grid_places(1, 1, 1)) == std::vector<uint32_t>{0});
  check_permutation(order_of(Symmetric(100), grid_places(10, 10, 3)), 100);
}

TEST_CASE("nested dissection: about the fill of the grid's own dissection") {
  for (const uint32_t side : {16u, 31u, 45u}) {
    const Symmetric a = grid(side, side);
    std::vector<uint32_t> best;
    dissect(0, side, 0, side, side, &best);
    const size_t optimum = Elimination(a, best).nonzeros();
    const std::vector<uint32_t> order = order_of(a, grid_places(side, side, 1));
    check_permutation(order, a.n);
    CHECK(Elimination(a, order).nonzeros() <= 1.15 * static_cast<double>(optimum));
  }
}

TEST_CASE("nested dissection: on small bilaplacians little worse than minimum degree") {
  const uint32_t side = 60;
  const Symmetric a = square(grid(side, side));
  Heap heap;
  Array<uint32_t> degree(heap.context);
  must(minimum_degree(a.csc(heap.context), &degree));
  const size_t general = Elimination(a, {degree.begin(), degree.end()}).nonzeros();
  const size_t ours = Elimination(a, order_of(a, grid_places(side, side, 1))).nonzeros();
  CHECK(ours <= 1.2 * static_cast<double>(general));
}

TEST_CASE("nested dissection: the separator between patches is one layer") {
  // Two sheets of a bilaplacian, coupled through one layer only.
  const uint32_t w = 40, h = 30;
  Symmetric a(w * h);
  const Symmetric whole = square(grid(w, h));
  for (const auto& [place, value] : whole.entries) {
    const uint32_t x = place.first % w, y = place.second % w;
    const bool across = (x < w / 2) != (y < w / 2);
    if (!across || (std::max(x, y) - std::min(x, y) == 1)) a.at(place.first, place.second) = value;
  }
  const std::vector<uint32_t> order = order_of(a, grid_places(w, h, 2));
  for (size_t k = order.size() - h; k < order.size(); ++k) {
    const uint32_t x = order[k] % w;
    CHECK((x == w / 2 || x == w / 2 - 1));
  }
}

TEST_CASE("nested dissection: the columns of a vertex stay together") {
  std::mt19937 random(8);
  const uint32_t side = 14;
  const Symmetric coarse = square(grid(side, side));
  Places places = grid_places(side, side, 3);
  std::vector<uint32_t> first;
  for (uint32_t v = 0; v < side * side; ++v) {
    first.push_back(static_cast<uint32_t>(places.vertex.size()));
    for (uint32_t k = 0; k < 1 + random() % 3; ++k) places.vertex.push_back(v);
  }
  first.push_back(static_cast<uint32_t>(places.vertex.size()));
  Symmetric a(first.back());
  for (const auto& entry : coarse.entries) {
    for (uint32_t i = first[entry.first.first]; i < first[entry.first.first + 1]; ++i) {
      for (uint32_t j = first[entry.first.second]; j < first[entry.first.second + 1]; ++j)
        a.at(i, j) = 1;
    }
  }
  const std::vector<uint32_t> order = order_of(a, places);
  check_permutation(order, a.n);
  for (size_t k = 1; k < order.size(); ++k) {
    const bool same = places.vertex[order[k]] == places.vertex[order[k - 1]];
    CHECK(same == (order[k] == order[k - 1] + 1 && order[k] != first[places.vertex[order[k]]]));
  }
}

TEST_CASE("nested dissection: any places and any patches give an order") {
  std::mt19937 random(9);
  for (int round = 0; round < 60; ++round) {
    const uint32_t n = 1 + static_cast<uint32_t>(random() % 300);
    const Symmetric a = random_spd(n, 6.0, random);
    Places places;
    for (uint32_t i = 0; i < n; ++i) {
      const double same = round % 3 == 0 ? 0.0 : 1.0;
      const std::vector<double> p = random_vector(3, random);
      places.position.push_back({same * p[0], same * p[1], p[2] * static_cast<double>(round % 2)});
      places.patch.push_back(static_cast<uint32_t>(random() % (1 + round)));
    }
    check_permutation(order_of(a, places), n);
  }
}

TEST_CASE("nested dissection: every failing allocation and every cancel is a clean status") {
  const Symmetric a = square(grid(40, 40));
  const Places places = grid_places(40, 40, 4);
  for (const bool cancel : {false, true}) {
    bool done = false;
    for (size_t k = 0; !done; ++k) {
      REQUIRE(k < 1000);
      Heap heap;
      {
        const Csc lower = a.csc(heap.context);
        if (cancel) {
          heap.cancel_at = k;
        } else {
          heap.allocator.fail_at = heap.allocator.calls + k;
        }
        Array<uint32_t> order(heap.context);
        const Status status = nested_dissection(lower, places.geometry(), &order);
        done = status.ok();
        if (!done) CHECK(status.code == (cancel ? Code::cancelled : Code::out_of_memory));
        if (done && !cancel) CHECK(k > 5);
      }
      CHECK(heap.allocator.clean());
    }
  }
}
