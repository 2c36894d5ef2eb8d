#include "sparse/supernodes.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "matrices.h"
#include "sparse/elimination_tree.h"

using namespace matrices;
using namespace wireskin::sparse;

namespace {

// Supernodes of `a` in an order that is already a postorder of its tree.
void find(const Symmetric& a, Heap& heap, Supernodes* result) {
  const std::vector<uint32_t> order = natural_order(a.n);
  const Csc csc = a.csc(heap.context);
  Pattern lower(heap.context), upper(heap.context);
  Array<uint32_t> parent(heap.context), count(heap.context);
  must(permute_pattern(csc, span(order), Triangle::upper, &upper));
  must(permute_pattern(csc, span(order), Triangle::lower, &lower));
  must(elimination_tree(upper, &parent));
  must(column_counts(lower, parent.span(), &count));
  must(find_supernodes(lower, parent.span(), count.span(), result));
}

Symmetric permuted(const Symmetric& a, const std::vector<uint32_t>& order) {
  std::vector<uint32_t> position(a.n);
  for (uint32_t k = 0; k < a.n; ++k) position[order[k]] = k;
  Symmetric b(a.n);
  for (const auto& [place, value] : a.entries) {
    b.at(position[place.first], position[place.second]) = value;
  }
  return b;
}

void check_invariants(const Supernodes& s, uint32_t n) {
  REQUIRE(s.first[0] == 0);
  REQUIRE(s.first[s.count] == n);
  for (uint32_t k = 0; k < s.count; ++k) {
    REQUIRE(s.width(k) > 0);
    REQUIRE(s.panel[k + 1] - s.panel[k] ==
            trapezoid_size(s.column_step(k), s.width(k)) + k_panel_margin);
    for (uint32_t r = 0; r < s.width(k); ++r) {
      REQUIRE(s.rows(k)[r] == s.first[k] + r);
      REQUIRE(s.of_column[s.first[k] + r] == k);
    }
    for (uint32_t r = 1; r < s.height(k); ++r) REQUIRE(s.rows(k)[r - 1] < s.rows(k)[r]);
  }
}

}  // namespace

TEST_CASE("supernodes: a full matrix is one, a diagonal one is n") {
  Heap heap;
  Symmetric full(20);
  for (uint32_t i = 0; i < 20; ++i) {
    for (uint32_t j = 0; j < i; ++j) full.connect(i, j);
  }
  Supernodes s(heap.context), d(heap.context), none(heap.context);
  find(full, heap, &s);
  CHECK(s.count == 1);
  CHECK(s.height(0) == 20);
  find(Symmetric(20), heap, &d);
  CHECK(d.count == 20);
  CHECK(d.row.size() == 20);
  find(Symmetric(0), heap, &none);
  CHECK(none.count == 0);
}

TEST_CASE("supernodes: the rows hold the factor's structure and not much more") {
  std::mt19937 random(7);
  for (int round = 0; round < 40; ++round) {
    Heap heap;
    const uint32_t side = 2 + static_cast<uint32_t>(random() % 14);
    std::vector<uint32_t> order;
    dissect(0, side, 0, side, side, &order);
    const Symmetric a = round % 2 == 0 ? permuted(grid(side, side), order)
                                       : permuted(square(grid(side, side)), order);
    Supernodes s(heap.context);
    find(a, heap, &s);
    check_invariants(s, a.n);
    const Elimination truth(a, natural_order(a.n));
    size_t stored = 0;
    for (uint32_t j = 0; j < a.n; ++j) {
      const uint32_t k = s.of_column[j];
      const std::vector<uint32_t>& column = truth.columns[j];
      REQUIRE(std::includes(s.rows(k), s.rows(k) + s.height(k), column.begin(), column.end()));
      // The rows below a supernode are exactly those of its last column.
      if (j + 1 == s.first[k + 1]) REQUIRE(s.height(k) - s.width(k) + 1 == column.size());
      stored += s.height(k) - (j - s.first[k]);
    }
    CHECK(stored >= truth.nonzeros());
    CHECK(stored <= 2 * truth.nonzeros());
  }
}
