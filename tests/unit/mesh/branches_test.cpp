#include "mesh/branches.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
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

  // The end of a tube that leads from `centre` against `out`.
  void add(uint32_t n, const Vec3& centre, const Vec3& out, double radius) {
    const Vec3 axis = wireskin::unit(out);
    const Vec3 u = wireskin::unit(wireskin::reject({0.3, 0.5, 0.8}, axis)), v = cross(axis, u);
    for (uint32_t i = 0; i < n; ++i) {
      const double t = -2 * k_pi * i / n;
      const Vec3 away = std::cos(t) * u + std::sin(t) * v;
      position.push_back(centre + radius * away);
      normal.push_back(away);
    }
    start.push_back(static_cast<uint32_t>(position.size()));
  }
  mesh::Loops loops() const {
    return {{start.data(), start.size()},
            {position.data(), position.size()},
            {normal.data(), normal.size()}};
  }
};

double area_of(const std::vector<Vec3>& all, const LoopMesh& mesh) {
  double sum = 0.0;
  for (size_t t = 0; t < mesh.triangle.size(); t += 3) {
    const Vec3 &a = all[mesh.triangle[t]], &b = all[mesh.triangle[t + 1]];
    sum += 0.5 * length(cross(b - a, all[mesh.triangle[t + 2]] - a));
  }
  return sum;
}

// A sphere with a hole for each loop, and about the area given.
void check_branches(const Ends& ends, double area) {
  Heap heap;
  LoopMesh mesh(heap.context);
  must(mesh_branches(heap.context, ends.loops(), 0.3, &mesh));
  std::vector<Vec3> all = ends.position;
  all.insert(all.end(), mesh.inner.begin(), mesh.inner.end());
  const uint32_t n = static_cast<uint32_t>(all.size());
  Array<uint32_t> twins(heap.context);
  mesh::Topology topology(heap.context);
  must(mesh::find_twins(n, mesh.triangle.span(), &twins));
  must(mesh::find_topology(n, mesh.triangle.span(), twins.span(), &topology));
  const uint32_t holes = static_cast<uint32_t>(ends.start.size() - 1);
  CHECK(topology.boundary_loops == holes);
  CHECK(topology.euler_characteristic == 2 - static_cast<int>(holes));
  CHECK(topology.components == 1);
  CHECK(area_of(all, mesh) == doctest::Approx(area).epsilon(0.15));
}

}  // namespace

TEST_CASE("branches: tubes that meet, where lids and threads would have less area") {
  for (double distance : {2.0, 4.0, 8.0}) {
    for (uint32_t count : {3u, 5u}) {
      CAPTURE(distance);
      CAPTURE(count);
      Ends ends;
      for (uint32_t k = 0; k < count; ++k) {
        const double a = 2 * k_pi * k / count;
        const Vec3 out = {std::cos(a), std::sin(a), 0};
        ends.add(24 + 5 * k, distance * out, out, 0.4);
      }
      // Each tube as far as it is by itself; the middle has about as much less as more.
      const double alone = distance - 0.4 / std::tan(k_pi / count);
      const double middle = count == 3 ? 0.7 : 2.4;
      check_branches(ends, count * 2 * k_pi * 0.4 * alone + middle);
    }
  }
  Ends trousers;
  trousers.add(40, {0, 0, 4}, {0, 0, 1}, 1.0);
  trousers.add(30, {-0.8, 0, -4}, {0, 0, -1}, 0.6);
  trousers.add(30, {0.8, 0, -4}, {0, 0, -1}, 0.6);
  check_branches(trousers, 2 * k_pi * (4.0 + 2 * 0.6 * 4.0));
}

TEST_CASE("branches: loops that are no ends of tubes are meshed as they are") {
  Ends disc;  // with two holes
  const auto add = [&disc](uint32_t n, Vec3 centre, double radius, double sign) {
    for (uint32_t i = 0; i < n; ++i) {
      const double t = sign * 2 * k_pi * i / n;
      disc.position.push_back(centre + radius * Vec3{std::cos(t), std::sin(t), 0});
      disc.normal.push_back({0, 0, 1});
    }
    disc.start.push_back(static_cast<uint32_t>(disc.position.size()));
  };
  add(60, {0, 0, 0}, 3.0, 1.0);
  add(20, {-1.2, 0, 0}, 0.5, -1.0);
  add(20, {1.2, 0, 0}, 0.5, -1.0);
  check_branches(disc, k_pi * (9.0 - 0.5));
  Heap heap;
  LoopMesh branches(heap.context), plain(heap.context);
  must(mesh_branches(heap.context, disc.loops(), 0.3, &branches));
  must(mesh_loops(heap.context, disc.loops(), 0.3, &plain));
  REQUIRE(branches.triangle.size() == plain.triangle.size());
  for (size_t i = 0; i < plain.triangle.size(); ++i) {
    CHECK(branches.triangle[i] == plain.triangle[i]);
  }
}

TEST_CASE("branches: where what is between the tubes had to be meshed coarser, that is said") {
  std::mt19937 random(4);
  const auto uniform = [&random] { return random() / 4294967296.0; };
  int coarse = 0, fine = 0;
  for (int k = 0; k < 8 && (coarse == 0 || fine == 0); ++k) {
    Ends ends;  // three tubes of noisy rims, a few of their edges far shorter than the others
    for (int tube = 0; tube < 3; ++tube) {
      const double a = 2 * k_pi * tube / 3;
      const Vec3 out = {std::cos(a), std::sin(a), 0}, side = {-out.y, out.x, 0};
      double t = 0.0;
      while (t < 2 * k_pi) {
        const Vec3 away = std::cos(t) * side + Vec3{0, 0, -std::sin(t)};
        ends.position.push_back(3.0 * out + (1.0 + 0.004 * uniform()) * away);
        ends.normal.push_back(away);
        t += uniform() < 0.15 ? 1e-4 : 0.26;
      }
      ends.start.push_back(static_cast<uint32_t>(ends.position.size()));
    }
    Heap heap;
    LoopMesh mesh(heap.context);
    must(mesh_branches(heap.context, ends.loops(), 0.13, &mesh));
    ++(mesh.coarse ? coarse : fine);
  }
  CHECK(coarse > 0);
  CHECK(fine > 0);
}
