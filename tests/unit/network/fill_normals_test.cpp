#include "network/fill_normals.h"

#include <doctest/doctest.h>

#include <cmath>

#include "num/trig.h"
#include "support/wire_nets.h"

using namespace wireskin;
using namespace wireskin::network;
using namespace unit;

// Points of a quarter circle on the unit sphere, where the normal is the point.
static std::vector<Vec3> arc(Vec3 from, Vec3 to, uint32_t n) {
  std::vector<Vec3> points;
  for (uint32_t i = 0; i <= n; ++i) {
    const double a = 0.5 * k_pi * i / n;
    points.push_back(i == 0 ? from : i == n ? to : std::cos(a) * from + std::sin(a) * to);
  }
  return points;
}

static void keep_every(std::vector<Vec3>& normals, size_t step, size_t first) {
  for (size_t i = 0; i < normals.size(); ++i) {
    if (i % step != first) normals[i] = Vec3{};
  }
}

TEST_CASE("sparse normals on a sphere are filled exactly, beyond the last ones too") {
  for (const size_t step : {2u, 5u, 19u}) {
    WireNet net;
    const std::vector<Vec3> points = arc({1, 0, 0}, {0, 1, 0}, 20);
    std::vector<Vec3> normals = points;
    keep_every(normals, step, 1);
    net.add(points, false, normals);
    net.weld();
    FillCounts counts;
    must(fill_along(&net.wires, &counts));
    for (uint32_t i = 0; i <= 20; ++i) CHECK(length(net.wires.normal[i] - points[i]) < 1e-13);
    size_t given = 0;
    for (const Vec3& m : normals) given += m != Vec3{};
    CHECK(counts.filled == 21 - given);
  }
}

TEST_CASE("a closed curve is filled from one normal") {
  WireNet net;
  std::vector<Vec3> points, normals(12);
  for (int i = 0; i < 12; ++i) {
    points.push_back({std::cos(k_pi * i / 6), std::sin(k_pi * i / 6), 0});
  }
  normals[5] = points[5];
  net.add(points, true, normals);
  net.weld();
  FillCounts counts;
  must(fill_along(&net.wires, &counts));
  for (uint32_t i = 0; i < 12; ++i) CHECK(length(net.wires.normal[i] - points[i]) < 1e-13);
}

TEST_CASE("a curve without normals takes those of both its ends, or stays without") {
  WireNet net;
  const Vec3 x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
  net.add(arc(x, y, 8), false, arc(x, y, 8));
  net.add(arc(y, z, 8), false, arc(y, z, 8));
  net.add(arc(z, x, 8));
  net.add({y, {0, 2, 0}, {0, 3, 0}});
  net.weld();
  FillCounts counts;
  must(fill_from_nodes(&net.wires, &counts));
  for (uint32_t i = net.wires.start[2]; i < net.wires.start[3]; ++i) {
    CHECK(length(net.wires.normal[i] - net.wires.position[i]) < 1e-13);
  }
  for (uint32_t i = net.wires.start[3]; i < net.wires.samples(); ++i) {
    CHECK(net.wires.normal[i] == Vec3{});
  }
  CHECK(counts.missing == 1);
  CHECK(counts.filled == 9);
}

TEST_CASE("new joints get the mean, old ones keep theirs, contradictions are named") {
  for (const uint8_t joined : {0, 1}) {
    WireNet net;
    const double angle = joined ? 0.2 : 1.8;
    const Vec3 tilted = {std::sin(angle), 0, std::cos(angle)};
    net.add(line({0, 0, 0}, {1, 0, 0}, 3), false, std::vector<Vec3>(4, Vec3{0, 0, 1}));
    net.add(line({0, 0, 0}, {0, 1, 0}, 3), false, std::vector<Vec3>(4, tilted));
    net.weld();
    std::vector<uint8_t> flags(net.wires.points, joined);
    Array<Contradiction> contradictions(net.heap.context);
    must(reconcile_normals(view(flags), &net.wires, &contradictions));
    if (joined) {
      CHECK(contradictions.empty());
      CHECK(net.wires.normal[0] == net.wires.normal[4]);
      CHECK(angle_between(net.wires.normal[0], tilted) == doctest::Approx(0.1));
    } else {
      CHECK(contradictions.size() == 2);
      CHECK(contradictions[0].angle == doctest::Approx(1.8));
      CHECK(net.wires.normal[4] == tilted);
    }
  }
}
