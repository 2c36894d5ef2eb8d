#include "network/rotation.h"

#include <doctest/doctest.h>

#include <string>

#include "support/curve_nets.h"

using namespace unit;
using namespace wireskin::network;

namespace {

// A convex polygon with edges of very different lengths: each of them twice, on opposite sides.
std::vector<Vec3> random_polygon(uint32_t directions, Random& random) {
  std::vector<double> angles;
  for (uint32_t k = 0; k < directions; ++k) {
    angles.push_back(k_pi * (k + 0.4 * random()) / directions);
  }
  std::vector<Vec3> edges;
  for (double a : angles) {
    const double length = std::exp(0.5 * random());
    edges.push_back({length * std::cos(a), length * std::sin(a), 0});
  }
  std::vector<Vec3> polygon;
  Vec3 at;
  for (uint32_t k = 0; k < 2 * directions; ++k) {
    polygon.push_back(at);
    at += (k < directions ? 1.0 : -1.0) * edges[k % directions];
  }
  return polygon;
}

NetCurve border_of(const std::vector<Vec3>& polygon) {
  NetCurve border;
  border.closed = border.boundary = true;
  border.position = polygon;
  border.normal.assign(polygon.size(), Vec3{0, 0, 1});
  return border;
}

}  // namespace

TEST_CASE("rotation: chords of coarse polygons lie inside them, whatever splines do near corners") {
  for (uint32_t seed = 1; seed <= 400; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const std::vector<Vec3> polygon = random_polygon(6 + seed % 7, random);
    const size_t n = polygon.size();
    CurveNet net;
    net.curves.push_back({});
    std::vector<Vec3> border;
    size_t chords = 0;
    for (size_t k = 0; k < n; ++k) {
      border.push_back(polygon[k]);
      if (k % 3 != 0 || k + 2 >= n) continue;
      // From just behind a corner, along the edge at first, to the end of the next edge.
      const Vec3 start = polygon[k] + 0.04 * (polygon[k + 1] - polygon[k]);
      border.push_back(start);
      const Vec3 edge = polygon[k + 1] - polygon[k];
      NetCurve chord;
      chord.position = {start, start + 0.2 * edge + 0.012 * Vec3{-edge.y, edge.x, 0},
                        start + 0.4 * edge + 0.03 * Vec3{-edge.y, edge.x, 0}, polygon[k + 2]};
      chord.normal.assign(4, Vec3{0, 0, 1});
      net.curves.push_back(chord);
      ++chords;
    }
    net.curves[0] = border_of(border);
    const Stages s(net);
    REQUIRE_MESSAGE(s.status.ok(), std::string(s.status.sentence));
    CHECK(s.network.patches() == chords + 1);
  }
}

TEST_CASE("rotation: what is wrong at a node is told of its segments") {
  CurveNet net;
  net.add_circle({0, 0, 0}, 1, true, 48);
  net.add_line({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  net.add_line({0, 0, 0}, {-1, 0, 0}, {0, 0, 1});
  net.add_line({0, 0, 0}, {0, 0, 1}, {0, 0, 1});  // along the normal at both ends
  net.add_line({0, 0, 1}, {1, 0, 0}, {0, 0, 1});
  Stages s(net);
  CHECK_FALSE(s.status.ok());
  Network again(s.heap.context);
  Array<Status> faults(s.heap.context);
  must(find_patches(s.curves, view(s.boundary), s.nodes.span(), &again, &faults));
  REQUIRE(faults.size() == again.segment.size());
  size_t bad = 0;
  for (const Status& status : faults) bad += status.code == Code::tangent_normal;
  CHECK(bad == 4);
}
