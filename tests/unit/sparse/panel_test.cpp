#include "sparse/panel.h"

#include <doctest/doctest.h>

#include <vector>

#include "support/context.h"

using namespace wireskin::sparse;
using unit::Code;
using unit::Heap;
using unit::must;
using unit::Random;
using unit::Status;

namespace {

// A front of `height` rows whose first `width` columns are eliminated, with room for the kernels.
struct Front {
  uint32_t height, width;
  std::vector<double> value, update, scratch;
  DenseKernels kernels = dense_kernels(best_instructions());

  // A diagonal that dominates makes every pivot positive.
  Front(uint32_t rows, uint32_t columns, uint32_t seed)
      : height(rows),
        width(columns),
        value(trapezoid_size(round_up_rows(rows), columns) + 4),
        update(size_t{round_up_rows(rows - columns)} * (rows - columns)),
        scratch(16 * k_update_scratch) {
    Random random(seed);
    for (double& v : value) v = random();
    for (double& v : update) v = random();
    const Panel all = panel(false);
    for (uint32_t j = 0; j < width; ++j) *all.at(j, j) = 4.0 * height;
  }
  Panel panel(bool first) { return {value.data(), height, width, update.data(), first}; }
  PanelTools tools(uint32_t slots) { return {&kernels, scratch.data(), slots}; }
  // What a factor defines: entries on and below the diagonal.
  std::vector<double> result() {
    std::vector<double> entries;
    const Panel all = panel(false);
    const uint32_t tail = all.tail();
    for (uint32_t j = 0; j < width; ++j)
      entries.insert(entries.end(), all.at(j, j), all.at(height, j));
    for (uint32_t j = 0; j < tail; ++j) {
      const double* column = update.data() + size_t{j} * round_up_rows(tail);
      entries.insert(entries.end(), column + j, column + tail);
    }
    return entries;
  }
};

struct Shape {
  uint32_t height, width;
};

// Of the second one a few columns of the update are so much work that parts are cut of their rows
// and terms.
constexpr Shape k_shapes[] = {{700, 130}, {1702, 530}, {301, 301}};

}  // namespace

TEST_CASE("panel: the factor and the update of a small one, by hand") {
  Front front(3, 2, 1);
  const Panel panel = front.panel(true);
  // L = (2, 1, 4; 3, -1), and the row below leaves -(16 + 1).
  *panel.at(0, 0) = 4.0, *panel.at(1, 0) = 2.0, *panel.at(2, 0) = 8.0;
  *panel.at(1, 1) = 10.0, *panel.at(2, 1) = 1.0;
  CHECK(factor_panel(front.tools(1), panel) == wireskin::k_none);
  CHECK(front.result() == std::vector<double>{2.0, 1.0, 4.0, 3.0, -1.0, -17.0});
}

TEST_CASE("panel: parts have the bits of the whole") {
  for (const Shape& shape : k_shapes) {
    for (const bool first : {false, true}) {
      Front whole(shape.height, shape.width, 5);
      CHECK(factor_panel(whole.tools(1), whole.panel(first)) == wireskin::k_none);
      for (const uint32_t slots : {1u, 3u, 16u}) {
        Heap heap;
        Front parts(shape.height, shape.width, 5);
        uint32_t bad = 0;
        must(factor_panel_in_parts(heap.context, parts.tools(slots), parts.panel(first), &bad));
        CHECK(bad == wireskin::k_none);
        CHECK(parts.result() == whole.result());
      }
    }
  }
}

TEST_CASE("panel: there are checkpoints in proportion to the work, and each one may cancel") {
  Heap heap;
  const Shape& shape = k_shapes[1];
  Front front(shape.height, shape.width, 7);
  uint32_t bad = 0;
  must(factor_panel_in_parts(heap.context, front.tools(1), front.panel(true), &bad));
  const double tail = shape.height - shape.width;
  CHECK(static_cast<double>(heap.checkpoints) > 0.5 * tail * tail * shape.width / 3e7);
  const size_t all = heap.checkpoints;
  for (size_t k = 0; k < all; k += all / 7) {
    heap.checkpoints = 0;
    heap.cancel_at = k;
    Front again(shape.height, shape.width, 7);
    const Status status =
        factor_panel_in_parts(heap.context, again.tools(1), again.panel(true), &bad);
    CHECK(status.code == Code::cancelled);
    CHECK(heap.checkpoints == k + 1);
  }
}

TEST_CASE("panel: the first bad column is the same in parts") {
  for (const uint32_t column : {0u, 5u, 64u, 129u}) {
    const Shape& shape = k_shapes[0];
    Front whole(shape.height, shape.width, 9), parts(shape.height, shape.width, 9);
    *whole.panel(true).at(column, column) = *parts.panel(true).at(column, column) = -1.0;
    CHECK(factor_panel(whole.tools(1), whole.panel(true)) == column);
    Heap heap;
    uint32_t bad = 0;
    must(factor_panel_in_parts(heap.context, parts.tools(1), parts.panel(true), &bad));
    CHECK(bad == column);
  }
}
