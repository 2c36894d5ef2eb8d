#include "network/box_tree.h"

#include <doctest/doctest.h>

#include "base/in_parts.h"
#include "support/context.h"

using namespace unit;
using wireskin::network::Box;
using wireskin::network::BoxTree;

namespace {

bool meet(const Box& a, const Box& b) {
  const double* low_a = &a.low.x;
  const double* low_b = &b.low.x;
  const double* high_a = &a.high.x;
  const double* high_b = &b.high.x;
  for (int k = 0; k < 3; ++k) {
    if (low_a[k] > high_b[k] || low_b[k] > high_a[k]) return false;
  }
  return true;
}

size_t count_wrong(const std::vector<Box>& boxes) {
  Heap heap;
  BoxTree tree(heap.context);
  Array<uint32_t> found(heap.context);
  must(tree.build({boxes.data(), boxes.size()}));
  size_t wrong = 0;
  for (uint32_t i = 0; i < boxes.size(); ++i) {
    must(tree.find(boxes[i], i, &found));
    std::vector<uint32_t> expected;
    for (uint32_t j = i + 1; j < boxes.size(); ++j) {
      if (meet(boxes[i], boxes[j])) expected.push_back(j);
    }
    wrong += std::vector<uint32_t>(found.begin(), found.end()) != expected;
  }
  return wrong;
}

}  // namespace

TEST_CASE("a tree of boxes finds those that meet a box, and no others") {
  std::mt19937 random(3);
  const auto number = [&] { return random() / 4294967296.0; };
  for (const size_t count : {0, 1, 7, 8, 9, 16, 17, 100, 1000}) {
    for (const double size : {0.0, 0.01, 0.3}) {
      std::vector<Box> boxes;
      for (size_t i = 0; i < count; ++i) {
        const Vec3 low = {number(), number(), number()};
        boxes.push_back({low, low + size * Vec3{number(), number(), number()}});
      }
      CHECK(count_wrong(boxes) == 0);
    }
  }
}

// Keys that rise and fall are the worst for a pivot in the middle.
TEST_CASE("a tree of boxes: a tent of a hundred thousand") {
  constexpr uint32_t k_half = 50000;
  std::vector<Box> boxes;
  for (uint32_t i = 0; i < 2 * k_half; ++i) {
    const double x = i < k_half ? 2 * i : 4 * k_half - 1 - 2 * i;
    boxes.push_back({{x, 0, 0}, {x, 0, 0}});
  }
  Heap heap;
  BoxTree tree(heap.context);
  Array<uint32_t> found(heap.context);
  must(tree.build({boxes.data(), boxes.size()}));
  // Some hundred for the passes over ranges that are halved, and one for each pivot of a long one,
  // of which there would be tens of thousands.
  CHECK(heap.checkpoints < 1000 * 4096 / wireskin::k_steps_per_checkpoint);
  must(tree.find({{1000, 0, 0}, {1003, 0, 0}}, 0, &found));
  CHECK(to_vector(found) == std::vector<uint32_t>{500, 501, 2 * k_half - 502, 2 * k_half - 501});
}

TEST_CASE("a tree of boxes: on a lattice, all alike, one far out, one round all") {
  std::mt19937 random(5);
  std::vector<Box> lattice, alike(300, Box{{1, 2, 3}, {1, 2, 4}}), far;
  for (int i = 0; i < 500; ++i) {
    const auto number = [&] { return double(random() % 5); };
    const Vec3 low = {number(), number(), number()};
    lattice.push_back({low, low + Vec3{number(), 0, number()}});
  }
  CHECK(count_wrong(lattice) == 0);
  CHECK(count_wrong(alike) == 0);
  far = lattice;
  far[250] = {{-1e300, 0, 0}, {1e300, 1e-300, 0}};
  far[260] = {{1e200, 1e200, 1e200}, {1e250, 1e250, 1e250}};
  far.push_back({{-1e300, -1e300, -1e300}, {1e300, 1e300, 1e300}});
  CHECK(count_wrong(far) == 0);
}
