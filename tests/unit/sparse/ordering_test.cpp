#include "sparse/ordering.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "matrices.h"
#include "sparse/cholesky.h"

using namespace matrices;
using namespace wireskin::sparse;

namespace {

bool is_permutation(const std::vector<uint32_t>& order, uint32_t n) {
  std::vector<uint32_t> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  return sorted == natural_order(n);
}

std::vector<uint32_t> order_of(const Symmetric& a, int pattern = 0xcd) {
  Heap heap;
  heap.allocator.pattern = pattern;
  Array<uint32_t> order(heap.context);
  must(minimum_degree(a.csc(heap.context), &order));
  return {order.begin(), order.end()};
}

size_t fill_of(const Symmetric& a, const std::vector<uint32_t>& order) {
  Heap heap;
  Cholesky factor(heap.context);
  must(factor.analyse(a.csc(heap.context), span(order)));
  return factor.nonzeros();
}

Symmetric shuffled(const Symmetric& a, std::mt19937& random) {
  const std::vector<uint32_t> label = random_order(a.n, random);
  Symmetric b(a.n);
  for (const auto& [place, value] : a.entries)
    b.at(label[place.first], label[place.second]) = value;
  return b;
}

}  // namespace

TEST_CASE("minimum degree: nothing, one column, no entries off the diagonal") {
  CHECK(order_of(Symmetric(0)).empty());
  CHECK(order_of(Symmetric(1)) == std::vector<uint32_t>{0});
  CHECK(is_permutation(order_of(Symmetric(100)), 100));
}

TEST_CASE("minimum degree: a permutation for graphs of every density, connected or not") {
  std::mt19937 random(8);
  for (int round = 0; round < 200; ++round) {
    const uint32_t n = 1 + static_cast<uint32_t>(random() % 120);
    const double degree = 0.2 * (1 + random() % 60);
    const Symmetric a = random_spd(n, degree, random);
    REQUIRE(is_permutation(order_of(a), n));
  }
}

TEST_CASE("minimum degree: trees, paths, stars and cliques are eliminated without fill") {
  std::mt19937 random(9);
  Symmetric tree(500), star(300), cliques(60);
  for (uint32_t i = 1; i < tree.n; ++i) tree.connect(i, static_cast<uint32_t>(random() % i));
  for (uint32_t i = 1; i < star.n; ++i) star.connect(i, 0);
  for (uint32_t i = 0; i < cliques.n; ++i) {
    for (uint32_t j = i - i % 12; j < i; ++j) cliques.connect(i, j);
  }
  for (const Symmetric& a : {tree, path(200), star, cliques}) {
    const Symmetric b = shuffled(a, random);
    CHECK(fill_of(b, order_of(b)) == b.entries.size());
  }
}

TEST_CASE("minimum degree: the exact minimum degree where nothing is approximate") {
  // Two stars joined at their hubs: the hubs, of degree 6 and 9, go after the leaves, and the
  // greater hub cannot go before its own leaves are gone.
  Symmetric a(15);
  for (uint32_t i = 2; i < 7; ++i) a.connect(0, i);
  for (uint32_t i = 7; i < 15; ++i) a.connect(1, i);
  a.connect(0, 1);
  const std::vector<uint32_t> order = order_of(a);
  const auto at = [&](uint32_t i) { return std::find(order.begin(), order.end(), i); };
  for (uint32_t i = 7; i < 13; ++i) CHECK(at(i) < at(1));
  CHECK(fill_of(a, order) == a.entries.size());
}

