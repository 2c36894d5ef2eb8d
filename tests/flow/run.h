// One run from a net to a remeshed surface, as containers.
#pragma once

#include "flow/critical.h"
#include "flow/independent.h"
#include "flow/networks.h"
#include "flow/remesh.h"
#include "surface/flow_noise.h"

namespace flow_tests {

struct RunOptions {
  double eps = 0.02;
  uint64_t seed = 0;
  int32_t voids = -1;
  bool open_walls = false;
  bool remesh = true;
  wireskin::network::SmoothingOptions smoothing = {wireskin::network::Noise::none, 0.0};
  wireskin::flow::Lids lids = wireskin::flow::Lids::single;
};

struct Run {
  uint32_t betti[3];
  uint32_t patches = 0, annuli = 0, open = 0, crossings = 0;
  size_t bare = 0, chosen = 0;
  uint32_t missing = 0, open_lids = 0;
  long long euler = 0;
  double area = 0.0, ratio = 0.0;
  std::vector<Vec3> position, raw_position;
  std::vector<Corners> triangle, raw_triangle;
  std::vector<uint32_t> patch, raw_patch;
  std::vector<Pair> segment;
  std::vector<double> areas;
};

inline std::vector<Corners> corners_of(const wireskin::Array<uint32_t>& flat) {
  std::vector<Corners> list(flat.size() / 3);
  for (size_t i = 0; i < flat.size(); ++i) list[i / 3][i % 3] = flat[i];
  return list;
}

inline double diagonal_of(const Net& net) {
  Vec3 low = net.vertex[net.curve[0][0]], high = low;
  for (const auto& curve : net.curve) {
    for (const uint32_t v : curve) {
      const Vec3& p = net.vertex[v];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  }
  return length(high - low);
}

inline Run run(const Net& net, const RunOptions& options = {}) {
  using namespace wireskin;
  unit::Heap heap;
  NetArrays arrays(net);
  network::SmoothingReport noise;
  unit::must(smooth_polylines(heap.context, arrays.view(), options.smoothing,
                              {arrays.position.data(), arrays.position.size()}, {}, &noise));
  flow::Flow made(heap.context);
  flow::FlowOptions flow_options;
  flow_options.sampling = options.eps * diagonal_of(net);
  flow_options.complex.seed = options.seed;
  flow_options.lids = options.lids;
  flow_options.noise = noise.sigma_position;
  unit::must(flow::build_flow(heap.context, arrays.view(), flow_options, &made));
  flow::Reconstruction result(heap.context);
  flow::ReconstructionOptions wish;
  wish.topology.voids = options.voids;
  wish.topology.open_walls = options.open_walls;
  unit::must(flow::reconstruct(heap.context, made, wish, &result));
  flow::FlowMesh raw(heap.context), mesh(heap.context);
  unit::must(flow::mesh_patches(heap.context, made, result, 0.0, &raw));
  if (options.remesh) {
    unit::must(flow::mesh_patches(heap.context, made, result, made.step, &mesh));
  }
  flow::CriticalPoints critical(heap.context);
  unit::must(flow::find_critical_points(made.complex, &critical));
  Run r;
  std::copy(result.betti, result.betti + 3, r.betti);
  r.patches = result.patches.size();
  r.open = result.open_patches;
  r.bare = result.bare.size();
  r.chosen = result.topology.chosen.size();
  r.missing = made.curves.missing;
  r.crossings = raw.crossings + mesh.crossings;
  r.open_lids = result.open_lids;
  r.euler = critical.euler();
  if (!made.persistence.voids.empty()) r.ratio = made.persistence.voids[0].ratio;
  for (const flow::PatchFacts& p : result.patches.facts) {
    r.annuli += p.loops == 2;
    r.area += p.area;
    r.areas.push_back(p.area);
  }
  r.raw_position = unit::to_vector(raw.position);
  r.raw_triangle = corners_of(raw.triangle);
  r.raw_patch = unit::to_vector(raw.patch);
  r.position = unit::to_vector(mesh.position);
  r.triangle = corners_of(mesh.triangle);
  r.patch = unit::to_vector(mesh.patch);
  for (uint32_t a = 0; a + 1 < made.samples.start.size(); ++a) {
    for (uint32_t i = made.samples.start[a]; i + 1 < made.samples.start[a + 1]; ++i) {
      r.segment.push_back({made.samples.at[i], made.samples.at[i + 1]});
    }
  }
  return r;
}

inline Betti betti_of(const Run& r, const std::vector<Corners>& triangles) {
  return betti_numbers(triangles, r.segment, {});
}

inline Net turned(const Net& net, int turn) {
  Net result = net;
  const double a = 0.7 * turn, b = 1.1 * turn, c = 0.3 + turn;
  for (Vec3& p : result.vertex) {
    p = {std::cos(a) * p.x - std::sin(a) * p.y, std::sin(a) * p.x + std::cos(a) * p.y, p.z};
    p = {p.x, std::cos(b) * p.y - std::sin(b) * p.z, std::sin(b) * p.y + std::cos(b) * p.z};
    p = {std::cos(c) * p.x + std::sin(c) * p.z, p.y, -std::sin(c) * p.x + std::cos(c) * p.z};
  }
  return result;
}

// The same curves in another order, every other one backward, and the vertices renumbered.
inline Net reordered(const Net& net, uint32_t seed) {
  unit::Random random(seed);
  Net result = net;
  std::vector<uint32_t> number(net.vertex.size());
  std::iota(number.begin(), number.end(), 0u);
  for (size_t i = number.size(); i > 1; --i)
    std::swap(number[i - 1], number[random.below(uint32_t(i))]);
  for (size_t v = 0; v < number.size(); ++v) result.vertex[number[v]] = net.vertex[v];
  for (size_t i = result.curve.size(); i > 1; --i) {
    std::swap(result.curve[i - 1], result.curve[random.below(uint32_t(i))]);
  }
  for (size_t c = 0; c < result.curve.size(); ++c) {
    for (uint32_t& v : result.curve[c]) v = number[v];
    if (c % 2 == 1) std::reverse(result.curve[c].begin(), result.curve[c].end());
  }
  return result;
}

}  // namespace flow_tests
