#include "flow/straight_lines.h"

#include <doctest/doctest.h>

#include "unit/flow/faces.h"

using namespace unit;
using flow_tests::Net;
using wireskin::k_none;
using wireskin::flow::StraightLines;

namespace {

struct Lines : LinesOf {
  using LinesOf::LinesOf;
  size_t count() const {
    uint32_t most = 0;
    for (const uint32_t line : lines.line_of) {
      if (line != k_none) most = std::max(most, line + 1);
    }
    return most;
  }
  uint32_t sample_at(const Vec3& p) const {
    for (uint32_t v = 0; v < flow.samples.position.size(); ++v) {
      if (length(flow.samples.position[v] - 0.25 * p) < 1e-12) return v;
    }
    return k_none;
  }
};

Net tripod(double bend) {
  Net net;
  const uint32_t middle = net.add({0, 0, 0});
  net.edge(net.add({-1, 0, 0}), middle);
  net.edge(middle, net.add({1, bend, 0}));
  net.edge(middle, net.add({0, 0, 1}));
  return net;
}

}  // namespace

TEST_CASE("the edges of a cube are twelve lines, with nothing common but corners") {
  const Lines cube(prism({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 1.0));
  CHECK(cube.count() == 12);
  const uint32_t a = cube.sample_at({0, 0, 0}), b = cube.sample_at({1, 0, 0});
  const uint32_t c = cube.sample_at({1, 1, 0});
  CHECK(cube.lines.common(a, b) != k_none);
  CHECK(cube.lines.common(a, c) == k_none);
  CHECK(cube.lines.common(a, b, c) == k_none);
}

TEST_CASE("arcs that go on without a bend are one line") {
  const Lines straight(tripod(0.0));
  CHECK(straight.count() == 2);
  const uint32_t a = straight.sample_at({-1, 0, 0}), b = straight.sample_at({1, 0, 0});
  const uint32_t middle = straight.sample_at({0, 0, 0}), top = straight.sample_at({0, 0, 1});
  CHECK(straight.lines.common(a, middle, b) != k_none);
  CHECK(straight.lines.common(a, top) == k_none);
  CHECK(straight.lines.common(middle, top) != k_none);
  CHECK(Lines(tripod(0.01)).count() == 3);
}

TEST_CASE("bent arcs are no lines") {
  Net net = tripod(0.0);
  std::vector<uint32_t> arc;
  for (int i = 0; i <= 16; ++i) {
    const double t = 0.1 * i;
    arc.push_back(net.add({2 + std::cos(t), std::sin(t), 0}));
  }
  net.curve.push_back(arc);
  const Lines lines(net);
  CHECK(lines.count() == 2);
  size_t bent = 0;
  for (const uint32_t line : lines.lines.line_of) bent += line == k_none;
  CHECK(bent == 1);
}
