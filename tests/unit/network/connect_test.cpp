#include "network/connect.h"

#include <doctest/doctest.h>

#include "support/wire_nets.h"

using namespace wireskin;
using namespace wireskin::network;
using namespace unit;

TEST_CASE("fragments of a cross with gaps become two lines and a node") {
  WireNet net;
  const std::vector<Vec3> up(11, Vec3{0, 0, 1});
  net.add(line({-1, 0, 0}, {0.49, 0, 0}, 10), false, up);
  net.add(line({1, 0, 0}, {0.5, 0.004, 0}, 10), false, up);
  net.add(line({0, -1, 0.003}, {0, 1, 0.003}, 10), false, up);
  ConnectOptions options;
  options.tolerance = 0.02;
  ConnectResult result(net.heap.context);
  must(connect_wires(net.heap.context, options, 2.8, &net.wires, &result));
  CHECK(result.before.curves == 3);
  CHECK(result.before.dangling == 6);
  CHECK(result.after.curves == 2);
  CHECK(result.after.nodes == 1);
  CHECK(result.after.dangling == 4);
  CHECK(result.after.components == 1);
  CHECK(result.snapping.snaps.size() == 2);
  CHECK(result.contradictions.empty());
}

TEST_CASE("without snapping only what coincides is joined") {
  WireNet net;
  net.add(line({0, 0, 0}, {1, 0, 0}, 4));
  net.add(line({1, 0, 0}, {2, 0, 0}, 4));
  net.add(line({2.001, 0, 0}, {3, 0, 0}, 4));
  ConnectOptions options;
  options.snap = false;
  ConnectResult result(net.heap.context);
  must(connect_wires(net.heap.context, options, 3.0, &net.wires, &result));
  CHECK(result.after.curves == 2);
  CHECK(result.after.components == 2);
  CHECK(result.tolerance == 0.0);
  CHECK(result.normals.missing == 2);
}

TEST_CASE("one number at places farther apart than the tolerance is refused, nearer is a joint") {
  for (const double gap : {0.5, 0.01}) {
    WireNet net;
    net.add(line({0, 0, 0}, {1, 0, 0}, 2), false, {}, {0, 1, 2});
    net.add(line({1 + gap, 0, 0}, {2, 0, 0}, 2), false, {}, {2, 3, 4});
    ConnectOptions options;
    options.tolerance = 0.1;
    ConnectResult result(net.heap.context);
    const Status status = connect_wires(net.heap.context, options, 2.0, &net.wires, &result);
    if (gap > 0.1) {
      CHECK(status.code == Code::node_mismatch);
      CHECK(status.place.curve == 1);
      CHECK(status.place.sample == 0);
      CHECK(status.place.node == 2);
    } else {
      REQUIRE(status.ok());
      CHECK(net.wires.position[2] == net.wires.position[3]);
    }
  }
}
