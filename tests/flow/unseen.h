// Networks made here, none of which the method was tuned to, with what they must become. Counts
// follow from the shapes: every face of a polyhedron is a patch.
#pragma once

#include "flow/networks.h"

namespace flow_tests {

struct Expected {
  const char* name;
  Net net;
  uint32_t betti[3];
  uint32_t patches;
  uint32_t annuli = 0;
  int32_t voids = -1;
};

inline constexpr double k_pi = 3.14159265358979323846;

// A ring of segments through all points, in order.
inline void add_ring(Net& net, const std::vector<uint32_t>& ring) {
  for (size_t i = 0; i < ring.size(); ++i) net.edge(ring[i], ring[(i + 1) % ring.size()]);
}

inline Net prism(const std::vector<std::array<double, 2>>& base, double height) {
  Net net;
  std::vector<uint32_t> low, high;
  for (const auto& p : base) low.push_back(net.add({p[0], p[1], 0.0}));
  for (const auto& p : base) high.push_back(net.add({p[0], p[1], height}));
  add_ring(net, low);
  add_ring(net, high);
  for (size_t i = 0; i < base.size(); ++i) net.edge(low[i], high[i]);
  return net;
}

inline Net regular_prism(int n, double height) {
  std::vector<std::array<double, 2>> base;
  for (int i = 0; i < n; ++i)
    base.push_back({std::cos(2 * k_pi * i / n), std::sin(2 * k_pi * i / n)});
  return prism(base, height);
}

// All pairs of points at the given distance are edges.
inline Net polyhedron(const std::vector<Vec3>& points, double edge) {
  Net net;
  for (const Vec3& p : points) net.add(p);
  for (uint32_t i = 0; i < points.size(); ++i) {
    for (uint32_t k = i + 1; k < points.size(); ++k) {
      if (std::fabs(length(points[i] - points[k]) - edge) < 1e-9) net.edge(i, k);
    }
  }
  return net;
}

inline Net octahedron() {
  return polyhedron({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                    std::sqrt(2.0));
}

inline Net icosahedron() {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vec3> p;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-g, g}) {
      p.push_back({0, s, t});
      p.push_back({s, t, 0});
      p.push_back({t, 0, s});
    }
  }
  return polyhedron(p, 2.0);
}

inline Net dodecahedron() {
  const double g = 0.5 * (1.0 + std::sqrt(5.0)), h = 1.0 / g;
  std::vector<Vec3> p;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-1.0, 1.0}) {
      for (const double u : {-1.0, 1.0}) p.push_back({s, t, u});
      p.push_back({0, s * h, t * g});
      p.push_back({s * h, t * g, 0});
      p.push_back({t * g, 0, s * h});
    }
  }
  return polyhedron(p, 2.0 * h);
}

// A lattice of nx x ny x nz unit cubes.
inline Net lattice(int nx, int ny, int nz) {
  std::vector<Vec3> p;
  for (int z = 0; z <= nz; ++z) {
    for (int y = 0; y <= ny; ++y) {
      for (int x = 0; x <= nx; ++x) p.push_back({double(x), double(y), double(z)});
    }
  }
  return polyhedron(p, 1.0);
}

// Closed curves through shared points where `join` says that they meet.
inline void add_circle(Net& net, const Vec3& c, const Vec3& u, const Vec3& v, int pieces,
                       const std::vector<uint32_t>& shared) {
  std::vector<uint32_t> curve;
  for (int i = 0; i < pieces; ++i) {
    const double a = 2 * k_pi * i / pieces;
    const Vec3 p = c + std::cos(a) * u + std::sin(a) * v;
    uint32_t found = k_none;
    for (const uint32_t s : shared) {
      if (length(net.vertex[s] - p) < 1e-9) found = s;
    }
    curve.push_back(found != k_none ? found : net.add(p));
  }
  curve.push_back(curve.front());
  net.curve.push_back(curve);
}

inline Net great_circles() {
  Net net;
  std::vector<uint32_t> poles;
  for (const Vec3& p : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1},
                        Vec3{0, 0, -1}}) {
    poles.push_back(net.add(p));
  }
  add_circle(net, {}, {1, 0, 0}, {0, 1, 0}, 64, poles);
  add_circle(net, {}, {0, 1, 0}, {0, 0, 1}, 64, poles);
  add_circle(net, {}, {0, 0, 1}, {1, 0, 0}, 64, poles);
  return net;
}

