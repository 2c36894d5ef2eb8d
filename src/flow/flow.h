// Surfaces from curves alone: the steps from polylines to walls and patches, in two halves, so that
// the second can be asked again for another number of voids or another threshold at no cost.
//
// In: polylines, scaled so that their extent is about one. Out: Flow, which keeps samples, complex
// and voids; from it Reconstruction, the walls and patches for one choice of options. Sources: B.
// Sadri, K. Singh, "Flow-Complex-Based Shape Reconstruction from 3D Curves", 2014; the Delaunay
// version of it: U. Bauer, F. Roll, "Wrapping Cycles in Delaunay Complexes", 2024.
#pragma once

#include "flow/flat_cells.h"
#include "flow/patches.h"
#include "flow/thicken.h"

namespace wireskin::flow {

inline constexpr double k_default_sampling = 0.02;  // of the diagonal

struct FlowOptions {
  // The greatest step, a length; 0: k_default_sampling, or the spacing of the result if that is
  // less.
  double sampling = 0.0;
  double spacing = 0.0;
  bool bend = false;  // the samples are of smooth curves, not corners of polylines
  Lids lids = Lids::single;
  double noise = 0.0;  // standard deviation of what was taken out of the polylines, a length
  ComplexOptions complex;
};

struct Flow {
  double step = 0.0;  // the greatest between samples
  Arcs arcs;
  Samples samples;
  Complex complex;
  CurveEdges curves;
  FlatCells cells;
  Persistence persistence;
  SampleTangents tangents;

  explicit Flow(Context& context)
      : arcs(context),
        samples(context),
        complex(context),
        curves(context),
        cells(context),
        persistence(context),
        tangents(context) {}
};

Status build_flow(Context& context, const Polylines& polylines, const FlowOptions& options,
                  Flow* flow);

struct ReconstructionOptions {
  TopologyOptions topology;
  ThickenOptions thicken;
};

struct Reconstruction {
  Topology3 topology;
  Patches patches;
  Array<uint32_t> bare;    // segments without a triangle, places in Samples::at
  uint32_t betti[3] = {};  // of the walls and the curves together
  uint32_t open_patches = 0;
  uint32_t crowded_edges = 0;  // edges of more than two triangles
  uint32_t open_lids = 0;      // ends of tubes that no wall closes
  explicit Reconstruction(Context& context) : topology(context), patches(context), bare(context) {}
};

Status reconstruct(Context& context, const Flow& flow, const ReconstructionOptions& options,
                   Reconstruction* result);

}  // namespace wireskin::flow
