// Curve networks of known shape for tests of single stages, and the stages run one after the other.
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "network/group.h"
#include "network/patch_mesh.h"
#include "support/meshes.h"

namespace unit {

struct NetCurve {
  std::vector<Vec3> position, normal;
  bool closed = false, boundary = false;
};

struct CurveNet {
  std::vector<NetCurve> curves;

  // Samples f(t) -> {position, normal} at n + 1 places over [0, 1]; the last is left out when
  // closed.
  template <typename F>
  void add(uint32_t n, bool closed, bool boundary, const F& f) {
    NetCurve c;
    c.closed = closed;
    c.boundary = boundary;
    for (uint32_t i = 0; i < n + (closed ? 0 : 1); ++i) {
      const std::pair<Vec3, Vec3> sample = f(static_cast<double>(i) / n);
      c.position.push_back(sample.first);
      c.normal.push_back(wireskin::unit(sample.second));
    }
    curves.push_back(c);
  }
  void add_line(Vec3 a, Vec3 b, Vec3 normal, bool boundary = false, uint32_t n = 12) {
    add(n, false, boundary, [=](double t) { return std::make_pair((1 - t) * a + t * b, normal); });
  }
  // In the plane z, normals up.
  void add_circle(Vec3 centre, double radius, bool boundary, uint32_t n = 48, double start = 0.0) {
    add(n, true, boundary, [=](double t) {
      const double a = start + 2 * k_pi * t;
      return std::make_pair(centre + radius * Vec3{std::cos(a), std::sin(a), 0}, Vec3{0, 0, 1});
    });
  }
};

// The stages up to the one wanted; `status` is that of the first which failed.
struct Stages {
  Heap heap;
  std::vector<uint32_t> start = {0}, number;
  std::vector<Vec3> position, normal;
  std::vector<uint8_t> boundary;
  Array<wireskin::network::Node> nodes{heap.context};
  Array<uint32_t> node_of_sample{heap.context};
  wireskin::curves::Curves curves{heap.context};
  wireskin::network::Network network{heap.context};
  wireskin::network::CurveVertices vertices{heap.context};
  wireskin::network::PatchMesh mesh{heap.context};
  Status status;

  // Samples at the same point (to 1e-7) get the same number.
  explicit Stages(const CurveNet& net) {
    std::map<std::tuple<long, long, long>, uint32_t> numbers;
    for (const NetCurve& c : net.curves) {
      for (size_t i = 0; i < c.position.size(); ++i) {
        const Vec3& p = c.position[i];
        const auto key =
            std::make_tuple(std::lround(1e7 * p.x), std::lround(1e7 * p.y), std::lround(1e7 * p.z));
        number.push_back(numbers.emplace(key, static_cast<uint32_t>(numbers.size())).first->second);
        position.push_back(p);
        normal.push_back(c.normal[i]);
      }
      start.push_back(static_cast<uint32_t>(position.size()));
      boundary.push_back(c.boundary);
    }
    status = find_patches(net);
  }
  bool resample(double spacing) {
    if (status.ok()) {
      status = wireskin::network::resample(curves, nodes.span(), network, spacing, &vertices);
    }
    return status.ok();
  }
  bool group(double spacing) {
    if (resample(spacing)) status = wireskin::network::group_patches(vertices, &network);
    return status.ok();
  }
  bool mesh_patches(double spacing) {
    if (group(spacing)) status = wireskin::network::mesh_patches(network, vertices, -1.0, false, &mesh);
    return status.ok();
  }

 private:
  Status find_patches(const CurveNet& net) {
    TRY(wireskin::network::find_nodes({view(start), view(number), view(position), view(normal)},
                                      1e-9, &nodes, &node_of_sample));
    for (size_t i = 0; i < position.size(); ++i) {
      if (node_of_sample[i] == k_none) continue;
      position[i] = nodes[node_of_sample[i]].position;
      normal[i] = nodes[node_of_sample[i]].normal;
    }
    for (size_t c = 0; c < net.curves.size(); ++c) {
      const size_t first = start[c], count = start[c + 1] - first;
      TRY(wireskin::curves::add_curve(
          {view(position).part(first, count), view(normal).part(first, count),
           Span<const uint32_t>(node_of_sample.span()).part(first, count), net.curves[c].closed},
          &curves));
    }
    return wireskin::network::find_patches(curves, view(boundary), nodes.span(), &network);
  }
};

// Three great circles of the unit sphere.
inline CurveNet octant_net() {
  CurveNet net;
  const Vec3 axis[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int k = 0; k < 3; ++k) {
    net.add(48, true, false, [&, k](double t) {
      const Vec3 p = std::cos(2 * k_pi * t) * axis[k] + std::sin(2 * k_pi * t) * axis[(k + 1) % 3];
      return std::make_pair(p, p);
    });
  }
  return net;
}

// Major radius 4, minor 2: m meridians and p parallels.
inline CurveNet torus_net(uint32_t m, uint32_t p) {
  CurveNet net;
  const auto at = [](double u, double v) {
    const Vec3 n = {std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)};
    return std::make_pair(Vec3{4 * std::cos(u), 4 * std::sin(u), 0} + 2.0 * n, n);
  };
  for (uint32_t k = 0; k < m; ++k) {
    net.add(12 * p, true, false, [&](double t) { return at(2 * k_pi * k / m, 2 * k_pi * t); });
  }
  for (uint32_t k = 0; k < p; ++k) {
    net.add(24 * m, true, false, [&](double t) { return at(2 * k_pi * t, 2 * k_pi * k / p); });
  }
  return net;
}

// Two circles of radius 1 at z = -1 and 1, joined by straight lines; the circles are boundary or
// not.
inline CurveNet cylinder_net(uint32_t lines, bool boundary = true) {
  CurveNet net;
  for (double z : {-1.0, 1.0}) {
    net.add(12 * lines, true, boundary, [=](double t) {
      const Vec3 n = {std::cos(2 * k_pi * t), std::sin(2 * k_pi * t), 0};
      return std::make_pair(n + Vec3{0, 0, z}, n);
    });
  }
  for (uint32_t k = 0; k < lines; ++k) {
    const Vec3 n = {std::cos(2 * k_pi * k / lines), std::sin(2 * k_pi * k / lines), 0};
    net.add_line(n - Vec3{0, 0, 1}, n + Vec3{0, 0, 1}, n);
  }
  return net;
}

// z = (x^2 - y^2) / 2 on [-1, 1]^2: the sides and the lines x = 0 and y = 0.
inline CurveNet saddle_net(bool boundary = true) {
  CurveNet net;
  const auto line = [&](double x0, double y0, double x1, double y1, bool border) {
    net.add(20, false, border, [=](double t) {
      const double x = x0 + t * (x1 - x0), y = y0 + t * (y1 - y0);
      return std::make_pair(Vec3{x, y, 0.5 * (x * x - y * y)}, Vec3{-x, y, 1});
    });
  };
  line(-1, -1, 1, -1, boundary);
  line(1, -1, 1, 1, boundary);
  line(1, 1, -1, 1, boundary);
  line(-1, 1, -1, -1, boundary);
  line(-1, 0, 1, 0, false);
  line(0, -1, 0, 1, false);
  return net;
}

}  // namespace unit
