// A second family of networks made here: prisms over letters and stars, pyramids, bipyramids,
// frusta, houses, boxes joined and boxes with handles, Archimedean solids, tents, and polyhedra
// with bulged edges. Each is a function of its shape; the answer is what a person sees.
#pragma once

#include <algorithm>

#include "flow/unseen.h"

namespace flow_tests {

using Outline = std::vector<std::array<double, 2>>;

inline Outline star_outline(int tips, double inner) {
  Outline outline;
  for (int i = 0; i < 2 * tips; ++i) {
    const double r = i % 2 == 0 ? 1.0 : inner, a = k_pi * i / tips;
    outline.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return outline;
}

inline std::vector<uint32_t> add_polygon(Net& net, int n, double radius, double z) {
  std::vector<uint32_t> ring;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * k_pi * i / n;
    ring.push_back(net.add({radius * std::cos(a), radius * std::sin(a), z}));
  }
  add_ring(net, ring);
  return ring;
}

inline Net oblique_pyramid(int n, const Vec3& top) {
  Net net;
  const std::vector<uint32_t> ring = add_polygon(net, n, 1.0, 0.0);
  const uint32_t apex = net.add(top);
  for (const uint32_t v : ring) net.edge(v, apex);
  return net;
}

inline Net bipyramid(int n, double up, double down) {
  Net net;
  const std::vector<uint32_t> ring = add_polygon(net, n, 1.0, 0.0);
  const uint32_t top = net.add({0, 0, up}), bottom = net.add({0, 0, -down});
  for (const uint32_t v : ring) {
    net.edge(v, top);
    net.edge(v, bottom);
  }
  return net;
}

// Polygons one above the other, joined corner by corner.
inline Net tower(int n, const std::vector<std::array<double, 2>>& radius_and_height) {
  Net net;
  std::vector<uint32_t> below;
  for (const auto& [radius, height] : radius_and_height) {
    const std::vector<uint32_t> ring = add_polygon(net, n, radius, height);
    for (size_t i = 0; i < below.size(); ++i) net.edge(below[i], ring[i]);
    below = ring;
  }
  return net;
}

inline std::vector<uint32_t> add_box(Net& net, const Vec3& low, const Vec3& high) {
  std::vector<uint32_t> corner;
  for (int i = 0; i < 8; ++i) {
    corner.push_back(net.add({(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                              (i & 4) != 0 ? high.z : low.z}));
  }
  for (uint32_t i = 0; i < 8; ++i) {
    for (const uint32_t bit : {1u, 2u, 4u}) {
      if ((i & bit) == 0) net.edge(corner[i], corner[i | bit]);
    }
  }
  return corner;
}

// A box, and a roof with a ridge along x; inset 0 is a gable roof, else hipped.
inline Net house(double length, double width, double wall, double roof, double inset) {
  Net net;
  const std::vector<uint32_t> c = add_box(net, {0, 0, 0}, {length, width, wall});
  const uint32_t a = net.add({inset, 0.5 * width, wall + roof});
  const uint32_t b = net.add({length - inset, 0.5 * width, wall + roof});
  net.edge(a, b);
  net.edge(c[4], a);
  net.edge(c[6], a);
  net.edge(c[5], b);
  net.edge(c[7], b);
  return net;
}

inline Net spire(double wall, double height) {
  Net net;
  const std::vector<uint32_t> c = add_box(net, {0, 0, 0}, {1, 1, wall});
  const uint32_t top = net.add({0.5, 0.5, wall + height});
  for (size_t i = 4; i < 8; ++i) net.edge(c[i], top);
  return net;
}

// A box and, on its side z = 0 of one of them, another of the same cross section.
inline Net boxes_in_a_row(const std::vector<double>& lengths) {
  Net net;
  std::vector<uint32_t> last;
  double x = 0.0;
  const auto section = [&] {
    std::vector<uint32_t> ring;
    for (const auto& p : Outline{{0, 0}, {1, 0}, {1, 1.2}, {0, 1.2}}) {
      ring.push_back(net.add({x, p[0], p[1]}));
    }
    add_ring(net, ring);
    for (size_t i = 0; i < last.size(); ++i) net.edge(last[i], ring[i]);
    last = ring;
  };
  section();
  for (const double length : lengths) {
    x += length;
    section();
  }
  return net;
}

// Cubes of a lattice at the given places: an edge that several share is one.
inline Net cubes_at(const std::vector<std::array<int, 3>>& places) {
  std::vector<std::array<int, 3>> corner;
  std::vector<std::array<uint32_t, 2>> edge;
  for (const auto& p : places) {
    uint32_t number[8];
    for (int i = 0; i < 8; ++i) {
      const std::array<int, 3> c = {p[0] + (i & 1), p[1] + (i >> 1 & 1), p[2] + (i >> 2 & 1)};
      const auto found = std::find(corner.begin(), corner.end(), c);
      number[i] = uint32_t(found - corner.begin());
      if (found == corner.end()) corner.push_back(c);
    }
    for (int i = 0; i < 8; ++i) {
      for (const int bit : {1, 2, 4}) {
        if ((i & bit) != 0) continue;
        const std::array<uint32_t, 2> e = {std::min(number[i], number[i | bit]),
                                           std::max(number[i], number[i | bit])};
        if (std::find(edge.begin(), edge.end(), e) == edge.end()) edge.push_back(e);
      }
    }
  }
  Net net;
  for (const auto& c : corner) net.add({double(c[0]), double(c[1]), double(c[2])});
  for (const auto& e : edge) net.edge(e[0], e[1]);
  return net;
}

// A box with a square tube bent from its top to its top again.
inline Net box_with_handle(double tube) {
  Net net;
  add_box(net, {0, 0, 0}, {4, 2, 1.5});
  const double y0 = 1.0 - 0.5 * tube, y1 = 1.0 + 0.5 * tube;
  // The tube's outline in the plane of x and z, outer and inner side, corner by corner.
  const double xo[4] = {0.6, 0.6, 3.4, 3.4}, zo[4] = {1.5, 3.0, 3.0, 1.5};
  const double xi[4] = {0.6 + tube, 0.6 + tube, 3.4 - tube, 3.4 - tube};
  const double zi[4] = {1.5, 3.0 - tube, 3.0 - tube, 1.5};
  std::vector<uint32_t> last;
  for (int i = 0; i < 4; ++i) {
    const std::vector<uint32_t> ring = {net.add({xo[i], y0, zo[i]}), net.add({xo[i], y1, zo[i]}),
                                        net.add({xi[i], y1, zi[i]}), net.add({xi[i], y0, zi[i]})};
    add_ring(net, ring);
    for (size_t k = 0; k < last.size(); ++k) net.edge(last[k], ring[k]);
    last = ring;
  }
  return net;
}

// A square hole from the top down, through all of it or part of it.
inline Net box_with_hole(double depth) {
  Net net;
  add_box(net, {0, 0, 0}, {3, 3, 1});
  add_box(net, {1, 1, 1 - depth}, {2, 2, 1});
  return net;
}

inline Net box_on_a_box() {
  Net net;
  add_box(net, {0, 0, 0}, {3, 3, 1});
  add_box(net, {0.5, 1, 1}, {1.5, 2, 2.5});
  return net;
}

inline Net centred_cube() {
  Net net;
  add_box(net, {-1, -1, -1}, {1, 1, 1});
  return net;
}

inline Net cuboctahedron() {
  std::vector<Vec3> p;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-1.0, 1.0}) {
      p.push_back({s, t, 0});
      p.push_back({s, 0, t});
      p.push_back({0, s, t});
    }
  }
  return polyhedron(p, std::sqrt(2.0));
}

