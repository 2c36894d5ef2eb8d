#include "network/plane.h"

#include <doctest/doctest.h>

#include <set>

#include "support/curve_nets.h"

using namespace unit;
using namespace wireskin::network;
using wireskin::cross;
using wireskin::dot;
using wireskin::length;

namespace {

struct Fit {
  Heap heap;
  Border border{heap.context};
  Plane plane;
  Status status;

  Fit(const std::vector<Vec3>& positions, const std::vector<Vec3>& normals) {
    must(border.position.copy(view(positions)));
    must(border.normal.copy(view(normals)));
    must(border.start.push(0));
    for (uint32_t v = 0; v < positions.size(); ++v) must(border.vertex.push(v));
    must(border.start.push(border.size()));
    status = fit_plane(border, &plane);
  }
};

void check_frame(const Plane& p) {
  for (const Vec3& a : {p.u, p.v, p.normal})
    CHECK(length(a) == doctest::Approx(1.0).epsilon(1e-14));
  CHECK(length(cross(p.u, p.v) - p.normal) < 1e-14);
}

}  // namespace

TEST_CASE("plane: through the mean position across the mean normal, from the first vertex") {
  const Vec3 n = wireskin::unit({1, 2, 3});
  const Fit f({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {n, n, n});
  REQUIRE(f.status.ok());
  check_frame(f.plane);
  CHECK(length(f.plane.origin - Vec3{1. / 3, 1. / 3, 1. / 3}) < 1e-15);
  CHECK(length(f.plane.normal - n) < 1e-15);
  const Vec2 first = f.plane.project({1, 0, 0});
  CHECK(first.x > 0.5);
  CHECK(std::fabs(first.y) < 1e-15);
  const Vec3 p = {3, -1, 2};
  const Vec2 q = f.plane.project(p);
  const Vec3 back = f.plane.origin + q.x * f.plane.u + q.y * f.plane.v + f.plane.height(p) * n;
  CHECK(length(back - p) < 1e-14);
}

TEST_CASE("plane: normals that cancel out have none") {
  const Fit f({{1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {0, 0, -1}});
  CHECK(f.status.code == Code::patch_without_plane);
  const Fit nearly({{1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, wireskin::unit({0.08, 0, -1})});
  CHECK(nearly.status.code == Code::patch_without_plane);
  const Fit enough({{1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, wireskin::unit({0.4, 0, -1})});
  CHECK(enough.status.ok());
}

// Rounding leaves a small vector of any direction there, even along the normal.
TEST_CASE("plane: a first vertex above or in the mean still gives a frame") {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    Vec3 n = wireskin::unit({random(), random(), random()});
    if (i % 4 == 0) n = wireskin::unit({1, 1e-9 * random(), 1e-17 * random()});
    const Vec3 u = wireskin::unit(cross(n, {random(), random(), random()}));
    const Vec3 middle = 10.0 * Vec3{random(), random(), random()};
    const Fit f({middle + (i % 2) * n, middle + u, middle - u - (i % 2) * n}, {n, n, n});
    REQUIRE(f.status.ok());
    check_frame(f.plane);
  }
}

TEST_CASE("plane: borders run counter-clockwise along their half-segments") {
  Stages s(octant_net());
  REQUIRE(s.resample(0.2));
  Border border(s.heap.context);
  for (uint32_t p = 0; p < s.network.patches(); ++p) {
    must(border_of_patch(s.network, s.vertices, p, &border));
    CHECK(border.size() == 24);
    Plane plane;
    must(fit_plane(border, &plane));
    check_frame(plane);
    double area = 0.0;
    for (size_t i = 0; i < border.size(); ++i) {
      const Vec2 a = plane.project(border.position[i]);
      const Vec2 b = plane.project(border.position[(i + 1) % border.size()]);
      area += 0.5 * cross(a, b);
    }
    CHECK(area > 0.5);
    CHECK(std::set<uint32_t>(border.vertex.begin(), border.vertex.end()).size() == border.size());
  }
}
