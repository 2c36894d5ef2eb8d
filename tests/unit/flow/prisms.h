// Wireframes of prisms, and the flow of one.
#pragma once

#include <vector>

#include "flow/flow.h"
#include "flow/networks.h"

namespace unit {

// Corners of the base counter-clockwise, in the plane z = 0; sizes of about four.
inline flow_tests::Net prism(const std::vector<Vec3>& base, double height) {
  flow_tests::Net net;
  const uint32_t n = static_cast<uint32_t>(base.size());
  for (const Vec3& p : base) net.add(p);
  for (const Vec3& p : base) net.add(p + Vec3{0, 0, height});
  for (uint32_t i = 0; i < n; ++i) {
    net.edge(i, (i + 1) % n);
    net.edge(n + i, n + (i + 1) % n);
    net.edge(i, n + i);
  }
  return net;
}

// Two arms of length 2 that meet at a corner.
inline flow_tests::Net l_prism(double width, double height) {
  return prism({{0, 0, 0}, {2, 0, 0}, {2, width, 0}, {width, width, 0}, {width, 2, 0}, {0, 2, 0}},
               height);
}

// Two rooms that meet at a waist.
inline flow_tests::Net waisted_prism(double half_waist, double height) {
  return prism({{-2, -0.5, 0},
                {0, -half_waist, 0},
                {2, -0.5, 0},
                {2, 0.5, 0},
                {0, half_waist, 0},
                {-2, 0.5, 0}},
               height);
}

struct FlowOf {
  Heap heap;
  wireskin::flow::Flow flow{heap.context};

  explicit FlowOf(const flow_tests::Net& net) {
    flow_tests::Net small = net;
    for (Vec3& p : small.vertex) p = 0.25 * p;
    const flow_tests::NetArrays arrays(small);
    must(build_flow(heap.context, arrays.view(), {}, &flow));
  }
  // In the units of the net.
  double area_of(uint32_t t) const {
    const uint32_t* const v = &flow.complex.triangle[3 * size_t{t}];
    const Vec3& a = flow.complex.point[v[0]];
    return 8.0 * length(cross(flow.complex.point[v[1]] - a, flow.complex.point[v[2]] - a));
  }
};

}  // namespace unit
