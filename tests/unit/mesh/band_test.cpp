#include "mesh/band.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "support/meshes.h"

using namespace unit;
using namespace wireskin;
using mesh::LoopMesh;

namespace {

struct Ends {
  std::vector<uint32_t> start = {0};
  std::vector<Vec3> position, normal;

  template <typename F>
  void add(uint32_t n, const F& f) {
    for (uint32_t i = 0; i < n; ++i) {
      const std::pair<Vec3, Vec3> sample = f(2 * k_pi * i / n);
      position.push_back(sample.first);
      normal.push_back(wireskin::unit(sample.second));
    }
    start.push_back(static_cast<uint32_t>(position.size()));
  }
  mesh::Loops loops() const {
    return {{start.data(), start.size()},
            {position.data(), position.size()},
            {normal.data(), normal.size()}};
  }
};

// Two meridians of the torus R = 4, r = 2, `apart` radians from each other, with n and m vertices.
Ends meridians(double apart, uint32_t n, uint32_t m) {
  Ends ends;
  for (const double u : {0.0, apart}) {
    ends.add(u == 0.0 ? n : m, [=](double t) {
      const double v = u == 0.0 ? -t : t + 0.3;
      const Vec3 out = {std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)};
      return std::make_pair(4.0 * Vec3{std::cos(u), std::sin(u), 0} + 2.0 * out, out);
    });
  }
  return ends;
}

std::vector<Vec3> points_of(const Ends& ends, const LoopMesh& mesh) {
  std::vector<Vec3> all = ends.position;
  all.insert(all.end(), mesh.inner.begin(), mesh.inner.end());
  return all;
}

// An annulus whose border runs with the loops, and no triangle of which is a needle.
void check_annulus(Heap& heap, const Ends& ends, const LoopMesh& mesh) {
  const std::vector<Vec3> all = points_of(ends, mesh);
  const uint32_t n = static_cast<uint32_t>(all.size());
  Array<uint32_t> twins(heap.context);
  mesh::Topology topology(heap.context);
  must(mesh::find_twins(n, mesh.triangle.span(), &twins));
  must(mesh::find_topology(n, mesh.triangle.span(), twins.span(), &topology));
  CHECK(topology.euler_characteristic == 0);
  CHECK(topology.boundary_loops == 2);
  CHECK(topology.components == 1);
  uint32_t border = 0;
  const mesh::Loops loops = ends.loops();
  for (uint32_t h = 0; h < mesh.triangle.size(); ++h) {
    if (twins[h] != k_none) continue;
    ++border;
    const uint32_t v = mesh.triangle[h], w = mesh.triangle[mesh::next_half_edge(h)];
    CHECK(w == loops.next(v < ends.start[1] ? 0 : 1, v));
  }
  CHECK(border == ends.position.size());
  CHECK(least_angle_of({all.data(), all.size()}, mesh.triangle.span()) > 1.0);
}

}  // namespace

TEST_CASE("bands between meridians lie on the torus, however far apart they are") {
  for (const double degrees : {20.0, 60.0, 90.0, 120.0}) {
    for (const uint32_t m : {60u, 37u}) {
      CAPTURE(degrees);
      CAPTURE(m);
      Heap heap;
      LoopMesh mesh(heap.context);
      const Ends ends = meridians(degrees * k_pi / 180, 60, m);
      must(mesh::mesh_band(heap.context, ends.loops(), 0.2, &mesh));
      check_annulus(heap, ends, mesh);
      for (const Vec3& p : mesh.inner) {
        const double tube = std::hypot(std::hypot(p.x, p.y) - 4.0, p.z);
        CHECK(tube == doctest::Approx(2.0).epsilon(0.02));
      }
    }
  }
}

TEST_CASE("bands between rings of a cylinder and a cone are straight") {
  for (const double top : {1.0, 0.2, 3.0}) {
    CAPTURE(top);
    Heap heap;
    LoopMesh mesh(heap.context);
    Ends ends;
    const double slope = 1.0 - top;  // the radius is 1 - slope z
    ends.add(40, [=](double t) {
      return std::make_pair(Vec3{std::cos(t), std::sin(t), 0},
                            Vec3{std::cos(t), std::sin(t), slope});
    });
    ends.add(90, [=](double t) {
      return std::make_pair(Vec3{top * std::cos(-t), top * std::sin(-t), 1},
                            Vec3{std::cos(-t), std::sin(-t), slope});
    });
    must(mesh::mesh_band(heap.context, ends.loops(), 0.15, &mesh));
    check_annulus(heap, ends, mesh);
    for (const Vec3& p : mesh.inner) {
      const double radius = std::hypot(p.x, p.y), wanted = 1.0 - slope * p.z;
      CHECK(std::fabs(radius - wanted) < 0.02 * (1.0 + top));
      CHECK(p.z > 0.0);
      CHECK(p.z < 1.0);
    }
  }
}

TEST_CASE("bands: no normals, few vertices, bad input") {
  Heap heap;
  LoopMesh mesh(heap.context);
  Ends ends = meridians(1.0, 3, 5);
  must(mesh::mesh_band(heap.context, ends.loops(), 5.0, &mesh));
  check_annulus(heap, ends, mesh);
  for (Vec3& n : ends.normal) n = Vec3{};
  must(mesh::mesh_band(heap.context, ends.loops(), 1.0, &mesh));
  check_annulus(heap, ends, mesh);
  CHECK(mesh::mesh_band(heap.context, ends.loops(), 0.0, &mesh).code == Code::bad_argument);
  CHECK(mesh::mesh_band(heap.context, ends.loops(), 1e-8, &mesh).code == Code::too_large);
  for (Vec3& p : ends.position) p = Vec3{1, 2, 3};
  CHECK(mesh::mesh_band(heap.context, ends.loops(), 1.0, &mesh).code == Code::patch_folded);
}
