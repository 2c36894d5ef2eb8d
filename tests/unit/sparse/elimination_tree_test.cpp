#include "sparse/elimination_tree.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "matrices.h"

using namespace matrices;
using namespace wireskin::sparse;

namespace {

std::vector<uint32_t> tree_of(const Symmetric& a, const std::vector<uint32_t>& order, Heap& heap) {
  const Csc lower = a.csc(heap.context);
  std::vector<uint32_t> position(a.n);
  for (uint32_t k = 0; k < a.n; ++k) position[order[k]] = k;
  Pattern upper(heap.context);
  must(permute_pattern(lower, span(std::as_const(position)), Triangle::upper, &upper));
  Array<uint32_t> parent(heap.context);
  must(elimination_tree(upper, &parent));
  return {parent.begin(), parent.end()};
}

std::vector<uint32_t> postorder_of(const std::vector<uint32_t>& parent, Heap& heap) {
  Array<uint32_t> order(heap.context);
  must(postorder(span(parent), &order));
  return {order.begin(), order.end()};
}

// A random matrix whose columns stand in postorder, as column_counts() wants them.
Symmetric in_postorder(const Symmetric& a, Heap& heap) {
  const std::vector<uint32_t> order = postorder_of(tree_of(a, natural_order(a.n), heap), heap);
  std::vector<uint32_t> position(a.n);
  for (uint32_t k = 0; k < a.n; ++k) position[order[k]] = k;
  Symmetric b(a.n);
  for (const auto& [place, value] : a.entries) {
    b.at(position[place.first], position[place.second]) = value;
  }
  return b;
}

}  // namespace

TEST_CASE("elimination tree: a path is a chain, an arrow with its hub last is a star") {
  Heap heap;
  CHECK(tree_of(path(4), natural_order(4), heap) ==
        std::vector<uint32_t>{1, 2, 3, wireskin::k_none});
  Symmetric arrow(4);
  for (uint32_t i = 0; i < 3; ++i) arrow.connect(i, 3);
  CHECK(tree_of(arrow, natural_order(4), heap) == std::vector<uint32_t>{3, 3, 3, wireskin::k_none});
  CHECK(tree_of(Symmetric(2), natural_order(2), heap) ==
        std::vector<uint32_t>{wireskin::k_none, wireskin::k_none});
  CHECK(tree_of(Symmetric(0), {}, heap).empty());
}

TEST_CASE("elimination tree: parents are those of an elimination played through") {
  std::mt19937 random(4);
  for (int round = 0; round < 60; ++round) {
    Heap heap;
    const uint32_t n = 1 + static_cast<uint32_t>(random() % 40);
    const Symmetric a = random_spd(n, 0.5 + 0.1 * round, random);
    const std::vector<uint32_t> order = random_order(n, random);
    const std::vector<uint32_t> parent = tree_of(a, order, heap);
    const Elimination truth(a, order);
    for (uint32_t j = 0; j < n; ++j) {
      const bool root = truth.columns[j].size() == 1;
      REQUIRE(parent[j] == (root ? wireskin::k_none : truth.columns[j][1]));
    }
  }
}

TEST_CASE("postorder: children before parents, subtrees contiguous") {
  std::mt19937 random(5);
  for (int round = 0; round < 60; ++round) {
    Heap heap;
    const uint32_t n = static_cast<uint32_t>(random() % 50);
    std::vector<uint32_t> parent(n, wireskin::k_none);
    for (uint32_t j = 0; j + 1 < n; ++j) {
      if (random() % 8 != 0) parent[j] = j + 1 + static_cast<uint32_t>(random() % (n - j - 1));
    }
    const std::vector<uint32_t> order = postorder_of(parent, heap);
    REQUIRE(order.size() == n);
    std::vector<uint32_t> position(n, wireskin::k_none), size(n, 1);
    for (uint32_t k = 0; k < n; ++k) position[order[k]] = k;
    REQUIRE(std::count(position.begin(), position.end(), wireskin::k_none) == 0);
    for (uint32_t j = 0; j < n; ++j) {
      if (parent[j] != wireskin::k_none) size[parent[j]] += size[j];
    }
    for (uint32_t j = 0; j < n; ++j) {
      for (uint32_t i = j; i != wireskin::k_none; i = parent[i]) {
        REQUIRE(position[j] <= position[i]);
        REQUIRE(position[j] + size[i] > position[i]);
      }
    }
  }
}

TEST_CASE("column counts: those of an elimination played through") {
  std::mt19937 random(6);
  for (int round = 0; round < 100; ++round) {
    Heap heap;
    const uint32_t n = 1 + static_cast<uint32_t>(random() % 40);
    const Symmetric a = in_postorder(random_spd(n, 0.5 + 0.06 * round, random), heap);
    const std::vector<uint32_t> order = natural_order(n);
    const std::vector<uint32_t> parent = tree_of(a, order, heap);
    Pattern lower(heap.context);
    Array<uint32_t> count(heap.context);
    must(permute_pattern(a.csc(heap.context), span(order), Triangle::lower, &lower));
    must(column_counts(lower, span(parent), &count));
    const Elimination truth(a, order);
    for (uint32_t j = 0; j < n; ++j) REQUIRE(count[j] == truth.columns[j].size());
  }
}
