#include "smooth/fair.h"

#include <doctest/doctest.h>

#include <vector>

#include "support/context.h"

using namespace unit;
using wireskin::smooth::fair;
using wireskin::smooth::FairMesh;
using wireskin::smooth::FairOptions;
using wireskin::smooth::FairReport;

namespace {

constexpr uint32_t k_side = 4;

// A saddle over four by four squares, its border held, with a curve in the middle between two
// patches; the second row of squares is so high.
struct Saddle {
  std::vector<Vec3> position, normal;
  std::vector<uint32_t> triangle, patch;
  std::vector<uint8_t> held, on_border, guarded{0, 0};
  FairReport report;

  explicit Saddle(double second_row) {
    for (uint32_t j = 0; j <= k_side; ++j) {
      for (uint32_t i = 0; i <= k_side; ++i) {
        const double x = i, y = j < 2 ? j : j - 1 + second_row;
        const bool rim = i % k_side == 0 || j % k_side == 0;
        position.push_back({x, y, (x * x - y * y) / 16});
        normal.push_back(wireskin::unit(Vec3{(2 - x) / 8, (2 - y) / 8, 1}));
        held.push_back(rim || i == k_side / 2);
        on_border.push_back(rim);
      }
    }
    for (uint32_t j = 0; j < k_side; ++j) {
      for (uint32_t i = 0; i < k_side; ++i) {
        const uint32_t a = j * (k_side + 1) + i, b = a + 1, d = a + k_side + 1, c = d + 1;
        triangle.insert(triangle.end(), {a, b, c, a, c, d});
        patch.insert(patch.end(), 2, i < k_side / 2 ? 0 : 1);
      }
    }
  }
  void smooth(int displacement_steps) {
    Heap heap;
    FairMesh mesh;
    mesh.position = unit::span(position);
    mesh.normal = unit::span(normal);
    mesh.triangle = unit::span(triangle);
    mesh.patch = view(patch);
    mesh.on_curve = mesh.held = view(held);
    mesh.on_border = view(on_border);
    mesh.guarded = unit::span(guarded);
    FairOptions options;
    options.displacement_steps = displacement_steps;
    must(fair(heap.context, mesh, 2, options, &report));
  }
};

}  // namespace

TEST_CASE("fair: where a displacement step is singular all patches keep what they had") {
  for (const double second_row : {1.0, 0x1p-34}) {
    CAPTURE(second_row);
    Saddle before(second_row), after(second_row);
    before.smooth(0);
    after.smooth(6);
    const bool singular = second_row < 1.0;
    CHECK((after.report.factorisations == 0) == singular);
    CHECK(after.report.guarded_patches == (singular ? 2 : 0));
    CHECK(after.guarded == std::vector<uint8_t>(2, singular));
    CHECK((after.position == before.position) == singular);
    if (singular) CHECK(after.triangle == before.triangle);
  }
}
