// Three small reference scenes for the harness, as plain arrays for the C API, and what its tests
// need round a call: an owner for the surface, copies of the results and one hash over them.
//
// The points come from sqrt and the four operations alone, so that they have the same bits
// everywhere and the hashes can be committed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "wireskin.h"

namespace scenes {

struct Curve {
  std::vector<double> positions;  // 3 a sample
  std::vector<double> normals;    // 3 a sample
  std::vector<uint32_t> nodes;    // 1 a sample, WSK_NONE between nodes
  bool closed = false;
  bool boundary = false;

  size_t size() const { return nodes.size(); }
};

// Either a network (curves) or a mesh of the caller's (triangles not empty).
struct Scene {
  std::string name;
  std::vector<Curve> curves;
  double spacing = 0.0;
  wsk_method method = WSK_METHOD_STANKO;
  bool partial = false;

  std::vector<double> positions;
  std::vector<double> normals;
  std::vector<uint8_t> constrained;
  std::vector<uint32_t> triangles;

  bool flow = false;  // from the curves alone
};

// Three great circles of the unit sphere, 10 segments a quarter after resampling.
Scene octants();
// z = (x^2 - y^2) / 2 on [-1, 1]^2 with the lines x, y = -1, 0, 1; the sides of the border are a
// curve each.
Scene saddle();
// A cylinder between two circles whose normals are turned up and down, so that it becomes a barrel.
Scene band();
// An ellipsoid with noisy samples, surfaced by the default method: every stage does its work.
Scene noisy();
// octants(), saddle(), band() and noisy().
std::vector<Scene> all();
// Curves alone: the great circles with their normals, the ellipsoid without.
std::vector<Scene> flows();

// Patches that are no disc in a plane: a tube between two circles, a globe round one, a disc with a
// hole, a dangling curve and a point in it, and that disc beside a folded patch that is left out.
std::vector<Scene> unusual();

// Three closed curves on an ellipsoid with unequal axes, unevenly sampled: no symmetry within a
// patch, so the topology does not hang on how ties are broken.
Scene ellipsoid();

// Curves as the C API takes them; they point into `scene`.
std::vector<wsk_curve> curves_of(const Scene& scene);
wsk_mesh mesh_of(const Scene& scene);

// Defaults with the scene's spacing and method.
wsk_options options_of(const Scene& scene);

// wsk_build, wsk_smooth_mesh or wsk_flow_surface, whichever the scene is for.
wsk_status run(const Scene& scene, const wsk_options& options, wsk_surface** surface,
               wsk_report* report);

// A copy of all that a surface holds.
struct Result {
  uint32_t patch_count = 0;
  std::vector<double> positions, normals, mean_curvature, constraint_normals;
  std::vector<uint32_t> vertex_curve, triangles, triangle_patch, curve_edges, curve_edge_curve;
  std::vector<uint8_t> patch_guarded;  // not part of the hash
};

Result copy_of(const wsk_surface* surface);

// FNV-1a, 64 bits, over the little-endian bytes of every array and its length.
uint64_t hash_of(const Result& result);
// The hash of each array by itself, to see where two results part.
std::string hashes_by_array(const Result& result);

// Runs the scene with its own options and the given method; an empty result where that fails.
Result result_of(const Scene& scene, wsk_method method);
Result result_of(const Scene& scene);  // by its own method

}  // namespace scenes