TEST_CASE(
    "minimum degree: the fill of the paper's authors on square grids, far less than by rows") {
  struct Known {
    uint32_t side;
    size_t laplacian, bilaplacian;  // entries of the factor in the order of AMD 2.4.6
  };
  std::mt19937 random(10);
  for (const Known& known :
       {Known{20, 3702, 9970}, {40, 20771, 61183}, {63, 61949, 227868}, {100, 206332, 611627}}) {
    CAPTURE(known.side);
    const Symmetric laplacian = grid(known.side, known.side);
    for (size_t figure : {known.laplacian, known.bilaplacian}) {
      const Symmetric a = figure == known.laplacian ? laplacian : square(laplacian);
      const size_t fill = fill_of(a, order_of(a));
      CHECK(fill <= 1.15 * figure);
      CHECK(fill <= (known.side < 30 ? 0.7 : 0.55) * fill_of(a, natural_order(a.n)));
      const Symmetric b = shuffled(a, random);
      CHECK(fill_of(b, order_of(b)) <= 1.2 * figure);
    }
  }
}

TEST_CASE("minimum degree: no more fill than nested dissection, whose fill is O(n log n)") {
  for (uint32_t side : {15u, 31u, 63u, 127u}) {
    CAPTURE(side);
    const Symmetric a = grid(side, side);
    std::vector<uint32_t> dissection;
    dissect(0, side, 0, side, side, &dissection);
    const size_t fill = fill_of(a, order_of(a));
    CHECK(fill <= fill_of(a, dissection));
    // George's bound for nested dissection, 31/4 n log2(side) to the leading order.
    CHECK(fill <= 7.75 * a.n * std::log2(side));
  }
}

TEST_CASE("minimum degree: the fill counted is the fill of an elimination played through") {
  std::mt19937 random(11);
  for (int round = 0; round < 20; ++round) {
    const Symmetric a = random_spd(60, 1.0 + 0.3 * round, random);
    const std::vector<uint32_t> order = order_of(a);
    CHECK(fill_of(a, order) == Elimination(a, order).nonzeros());
    CHECK(fill_of(a, order) <= Elimination(a, natural_order(a.n)).nonzeros());
  }
}

TEST_CASE("minimum degree: the same order from fresh memory of any content") {
  std::mt19937 random(12);
  const Symmetric a = random_spd(400, 6.0, random);
  CHECK(order_of(a, 0x00) == order_of(a, 0xff));
}

TEST_CASE("minimum degree: dense rows come last and do not spoil the rest") {
  const uint32_t side = 30, n = side * side;
  Symmetric a(n + 2);
  for (const auto& [place, value] : grid(side, side).entries) a.entries[place] = value;
  for (uint32_t i = 0; i < n; ++i) {
    a.connect(n, i);
    if (i % 2 == 0) a.connect(n + 1, i);
  }
  const std::vector<uint32_t> order = order_of(a);
  REQUIRE(is_permutation(order, n + 2));
  CHECK(order[n] == n);
  CHECK(order[n + 1] == n + 1);
  CHECK(std::vector<uint32_t>(order.begin(), order.begin() + n) == order_of(grid(side, side)));
}

TEST_CASE("minimum degree: every failing allocation and every cancel is a clean status") {
  std::mt19937 random(13);
  const Symmetric a = random_spd(3000, 8.0, random);
  const std::vector<uint32_t> truth = order_of(a);
  for (bool cancel : {false, true}) {
    bool done = false;
    for (size_t k = 0; !done; ++k) {
      REQUIRE(k < 1000);
      Heap heap;
      {
        const Csc lower = a.csc(heap.context);
        Array<uint32_t> order(heap.context);
        if (cancel) {
          heap.cancel_at = k;
        } else {
          heap.allocator.fail_at = heap.allocator.calls + k;
        }
        const Status status = minimum_degree(lower, &order);
        done = status.ok();
        if (done) {
          CHECK(std::equal(order.begin(), order.end(), truth.begin(), truth.end()));
          CHECK(k >= (cancel ? 1 : 10));
        } else {
          CHECK(status.code ==
                (cancel ? wireskin::Code::cancelled : wireskin::Code::out_of_memory));
        }
      }
      CHECK(heap.allocator.clean());
    }
  }
}