inline Net truncated_octahedron() {
  std::vector<Vec3> p;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-2.0, 2.0}) {
      for (const Vec3& q : {Vec3{0, s, t}, Vec3{0, t, s}, Vec3{s, 0, t}, Vec3{t, 0, s},
                            Vec3{s, t, 0}, Vec3{t, s, 0}}) {
        p.push_back(q);
      }
    }
  }
  return polyhedron(p, std::sqrt(2.0));
}

inline Net rhombic_dodecahedron() {
  std::vector<Vec3> p;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-1.0, 1.0}) {
      for (const double u : {-1.0, 1.0}) p.push_back({s, t, u});
    }
    p.push_back({2 * s, 0, 0});
    p.push_back({0, 2 * s, 0});
    p.push_back({0, 0, 2 * s});
  }
  return polyhedron(p, std::sqrt(3.0));
}

// The edges of a net as arcs of the sphere round the origin through their ends' radii, `bulge` of
// the way from straight to round.
inline Net bulged(const Net& net, double bulge) {
  Net result;
  for (const Vec3& p : net.vertex) result.add(p);
  for (const auto& curve : net.curve) {
    std::vector<uint32_t> round = {curve[0]};
    for (size_t i = 0; i + 1 < curve.size(); ++i) {
      const Vec3 a = net.vertex[curve[i]], b = net.vertex[curve[i + 1]];
      constexpr int k_pieces = 16;
      for (int k = 1; k < k_pieces; ++k) {
        const double t = double(k) / k_pieces;
        const Vec3 flat = (1 - t) * a + t * b;
        const double radius = (1 - t) * length(a) + t * length(b);
        round.push_back(result.add((1 - bulge) * flat + (bulge * radius / length(flat)) * flat));
      }
      round.push_back(curve[i + 1]);
    }
    result.curve.push_back(round);
  }
  return result;
}

