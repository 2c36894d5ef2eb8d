// Networks with round ends: cans, cones, frusta, barrels, vases, domes, half cans, knobs on boxes.
// Circles and rails between them, without normals.
#pragma once

#include <functional>

#include "flow/unseen_more.h"

namespace flow_tests {

inline constexpr uint32_t k_round = 48;  // vertices on a circle

inline std::vector<uint32_t> add_round_ring(Net& net, double radius, double z) {
  std::vector<uint32_t> ring;
  for (uint32_t i = 0; i < k_round; ++i) {
    const double a = 2 * k_pi * i / k_round;
    ring.push_back(net.add({radius * std::cos(a), radius * std::sin(a), z}));
  }
  std::vector<uint32_t> closed = ring;
  closed.push_back(ring.front());
  net.curve.push_back(closed);
  return ring;
}

// Circles of given radii and heights, joined by straight rails.
inline Net stack(const std::vector<std::array<double, 2>>& radius_and_height, uint32_t rails) {
  Net net;
  std::vector<uint32_t> below;
  for (const auto& [radius, height] : radius_and_height) {
    const std::vector<uint32_t> ring = add_round_ring(net, radius, height);
    for (uint32_t k = 0; !below.empty() && k < rails; ++k) {
      net.edge(below[k * k_round / rails], ring[k * k_round / rails]);
    }
    below = ring;
  }
  return net;
}

// The rails go on from the last circle to a point on the axis.
inline Net pointed(const std::vector<std::array<double, 2>>& radius_and_height, uint32_t rails,
                   double top) {
  Net net = stack(radius_and_height, rails);
  const uint32_t apex = net.add({0, 0, top});
  const uint32_t last = uint32_t(radius_and_height.size() - 1) * k_round;
  for (uint32_t k = 0; k < rails; ++k) net.edge(last + k * k_round / rails, apex);
  return net;
}

// Rings at the heights given, and curved rails along a profile.
inline Net lathe(const std::function<double(double)>& radius, const std::vector<double>& heights,
                 uint32_t rails) {
  Net net;
  std::vector<std::vector<uint32_t>> rings;
  for (const double z : heights) rings.push_back(add_round_ring(net, radius(z), z));
  for (uint32_t k = 0; k < rails; ++k) {
    const uint32_t at = k * k_round / rails;
    const double a = 2 * k_pi * at / k_round;
    std::vector<uint32_t> rail = {rings[0][at]};
    for (size_t s = 1; s < heights.size(); ++s) {
      for (int f = 1; f < 12; ++f) {
        const double z = heights[s - 1] + (heights[s] - heights[s - 1]) * f / 12;
        rail.push_back(net.add({radius(z) * std::cos(a), radius(z) * std::sin(a), z}));
      }
      rail.push_back(rings[s][at]);
    }
    net.curve.push_back(rail);
  }
  return net;
}

// A circle and meridians from it to a pole.
inline Net dome(uint32_t meridians, double height) {
  Net net;
  const std::vector<uint32_t> ring = add_round_ring(net, 1.0, 0.0);
  const uint32_t top = net.add({0, 0, height});
  for (uint32_t k = 0; k < meridians; ++k) {
    const uint32_t at = k * k_round / meridians;
    const Vec3 out = net.vertex[ring[at]];
    std::vector<uint32_t> curve = {ring[at]};
    for (int f = 1; f < 16; ++f) {
      const double t = 0.5 * k_pi * f / 16;
      curve.push_back(net.add(std::cos(t) * out + Vec3{0, 0, height * std::sin(t)}));
    }
    curve.push_back(top);
    net.curve.push_back(curve);
  }
  return net;
}

inline Net half_can(double height, uint32_t rails) {
  Net net;
  std::vector<std::vector<uint32_t>> arcs;
  for (const double z : {0.0, height}) {
    std::vector<uint32_t> arc;
    for (int i = 0; i <= 24; ++i) {
      arc.push_back(net.add({std::cos(k_pi * i / 24), std::sin(k_pi * i / 24), z}));
    }
    net.curve.push_back(arc);
    net.edge(arc.front(), arc.back());
    arcs.push_back(arc);
  }
  for (uint32_t k = 0; k <= rails + 1; ++k) {
    net.edge(arcs[0][24 * k / (rails + 1)], arcs[1][24 * k / (rails + 1)]);
  }
  return net;
}

inline Net box_with_knob(uint32_t rails) {
  Net net = stack({{0.7, 1}, {0.7, 2}}, rails);
  add_box(net, {-1.5, -1.5, 0}, {1.5, 1.5, 1});
  return net;
}

// With every round end closed. Where two rails are all there is, or one on a tall can, balls pass
// between them: such walls are not found. Walls are nearly flat between rails, so with less than
// four those of a step's lower part would run through its upper one.
inline std::vector<Expected> round_networks() {
  const auto barrel = [](double z) { return 1 + 0.4 * z * (2 - z); };
  const auto vase = [](double z) { return 0.8 + 0.3 * std::sin(2.2 * z); };
  return {
      {"flat can, one rail", stack({{1, 0}, {1, 0.5}}, 1), {1, 0, 1}, 3, 1},
      {"flat can, two rails", stack({{1, 0}, {1, 0.5}}, 2), {1, 0, 1}, 4},
      {"can, one rail", stack({{1, 0}, {1, 1}}, 1), {1, 0, 1}, 3, 1},
      {"can, two rails", stack({{1, 0}, {1, 1}}, 2), {1, 0, 1}, 4},
      {"can, three rails", stack({{1, 0}, {1, 2}}, 3), {1, 0, 1}, 5},
      {"can, four rails", stack({{1, 0}, {1, 2}}, 4), {1, 0, 1}, 6},
      {"can, six rails", stack({{1, 0}, {1, 2}}, 6), {1, 0, 1}, 8},
      {"tall can", stack({{1, 0}, {1, 8}}, 4), {1, 0, 1}, 6},
      {"frustum, one rail", stack({{1, 0}, {0.5, 1.5}}, 1), {1, 0, 1}, 3, 1},
      {"frustum, four rails", stack({{1, 0}, {0.5, 1.5}}, 4), {1, 0, 1}, 6},
      {"three circles, one rail", stack({{1, 0}, {0.7, 1}, {0.5, 2}}, 1), {1, 0, 1}, 4, 2},
      {"three circles, four rails", stack({{1, 0}, {0.7, 1}, {0.5, 2}}, 4), {1, 0, 1}, 10},
      {"step, four rails", stack({{1, 0}, {1, 1}, {0.5, 1}, {0.5, 2}}, 4), {1, 0, 1}, 14},
      {"step, six rails", stack({{1, 0}, {1, 1}, {0.5, 1}, {0.5, 2}}, 6), {1, 0, 1}, 20},
      {"waisted", stack({{0.7, 0}, {1, 1}, {0.7, 2}}, 3), {1, 0, 1}, 8},
      {"vase", lathe(vase, {0, 0.7, 1.4, 2.1, 2.8}, 6), {1, 0, 1}, 26},
      {"barrel", lathe(barrel, {0, 1, 2}, 5), {1, 0, 1}, 12},
      {"bullet", pointed({{1, 0}, {1, 2}}, 4, 3.5), {1, 0, 1}, 9},
      {"half can", half_can(0.6, 1), {1, 0, 1}, 5},
      {"tall half can", half_can(2.0, 3), {1, 0, 1}, 7},
  };
}

// With one round end, which is closed by itself.
inline std::vector<Expected> capped_networks() {
  return {
      {"cone, three rails", pointed({{1, 0}}, 3, 1.0), {1, 0, 1}, 4},
      {"cone, four rails", pointed({{1, 0}}, 4, 2.0), {1, 0, 1}, 5},
      {"cone, six rails", pointed({{1, 0}}, 6, 2.0), {1, 0, 1}, 7},
      {"dome", dome(4, 1.0), {1, 0, 1}, 5},
      {"low dome", dome(6, 0.4), {1, 0, 1}, 7},
      {"high dome", dome(6, 2.0), {1, 0, 1}, 7},
      {"knob, one rail", box_with_knob(1), {1, 0, 1}, 8, 2},
      {"knob, four rails", box_with_knob(4), {1, 0, 1}, 11, 1},
  };
}

}  // namespace flow_tests
