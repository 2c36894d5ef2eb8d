#include "network/resample.h"

#include <doctest/doctest.h>

#include "support/curve_nets.h"

using namespace unit;
using namespace wireskin::network;
using wireskin::length;

TEST_CASE("resample: the number of edges nearest to length over spacing") {
  const double quarter = 0.5 * k_pi;
  for (double wished : {1.0, 6.4, 6.6, 62.0, 1000.2}) {
    Stages s(octant_net());
    REQUIRE(s.resample(quarter / wished));
    for (uint32_t e : s.vertices.edges) CHECK(e == static_cast<uint32_t>(wished + 0.5));
    CHECK(s.vertices.length == doctest::Approx(6 * k_pi).epsilon(1e-5));
  }
  Stages s(octant_net());
  REQUIRE(s.resample(quarter / 62));
  CHECK(s.vertices.position.size() == 738);
}

TEST_CASE("resample: vertices divide every segment evenly, nodes stay bit for bit") {
  for (const CurveNet& net : {octant_net(), torus_net(3, 2), saddle_net(), cylinder_net(3)}) {
    Stages s(net);
    REQUIRE(s.resample(0.11));
    const CurveVertices& v = s.vertices;
    for (uint32_t i = 0; i < s.nodes.size(); ++i) {
      CHECK(v.position[i] == s.nodes[i].position);
      CHECK(v.normal[i] == s.nodes[i].normal);
    }
    std::vector<int> met(v.position.size(), 0);
    for (uint32_t k = 0; k < s.network.segment.size(); ++k) {
      const Segment& segment = s.network.segment[k];
      CHECK(segment_vertex(s.network, v, k, 0) == segment.from);
      CHECK(segment_vertex(s.network, v, k, v.edges[k]) == segment.to);
      double least = 1e9, most = 0.0;
      for (uint32_t e = 0; e < v.edges[k]; ++e) {
        const uint32_t a = segment_vertex(s.network, v, k, e);
        const double edge =
            length(v.position[segment_vertex(s.network, v, k, e + 1)] - v.position[a]);
        least = std::fmin(least, edge);
        most = std::fmax(most, edge);
        if (e > 0) ++met[a];
        CHECK(v.curve[a] <= segment.curve);
        if (e > 0) CHECK(v.curve[a] == segment.curve);
        CHECK(length(v.normal[a]) == doctest::Approx(1.0).epsilon(1e-14));
      }
      CHECK(most < 1.01 * least);  // chords of equal arcs
      CHECK(most < 0.11 * 1.5);
    }
    for (size_t i = 0; i < met.size(); ++i) CHECK(met[i] == (i < s.nodes.size() ? 0 : 1));
  }
}

TEST_CASE("resample: closed curves without node go round once") {
  CurveNet net;
  net.add_circle({}, 1, true);
  Stages s(net);
  REQUIRE(s.resample(2 * k_pi / 20));
  REQUIRE(s.vertices.position.size() == 20);
  CHECK(segment_vertex(s.network, s.vertices, 0, 20) ==
        segment_vertex(s.network, s.vertices, 0, 0));
  for (uint32_t k = 0; k < 20; ++k) {
    const Vec3 exact = {std::cos(2 * k_pi * k / 20), std::sin(2 * k_pi * k / 20), 0};
    CHECK(length(s.vertices.position[k] - exact) < 1e-5);
  }
  CHECK(s.vertices.position[0] == net.curves[0].position[0]);
}

TEST_CASE("resample: enough edges that no two segments share one") {
  CurveNet loop;  // an eight: each lobe returns to its node
  loop.add_circle({-1, 0, 0}, 1, true, 48, 0.0);
  loop.add_circle({1, 0, 0}, 1, true, 48, k_pi);
  Stages eight(loop);
  REQUIRE(eight.resample(100.0));
  for (uint32_t e : eight.vertices.edges) CHECK(e == 3);

  CurveNet pair = loop;  // a circle cut in two by its diameter: three segments join two nodes
  pair.curves.clear();
  pair.add_circle({}, 1, true);
  pair.add_line({-1, 0, 0}, {1, 0, 0}, {0, 0, 1});
  Stages cut(pair);
  REQUIRE(cut.resample(100.0));
  for (uint32_t e : cut.vertices.edges) CHECK(e == 2);

  Stages coarse(octant_net());
  REQUIRE(coarse.resample(100.0));
  for (uint32_t e : coarse.vertices.edges) CHECK(e == 1);

  CurveNet ring;
  ring.add_circle({}, 1, true);
  Stages alone(ring);
  REQUIRE(alone.resample(100.0));
  CHECK(alone.vertices.edges[0] == 3);
}

TEST_CASE("resample: too small a spacing is too large a result, at once") {
  for (double spacing : {1e-10, 1e-300, 4e-324}) {
    Stages s(octant_net());
    CHECK(!s.resample(spacing));
    CHECK(s.status.code == Code::too_large);
    CHECK(s.heap.allocator.peak_bytes < 1000000);
  }
}

TEST_CASE("resample: one long segment has checkpoints too") {
  CurveNet net;
  net.add_circle({}, 1, true);
  Stages s(net);
  s.heap.cancel_at = s.heap.checkpoints + 2;
  CHECK(!s.resample(2 * k_pi / 20000));
  CHECK(s.status.code == Code::cancelled);
}

TEST_CASE("resample: opposite normals on a curve are named") {
  Heap heap;
  wireskin::curves::Curves curves(heap.context);
  const std::vector<Vec3> position = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Vec3> normal = {{0, 0, 1}, {0, 0, -1}, {0, 0, 1}, {0, 0, -1}};
  const std::vector<uint32_t> node(4, k_none);
  const std::vector<uint8_t> boundary = {0};
  must(wireskin::curves::add_curve({view(position), view(normal), view(node), true}, &curves));
  Network network(heap.context);
  must(find_patches(curves, view(boundary), {}, &network));
  CurveVertices vertices(heap.context);
  const Status s = resample(curves, {}, network, curves.arc.back() / 8, &vertices);
  CHECK(s.code == Code::inconsistent_normals);
  CHECK(s.place.curve == 0);
}
