// The pipeline as one readable page: curves -> network -> patches -> smooth -> mesh. Shorter ones
// begin with a mesh of the caller's (surface/from_triangles.h) and with a flow
// (surface/from_flow.h).
//
// In: checked, finite input with unit normals, scaled so that its extent is about one (api.cpp does
// both). Out: a Surface. Counts are filled in as the work goes on, so that a failure can be
// reported with them.
#pragma once

#include "mesh/crease_normals.h"
#include "mesh/measure.h"
#include "network/smoothing.h"
#include "smooth/smooth.h"

namespace wireskin {

// All curves one after the other; curve c has the samples start[c] .. start[c + 1). Positions and
// normals of nodes are made equal in place.
struct CurveSet {
  Span<const uint32_t> start;
  Span<Vec3> position;
  Span<Vec3> normal;             // unit
  Span<const uint32_t> number;   // the caller's node numbers, k_none for ordinary samples
  Span<const uint8_t> closed;    // of each curve
  Span<const uint8_t> boundary;  // of each curve
  Span<const double> soft;       // of each curve: its cutoff length, zero if it holds
  // Empty where no curve is sharp. A sharp curve's normals are those on its left, zero where they
  // are not known; so are those on its right.
  Span<const uint8_t> sharp = {};
  Span<Vec3> right = {};
};

struct TriangleSet {
  Span<const Vec3> position;
  Span<const Vec3> normal;  // unit where held; empty if there are none
  Span<const uint8_t> constrained;
  Span<const uint32_t> triangle;
  double soft = 0.0;  // cutoff length of the constraints, zero if they hold
};

// What the caller chose. Lengths are scaled like the positions.
struct Settings {
  smooth::Method method = smooth::Method::fair;
  double spacing = 0.0;  // zero: a hundredth of the diagonal of the bounding box
  network::SmoothingOptions smoothing;
  bool partial = false;       // patches that cannot be made are left out
  bool find_borders = false;  // curves round which a patch would run clockwise are boundary
};

struct Counts {
  uint32_t curves = 0, nodes = 0, segments = 0, patches = 0;
  uint32_t vertices = 0, free_vertices = 0, triangles = 0;
  uint32_t components = 0, boundary_loops = 0;
  int32_t euler_characteristic = 0;
  double spacing = 0.0;
  double least_angle = 0.0;  // degrees
  double residual = 0.0;
  uint32_t minimal_area_patches = 0;
  uint32_t guarded_patches = 0;
  uint32_t iterations = 0;  // of conjugate gradients
  network::SmoothingReport noise;
  double greatest_distance = 0.0, mean_square_distance = 0.0;  // of the samples from their curves
  mesh::AngleStatistics normal_deviation;                      // along the curves
  mesh::AngleStatistics dihedral;                              // across the curves
  uint32_t failed_patches = 0;
  uint32_t ambiguous_patches = 0, first_ambiguous_patch = k_none;
  uint32_t found_borders = 0;
  uint32_t inverted_triangles = 0, first_inverted_patch = k_none;
  uint32_t coarse_patches = 0, first_coarse_patch = k_none;
};

// What is known of each patch, those that could not be made included.
struct PatchList {
  Array<uint8_t> way;           // network::PatchWay
  Array<Status> status;         // ok: it was made
  Array<uint32_t> curve_start;  // patch p has the curves curve[curve_start[p]] .. ascending
  Array<uint32_t> curve;

  explicit PatchList(Context& context)
      : way(context), status(context), curve_start(context), curve(context) {}
};

struct Surface {
  Counts counts;
  Array<Vec3> position;
  Array<Vec3> normal;  // of the mesh
  mesh::CornerNormals crease_normals;
  Array<double> mean_curvature;
  Array<double> gaussian_curvature;
  Array<uint32_t> vertex_curve;   // k_none where free
  Array<Vec3> constraint_normal;  // zero where free
  Array<uint32_t> triangle;
  Array<uint32_t> patch;       // of each triangle
  Array<uint32_t> curve_edge;  // two vertices each
  Array<uint32_t> curve_edge_curve;
  Array<uint8_t> patch_guarded;  // of each patch: held back; empty where the method held none
  PatchList patches;

  explicit Surface(Context& context)
      : position(context),
        normal(context),
        crease_normals(context),
        mean_curvature(context),
        gaussian_curvature(context),
        vertex_curve(context),
        constraint_normal(context),
        triangle(context),
        patch(context),
        curve_edge(context),
        curve_edge_curve(context),
        patch_guarded(context),
        patches(context) {}
};

Status surface_curves(Context& context, const CurveSet& curves, const Settings& settings,
                      Surface* surface);

}  // namespace wireskin
