// Small triangle meshes of known shape for tests.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "support/context.h"

namespace unit {

constexpr double k_pi = 3.14159265358979323846;

struct Mesh {
  std::vector<Vec3> position;
  std::vector<uint32_t> triangle;

  uint32_t vertices() const { return static_cast<uint32_t>(position.size()); }
  void add(uint32_t a, uint32_t b, uint32_t c) { triangle.insert(triangle.end(), {a, b, c}); }
};

inline Mesh tetrahedron() {
  return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2}};
}

inline Mesh icosahedron() {
  const double g = 0.5 * (1.0 + std::sqrt(5.0)), s = 1.0 / std::sqrt(1.0 + g * g), t = g * s;
  return {{{-s, t, 0},
           {s, t, 0},
           {-s, -t, 0},
           {s, -t, 0},
           {0, -s, t},
           {0, s, t},
           {0, -s, -t},
           {0, s, -t},
           {t, 0, -s},
           {t, 0, s},
           {-t, 0, -s},
           {-t, 0, s}},
          {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
           4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
           6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1}};
}

// Splits every triangle in four; new vertices lie in the middle of edges.
inline Mesh subdivided(const Mesh& mesh) {
  Mesh fine{mesh.position, {}};
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
  const auto middle = [&](uint32_t a, uint32_t b) {
    const auto key = std::minmax(a, b);
    const auto found = middles.find({key.first, key.second});
    if (found != middles.end()) return found->second;
    fine.position.push_back(0.5 * (mesh.position[a] + mesh.position[b]));
    return middles[{key.first, key.second}] = fine.vertices() - 1;
  };
  for (size_t t = 0; t < mesh.triangle.size(); t += 3) {
    const uint32_t a = mesh.triangle[t], b = mesh.triangle[t + 1], c = mesh.triangle[t + 2];
    const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.add(a, ab, ca);
    fine.add(ab, b, bc);
    fine.add(ca, bc, c);
    fine.add(ab, bc, ca);
  }
  return fine;
}

// The unit sphere; vertices moved on it by up to `jitter`.
inline Mesh sphere(int levels, double jitter, Random& random) {
  Mesh mesh = icosahedron();
  for (int i = 0; i < levels; ++i) mesh = subdivided(mesh);
  for (Vec3& p : mesh.position) {
    p = wireskin::unit(wireskin::unit(p) + jitter * Vec3{random(), random(), random()});
  }
  return mesh;
}

// A grid of w x h vertices in the (x, y) plane, `step` apart, vertex (i, j) at j * w + i; each
// square is cut by its rising diagonal, or by a random one. Wrapping joins the last column to the
// first, `twisted` the other way up (with one triangle strip: a Moebius strip).
inline Mesh grid(uint32_t w, uint32_t h, double step, Random* random = nullptr) {
  Mesh mesh;
  for (uint32_t j = 0; j < h; ++j) {
    for (uint32_t i = 0; i < w; ++i) mesh.position.push_back({step * i, step * j, 0.0});
  }
  for (uint32_t j = 0; j + 1 < h; ++j) {
    for (uint32_t i = 0; i + 1 < w; ++i) {
      const uint32_t a = j * w + i, b = a + 1, c = b + w, d = a + w;
      if (random == nullptr || random->below(2) == 0) {
        mesh.add(a, b, c);
        mesh.add(a, c, d);
      } else {
        mesh.add(a, b, d);
        mesh.add(b, c, d);
      }
    }
  }
  return mesh;
}

// Moves the vertices that are not on the grid's rim, within the plane.
inline void jitter_grid(Mesh* mesh, uint32_t w, uint32_t h, double amount, Random& random) {
  for (uint32_t j = 1; j + 1 < h; ++j) {
    for (uint32_t i = 1; i + 1 < w; ++i) {
      mesh->position[j * w + i] += amount * Vec3{random(), random(), 0.0};
    }
  }
}

// u runs round in `around` columns (radius 1 about the z axis), v along z in rows; with `closed`
// the last row is joined to the first (a torus of major radius 3).
inline Mesh tube(uint32_t around, uint32_t rows, double height, bool closed) {
  Mesh mesh;
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < around; ++i) {
      const double u = 2.0 * k_pi * (i + 0.5 * (closed ? 0 : j)) / around;
      if (closed) {
        const double v = 2.0 * k_pi * j / rows;
        const double r = 3.0 + std::cos(u);
        mesh.position.push_back({r * std::cos(v), r * std::sin(v), std::sin(u)});
      } else {
        const double z = height * j / (rows - 1) - 0.5 * height;
        mesh.position.push_back({std::cos(u), std::sin(u), z});
      }
    }
  }
  for (uint32_t j = 0; j + (closed ? 0 : 1) < rows; ++j) {
    for (uint32_t i = 0; i < around; ++i) {
      const uint32_t next = (i + 1) % around, up = (j + 1) % rows;
      const uint32_t a = j * around + i, b = j * around + next;
      const uint32_t c = up * around + next, d = up * around + i;
      if (closed) {
        mesh.add(a, c, b);
        mesh.add(a, d, c);
      } else {
        mesh.add(a, b, d);
        mesh.add(b, c, d);
      }
    }
  }
  return mesh;
}

inline double least_angle_of(Span<const Vec3> positions, Span<const uint32_t> triangles) {
  Heap heap;
  double degrees = 0.0;
  must(wireskin::mesh::least_angle(heap.context, positions, triangles, &degrees));
  return degrees;
}

}  // namespace unit