// A torus of n meridians and m parallels.
inline Net torus_net(int n, int m, double tube, int fine) {
  Net net;
  std::vector<uint32_t> joint;
  const auto at = [&](double a, double b) {
    const double r = 1.0 + tube * std::cos(b);
    return Vec3{r * std::cos(a), r * std::sin(a), tube * std::sin(b)};
  };
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < m; ++k) joint.push_back(net.add(at(2 * k_pi * i / n, 2 * k_pi * k / m)));
  }
  for (int i = 0; i < n; ++i) {
    std::vector<uint32_t> curve;
    for (int k = 0; k < m; ++k) {
      curve.push_back(joint[size_t(i * m + k)]);
      for (int f = 1; f < fine; ++f) {
        curve.push_back(net.add(at(2 * k_pi * i / n, 2 * k_pi * (k + double(f) / fine) / m)));
      }
    }
    curve.push_back(curve.front());
    net.curve.push_back(curve);
  }
  for (int k = 0; k < m; ++k) {
    std::vector<uint32_t> curve;
    for (int i = 0; i < n; ++i) {
      curve.push_back(joint[size_t(i * m + k)]);
      for (int f = 1; f < fine; ++f) {
        curve.push_back(net.add(at(2 * k_pi * (i + double(f) / fine) / n, 2 * k_pi * k / m)));
      }
    }
    curve.push_back(curve.front());
    net.curve.push_back(curve);
  }
  return net;
}

// A box with a circle floating in two opposite faces.
inline Net box_with_circles() {
  Net net = prism({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 1.5);
  add_circle(net, {1, 0, 0.75}, {0.3, 0, 0}, {0, 0, 0.3}, 32, {});
  add_circle(net, {1, 1, 0.75}, {0.3, 0, 0}, {0, 0, 0.3}, 32, {});
  return net;
}

inline Net pyramid(int n, double height) {
  Net net;
  std::vector<uint32_t> ring;
  for (int i = 0; i < n; ++i) {
    ring.push_back(net.add({std::cos(2 * k_pi * i / n), std::sin(2 * k_pi * i / n), 0}));
  }
  add_ring(net, ring);
  const uint32_t top = net.add({0, 0, height});
  for (const uint32_t v : ring) net.edge(v, top);
  return net;
}

inline Net antiprism(int n, double height) {
  Net net;
  std::vector<uint32_t> low, high;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * k_pi * i / n, b = a + k_pi / n;
    low.push_back(net.add({std::cos(a), std::sin(a), 0}));
    high.push_back(net.add({std::cos(b), std::sin(b), height}));
  }
  add_ring(net, low);
  add_ring(net, high);
  for (int i = 0; i < n; ++i) {
    net.edge(low[size_t(i)], high[size_t(i)]);
    net.edge(high[size_t(i)], low[size_t((i + 1) % n)]);
  }
  return net;
}

inline std::vector<Expected> unseen_networks() {
  const std::vector<std::array<double, 2>> letter_l = {{0, 0}, {2, 0}, {2, 1},
                                                       {1, 1}, {1, 2}, {0, 2}};
  const std::vector<std::array<double, 2>> kite = {{0, 0}, {1.3, 0.2}, {1.6, 1.1}, {0.1, 0.9}};
  return {
      {"octahedron", octahedron(), {1, 0, 1}, 8},
      {"icosahedron", icosahedron(), {1, 0, 1}, 20},
      {"dodecahedron", dodecahedron(), {1, 0, 1}, 12},
      {"prism 3", regular_prism(3, 1.5), {1, 0, 1}, 5},
      {"prism 5", regular_prism(5, 1.2), {1, 0, 1}, 7},
      {"prism 6", regular_prism(6, 1.0), {1, 0, 1}, 8},
      {"prism 8", regular_prism(8, 1.5), {1, 0, 1}, 10},
      {"kite prism", prism(kite, 0.9), {1, 0, 1}, 6},
      {"letter L", prism(letter_l, 1.0), {1, 0, 1}, 8},
      {"pyramid 3", pyramid(3, 1.5), {1, 0, 1}, 4},
      {"pyramid 4", pyramid(4, 2.0), {1, 0, 1}, 5},
      {"pyramid 5", pyramid(5, 2.0), {1, 0, 1}, 6},
      {"pyramid 6", pyramid(6, 3.0), {1, 0, 1}, 7},
      {"antiprism 4", antiprism(4, 1.2), {1, 0, 1}, 10},
      {"antiprism 6", antiprism(6, 1.0), {1, 0, 1}, 14},
      {"two cubes in a row", lattice(2, 1, 1), {1, 0, 2}, 11},
      {"eight cubes", lattice(2, 2, 2), {1, 0, 8}, 36},
      {"great circles", great_circles(), {1, 0, 1}, 8},
      {"torus 10 x 6", torus_net(10, 6, 0.4, 8), {1, 2, 1}, 60},
      {"torus 12 x 8", torus_net(12, 8, 0.6, 6), {1, 2, 1}, 96},
      {"box with two circles", box_with_circles(), {1, 0, 1}, 8, 2},
  };
}

}  // namespace flow_tests
