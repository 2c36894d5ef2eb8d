#include "network/side_normals.h"

#include <doctest/doctest.h>

#include "curves/sides.h"
#include "network/plane.h"
#include "support/curve_nets.h"

using namespace unit;
using namespace wireskin::network;
using wireskin::curves::fit_right_normals;

namespace {

// A square in two halves: normals lean to the left in the left half, the ridge x = 0 is sharp.
struct Ridge : Stages {
  std::vector<Vec3> right;
  std::vector<uint8_t> sharp;

  static CurveNet net() {
    const Vec3 left = {-0.6, 0, 0.8}, right = {0.6, 0, 0.8};
    CurveNet n;
    n.add_line({0, -1, 0}, {0, 1, 0}, left);
    n.add_line({0, -1, 0}, {1, -1, -0.75}, right, true);
    n.add_line({1, -1, -0.75}, {1, 1, -0.75}, right, true);
    n.add_line({1, 1, -0.75}, {0, 1, 0}, right, true);
    n.add_line({0, 1, 0}, {-1, 1, -0.75}, left, true);
    n.add_line({-1, 1, -0.75}, {-1, -1, -0.75}, left, true);
    n.add_line({-1, -1, -0.75}, {0, -1, 0}, left, true);
    return n;
  }
  Ridge() : Stages(net()) {
    must(status);
    right.assign(position.size(), Vec3{});
    for (size_t i = start[0]; i < start[1]; ++i) right[i] = {0.6, 0, 0.8};
    sharp.assign(7, 0);
    sharp[0] = 1;
    must(fit_right_normals({view(start), view(right), view(sharp)}, &curves));
    REQUIRE(resample(0.2));
  }
};

}  // namespace

TEST_CASE("side normals: each side has its own, the vertices of the ridge the mean") {
  const Ridge r;
  REQUIRE(r.vertices.side_start.size() == r.network.segment.size() + 1);
  for (uint32_t s = 0; s < r.network.segment.size(); ++s) {
    for (uint32_t k = 1; k < r.vertices.edges[s]; ++k) {
      const uint32_t entry = r.vertices.side_start[s] + k;
      const Vec3 left = r.vertices.left[entry], right = r.vertices.right[entry];
      const Vec3 mean = r.vertices.normal[segment_vertex(r.network, r.vertices, s, k)];
      if (r.network.segment[s].curve == 0) {
        // The ends of the curve took the mean of their nodes, so only its middle is exact.
        CHECK(right.x == doctest::Approx(0.6));
        if (4 * k > r.vertices.edges[s] && 4 * k < 3 * r.vertices.edges[s]) {
          CHECK(left.x == doctest::Approx(-0.6).epsilon(1e-2));
          CHECK(wireskin::length(mean - Vec3{0, 0, 1}) < 1e-2);
        }
      } else {
        CHECK(left == right);
        CHECK(left == mean);
      }
    }
  }
}

TEST_CASE("side normals: a patch's border has those of its own side, at the same places") {
  Ridge r;
  Border border(r.heap.context);
  REQUIRE(r.network.patches() == 2);
  for (uint32_t p = 0; p < 2; ++p) {
    must(border_of_patch(r.network, r.vertices, p, &border));
    REQUIRE(border.normal.size() == border.size());
    double side = 0.0;
    for (const Vec3& at : border.position) side += at.x;
    for (size_t i = 0; i < border.size(); ++i) {
      if (std::fabs(border.position[i].y) < 0.5) CHECK(border.normal[i].x * side > 0.0);
    }
    Plane plane;
    must(fit_plane(border, &plane));
    CHECK(plane.normal.x * side > 0.0);
  }
}

TEST_CASE("side normals: a smooth network has those of its vertices") {
  Stages s(octant_net());
  REQUIRE(s.resample(0.2));
  Border border(s.heap.context);
  for (uint32_t p = 0; p < s.network.patches(); ++p) {
    must(border_of_patch(s.network, s.vertices, p, &border));
    REQUIRE(border.normal.size() == border.size());
    for (uint32_t i = 0; i < border.size(); ++i) {
      CHECK(border.normal[i] == s.vertices.normal[border.vertex[i]]);
      CHECK(border.position[i] == s.vertices.position[border.vertex[i]]);
      CHECK(next_on_border(border, 0, i) == (i + 1) % border.size());
    }
  }
}
