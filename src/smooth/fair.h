// The fair surface: positions of the free vertices from a harmonic start, two steps of the paper's
// method on the current mesh in space, and up to six steps of minimum variation, with mesh care
// between.
//
// In: a mesh with held vertices (positions, unit normals), the patch of each triangle, the shapes
// of the triangles for the harmonic start. Out: positions, propagated normals, triangles (edges
// inside patches may be flipped). A patch whose displacement runs away (more than a quarter of its
// size, or growing), and all if a step is singular, go back to what the paper's steps gave and stay
// there; a patch that ends with folds goes back to its last state without. Cost: a factorisation of
// size n for the start and each paper step, one of size 2 n for the displacements, more where it
// serves no more. Sources: T. Stanko et al., "Surfacing Curve Networks with Normal Control", 2016;
// H. Moreton, C. Sequin, "Functional Optimization for Fair Surface Design", 1992.
#pragma once

#include "smooth/smooth.h"

namespace wireskin::smooth {

struct FairMesh {
  Span<Vec3> position;
  Span<Vec3> normal;  // in: of the vertices on curves
  Span<uint32_t> triangle;
  Span<const uint32_t> patch;
  Span<const uint8_t> on_curve;
  Span<const uint8_t> held;  // on a curve and not soft
  Span<const uint8_t> on_border;
  Soft soft;
  Span<const mesh::TriangleShape> start_shape;  // empty: positions are a start already
  Span<const uint8_t> bare = {};                // held, on a border, normal not known; empty: none
  Span<uint8_t> guarded = {};                   // out: of each patch, whether it was held back
  Places places = {};                           // for the order of elimination
  // Free vertices with a place to start from instead of the harmonic one; empty: none.
  Span<const Vec3> start = {};
  Span<const uint8_t> placed = {};
  Span<const uint32_t> inner_edge = {};  // of curves inside patches, two vertices each
};

struct FairOptions {
  int paper_steps = 2;
  int displacement_steps = 6;  // at most; fewer where they have become small
  double smoothness = 0.12;  // c: the smoothing length in units of sqrt(area of the mesh / patches)
};

struct FairReport {
  double residual = 0.0;
  uint32_t flips = 0;
  uint32_t factorisations = 0;  // of displacement steps
  uint32_t iterations = 0;      // of conjugate gradients
  uint32_t guarded_patches = 0;
  double greatest_step = 0.0;  // of any patch, over the square root of its area, in the first step
};

Status fair(Context& context, const FairMesh& mesh, uint32_t patches, const FairOptions& options,
            FairReport* report);

}  // namespace wireskin::smooth
