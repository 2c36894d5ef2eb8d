// Peeling does not depend on the order; walls separate as many voids as were chosen.
#include "flow/topology.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "flow/flow.h"
#include "flow/networks.h"
#include "flow/unseen.h"

using namespace flow_tests;
using namespace wireskin::flow;

TEST_CASE("What peeling leaves does not depend on its order") {
  unit::Heap heap;
  Flow flow(heap.context);
  const Net net = torus_net(8, 5, 0.4, 4);
  const NetArrays arrays(net);
  unit::must(build_flow(heap.context, arrays.view(), {}, &flow));
  Sheet first(heap.context);
  unit::must(start_sheet(flow.complex, &first));
  const auto fill = [&](Sheet* sheet) {
    for (uint32_t t = 0; t < flow.complex.triangle_count(); ++t) {
      if (flow.persistence.creator[t] == 0) add_to_sheet(flow.complex, t, sheet);
    }
  };
  fill(&first);
  const size_t whole = size_t(std::count(first.in.begin(), first.in.end(), 1));
  unit::must(peel(flow.complex, flow.curves, Protect::curves, &first));
  const std::vector<uint8_t> left = unit::to_vector(first.in);
  CHECK(std::count(left.begin(), left.end(), 1) > 0);
  CHECK(size_t(std::count(left.begin(), left.end(), 1)) < whole);
  unit::Random random(4);
  for (int round = 0; round < 5; ++round) {
    Sheet sheet(heap.context);
    unit::must(start_sheet(flow.complex, &sheet));
    fill(&sheet);
    std::vector<uint32_t> free_edges;
    for (uint32_t e = 0; e < flow.complex.edge_count(); ++e) {
      if (sheet.degree[e] == 1) free_edges.push_back(e);
    }
    for (size_t i = free_edges.size(); i > 1; --i) {
      std::swap(free_edges[i - 1], free_edges[random.below(uint32_t(i))]);
    }
    begin_removal(&sheet);
    for (const uint32_t e : free_edges) sheet.loose.push_reserved(e);
    unit::must(peel_after(flow.complex, flow.curves, Protect::curves, &sheet));
    CHECK(unit::to_vector(sheet.in) == left);
    undo_removal(flow.complex, &sheet);
    CHECK(size_t(std::count(sheet.in.begin(), sheet.in.end(), 1)) == whole);
  }
}

TEST_CASE("Walls separate the chosen voids and the outside, and nothing else") {
  unit::Heap heap;
  Flow flow(heap.context);
  const Net net = lattice(2, 2, 1);
  const NetArrays arrays(net);
  unit::must(build_flow(heap.context, arrays.view(), {}, &flow));
  for (int32_t voids = 0; voids <= 4; ++voids) {
    Topology3 topology(heap.context);
    TopologyOptions options;
    options.voids = voids;
    unit::must(reconstruct_topology(heap.context, flow.complex, flow.curves, flow.cells,
                                    flow.persistence, options, &topology));
    CHECK(topology.chosen.size() == size_t(voids));
    unit::Array<uint32_t> label(heap.context);
    unit::must(label_rooms(flow.complex, topology.walls, &label));
    uint32_t rooms = 0;
    for (uint32_t i = 0; i < label.size(); ++i) rooms += label[i] == i;
    CHECK(rooms == uint32_t(voids) + 1);
  }
}