// Poles from the corners of a square to a point, sagging inward.
inline Net sagging_tent(double height, double sag) {
  Net net;
  const std::vector<uint32_t> ring = add_polygon(net, 4, 1.0, 0.0);
  const uint32_t top = net.add({0, 0, height});
  for (const uint32_t v : ring) {
    const Vec3 a = net.vertex[v];
    std::vector<uint32_t> pole = {v};
    for (int k = 1; k < 16; ++k) {
      const double t = k / 16.0, r = (1 - t) - sag * std::sin(k_pi * t);
      pole.push_back(net.add({r * a.x, r * a.y, height * t}));
    }
    pole.push_back(top);
    net.curve.push_back(pole);
  }
  return net;
}

inline Net ellipsoid_of_ellipses(double a, double b, double c) {
  Net net = great_circles();
  for (Vec3& p : net.vertex) p = {a * p.x, b * p.y, c * p.z};
  return net;
}

// Every curve of a wireframe is where two faces make a crease. Without the ring round its middle
// the bipyramid still has all its creases, whatever its number of sides, and so has the hourglass
// its waist: these are one solid, as the bipyramids of more sides are, and no drawing of either
// could do without the ring. Between boxes in a row the ring lies in flat sides: there a wall must
// be meant.
inline std::vector<Expected> more_unseen_networks() {
  const Outline letter_t = {{0, 2}, {0, 3}, {3, 3}, {3, 2}, {2, 2}, {2, 0}, {1, 0}, {1, 2}};
  const Outline letter_z = {{0, 0},   {3, 0},    {3, 1},    {1.5, 1},
                            {1.5, 3}, {-1.5, 3}, {-1.5, 2}, {0, 2}};
  return {
      {"prism T", prism(letter_t, 1.0), {1, 0, 1}, 10},
      {"prism Z", prism(letter_z, 1.0), {1, 0, 1}, 10},
      {"plate", prism({{0, 0}, {2, 0}, {2, 1.5}, {0, 1.5}}, 0.3), {1, 0, 1}, 6},
      {"plate 6", regular_prism(6, 0.3), {1, 0, 1}, 8},
      {"column 5", regular_prism(5, 5.0), {1, 0, 1}, 7},
      {"pyramid 3, low", pyramid(3, 1.0), {1, 0, 1}, 4},
      {"pyramid 4, low", pyramid(4, 1.2), {1, 0, 1}, 5},
      {"pyramid 4, high", pyramid(4, 4.0), {1, 0, 1}, 5},
      {"pyramid 5, high", pyramid(5, 4.0), {1, 0, 1}, 6},
      {"pyramid 7", pyramid(7, 3.0), {1, 0, 1}, 8},
      {"pyramid 8", pyramid(8, 3.0), {1, 0, 1}, 9},
      {"oblique pyramid 4", oblique_pyramid(4, {0.8, 0.3, 2.0}), {1, 0, 1}, 5},
      {"oblique pyramid 5", oblique_pyramid(5, {0.5, -0.4, 2.5}), {1, 0, 1}, 6},
      {"bipyramid 3", bipyramid(3, 1.5, 1.5), {1, 0, 1}, 6},
      {"bipyramid 5", bipyramid(5, 1.5, 1.0), {1, 0, 1}, 10},
      {"bipyramid 6", bipyramid(6, 2.0, 2.0), {1, 0, 1}, 12},
      {"bipyramid 8", bipyramid(8, 1.5, 2.0), {1, 0, 1}, 16},
      {"frustum 3", tower(3, {{1, 0}, {0.5, 1}}), {1, 0, 1}, 5},
      {"frustum 4", tower(4, {{1, 0}, {0.6, 0.8}}), {1, 0, 1}, 6},
      {"frustum 5", tower(5, {{1, 0}, {0.4, 1.5}}), {1, 0, 1}, 7},
      {"frustum 6", tower(6, {{1, 0}, {0.3, 2}}), {1, 0, 1}, 8},
      {"frustum 8", tower(8, {{1, 0}, {0.7, 1.2}}), {1, 0, 1}, 10},
      {"hourglass 4", tower(4, {{1, 0}, {0.6, 1}, {1, 2}}), {1, 0, 1}, 10},
      {"barrel 6", tower(6, {{0.7, 0}, {1, 1}, {0.7, 2}}), {1, 0, 1}, 14},
      {"house, gable", house(2.0, 1.5, 1.0, 0.8, 0.0), {1, 0, 1}, 9},
      {"house, hipped", house(2.5, 1.5, 1.0, 0.7, 0.6), {1, 0, 1}, 9},
      {"house, long", house(4.0, 1.5, 1.2, 0.6, 0.0), {1, 0, 1}, 9},
      {"spire", spire(1.0, 0.8), {1, 0, 1}, 9},
      {"boxes 1 1", boxes_in_a_row({1, 1}), {1, 0, 2}, 11},
      {"boxes 1 2", boxes_in_a_row({1, 2}), {1, 0, 2}, 11},
      {"boxes 1 1 1", boxes_in_a_row({1, 1.1, 0.9}), {1, 0, 3}, 16},
      {"cubes in an L", cubes_at({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), {1, 0, 3}, 16},
      {"cubes at an edge", cubes_at({{0, 0, 0}, {1, 1, 0}}), {1, 0, 2}, 12},
      {"cubes at a corner", cubes_at({{0, 0, 0}, {1, 1, 1}}), {1, 0, 2}, 12},
      {"cuboctahedron", cuboctahedron(), {1, 0, 1}, 14},
      {"truncated octahedron", truncated_octahedron(), {1, 0, 1}, 14},
      {"rhombic dodecahedron", rhombic_dodecahedron(), {1, 0, 1}, 12},
      {"round cube", bulged(centred_cube(), 1.0), {1, 0, 1}, 6},
      {"round octahedron", bulged(octahedron(), 1.0), {1, 0, 1}, 8},
      {"round icosahedron", bulged(icosahedron(), 1.0), {1, 0, 1}, 20},
      {"round dodecahedron", bulged(dodecahedron(), 0.7), {1, 0, 1}, 12},
      {"round cuboctahedron", bulged(cuboctahedron(), 0.8), {1, 0, 1}, 14},
      {"ellipsoid", ellipsoid_of_ellipses(1.5, 1.0, 0.7), {1, 0, 1}, 8},
      {"tent, sagging", sagging_tent(1.5, 0.12), {1, 0, 1}, 5},
      {"tent, bulging", sagging_tent(1.5, -0.15), {1, 0, 1}, 5},
      {"ridge tent", prism({{-1, 0}, {1, 0}, {0, 1.4}}, 3.0), {1, 0, 1}, 5},
      {"torus 6 x 4", torus_net(6, 4, 0.4, 12), {1, 2, 1}, 24},
      {"torus 16 x 5", torus_net(16, 5, 0.3, 6), {1, 2, 1}, 80},
  };
}

// Outlines with deep notches, whose mouths no curve closes and whose arms no curve parts; a frustum
// so flat that balls from its rings meet nowhere within; tubes on a box, with a hole through the
// handle; a box with a hole through it.
inline std::vector<Expected> notched_networks() {
  const Outline letter_t = {{0, 2}, {0, 3}, {3, 3}, {3, 2}, {2, 2}, {2, 0}, {1, 0}, {1, 2}};
  const Outline thin_t = {{0, 2.5},   {0, 3},   {3, 3},   {3, 2.5},
                          {1.8, 2.5}, {1.8, 0}, {1.2, 0}, {1.2, 2.5}};
  const Outline letter_u = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  const Outline letter_h = {{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 0}, {3, 0},
                            {3, 3}, {2, 3}, {2, 2}, {1, 2}, {1, 3}, {0, 3}};
  const Outline plus = {{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2},
                        {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
  const Outline stairs = {{0, 0}, {3, 0}, {3, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 3}, {0, 3}};
  const Outline arrow = {{0, 1}, {2, 1}, {2, 0}, {4, 1.5}, {2, 3}, {2, 2}, {0, 2}};
  return {
      {"prism T, tall", prism(letter_t, 3.0), {1, 0, 1}, 10},
      {"prism T, thin", prism(thin_t, 1.0), {1, 0, 1}, 10},
      {"prism U", prism(letter_u, 1.0), {1, 0, 1}, 10},
      {"prism U, tall", prism(letter_u, 4.0), {1, 0, 1}, 10},
      {"prism H", prism(letter_h, 1.2), {1, 0, 1}, 14},
      {"prism plus", prism(plus, 1.0), {1, 0, 1}, 14},
      {"prism plus, tall", prism(plus, 3.0), {1, 0, 1}, 14},
      {"prism stairs", prism(stairs, 2.0), {1, 0, 1}, 10},
      {"prism arrow", prism(arrow, 1.0), {1, 0, 1}, 9},
      {"prism star 5", prism(star_outline(5, 0.5), 1.0), {1, 0, 1}, 12},
      {"prism star 5, sharp", prism(star_outline(5, 0.35), 0.8), {1, 0, 1}, 12},
      {"prism star 6", prism(star_outline(6, 0.6), 1.2), {1, 0, 1}, 14},
      {"frustum 5, flat", tower(5, {{1, 0}, {0.8, 0.3}}), {1, 0, 1}, 7},
      {"box with a handle", box_with_handle(0.5), {1, 2, 1}, 18},
      {"box with a hole", box_with_hole(1.0), {1, 2, 1}, 10, 2},
      {"box with a pit", box_with_hole(0.5), {1, 0, 1}, 11, 1},
      {"box on a box", box_on_a_box(), {1, 0, 1}, 11, 1},
  };
}

}  // namespace flow_tests
