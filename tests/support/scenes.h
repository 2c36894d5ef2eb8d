// The reference scenes as plain arrays for the C API, and what tests need round a call: copies of
// the results and one hash over them. Each scene takes some milliseconds.
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
  double soft = 0.0;
  bool sharp = false;
  std::vector<double> normals_right;  // of sharp curves

  size_t size() const { return nodes.size(); }
};

struct SensorCurve {
  std::vector<double> arc_lengths;
  std::vector<double> tangents;
  Curve rest;  // its positions are not read
};

// By which functions a scene becomes a surface.
enum class Way { build, connect, integrate, flow, smooth_mesh };

// Curves, sensor curves, or a mesh of the caller's, as `way` says. Empty arrays of normals stand
// for null pointers.
struct Scene {
  std::string name;
  Way way = Way::build;
  std::vector<Curve> curves;
  std::vector<SensorCurve> sensors;
  bool tangents_to_next = false;
  wsk_smoothing smoothing = WSK_SMOOTHING_DEFAULT;
  double noise = 0.0;
  double soft = 0.0;
  bool partial = false;
  bool find_borders = false;
  bool orient = false;
  int32_t voids = WSK_VOIDS_AUTO;
  bool raw = false;
  uint32_t most_tetrahedra = 0;
  double spacing = 0.0;
  wsk_method method = WSK_METHOD_STANKO;

  std::vector<double> positions;
  std::vector<double> normals;
  std::vector<uint8_t> constrained;
  std::vector<uint32_t> triangles;
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
// The four above and the rest, which are made in reference_scenes.cpp: every method and every way,
// loops, holes, creases, soft curves, points, dangling curves, patches that fail.
std::vector<Scene> all();

// Three closed curves on an ellipsoid with unequal axes, unevenly sampled: no symmetry within a
// patch, so the topology does not hang on how ties are broken.
Scene ellipsoid();

// Curves as the C API takes them; they point into `scene`.
std::vector<wsk_curve> curves_of(const Scene& scene);
wsk_mesh mesh_of(const Scene& scene);

// Defaults with what the scene says.
wsk_options options_of(const Scene& scene);

// The functions that the scene is for, one after the other; never more than one holds memory for
// itself, so that the report's peak is the greatest of theirs (a flow counts together with its
// surface).
wsk_status run(const Scene& scene, const wsk_options& options, wsk_surface** surface,
               wsk_report* report);

// A copy of all that a surface holds.
struct Result {
  uint32_t patch_count = 0;
  std::vector<double> positions, normals, mean_curvature, constraint_normals, crease_normals;
  std::vector<uint32_t> vertex_curve, triangles, triangle_patch, curve_edges, curve_edge_curve,
      crease_corners;
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

// "FAIR" of WSK_METHOD_FAIR.
const char* name_of_method(wsk_method method);

}  // namespace scenes
