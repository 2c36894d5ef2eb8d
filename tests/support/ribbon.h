// Borders given by functions, without the curves of a network.
#pragma once

#include <cmath>
#include <utility>

#include "network/border.h"
#include "support/meshes.h"

namespace unit {

struct RibbonBorder {
  Heap heap;
  wireskin::network::Border border{heap.context};

  RibbonBorder() { must(border.start.push(0)); }
  // One more loop: f(angle) -> {position, normal}, n samples all the way round.
  template <typename F>
  void add(uint32_t n, const F& f) {
    for (uint32_t i = 0; i < n; ++i) {
      const std::pair<Vec3, Vec3> sample = f(2 * k_pi * i / n);
      must(border.vertex.push(border.size()));
      must(border.position.push(sample.first));
      must(border.normal.push(wireskin::unit(sample.second)));
    }
    must(border.start.push(border.size()));
  }
  // A circle round the z axis, counter-clockwise seen from its tip or not. Its normals lean from
  // the axis (tilt 0) outwards (pi / 2).
  void add_circle(double radius, double z, bool counter_clockwise, double tilt, uint32_t n = 96) {
    add(n, [=](double angle) {
      const double a = counter_clockwise ? angle : -angle;
      const Vec3 out = {std::cos(a), std::sin(a), 0};
      return std::make_pair(radius * out + Vec3{0, 0, z},
                            std::sin(tilt) * out + Vec3{0, 0, std::cos(tilt)});
    });
  }
};

}  // namespace unit
