// From a flow reconstruction to a surface like any other: the patches meshed, vertices that nothing
// uses dropped, and smoothed where the curves have normals and the mesh is a manifold.
//
// In: a flow and a reconstruction of it, the caller's normals or none. Out: the surface with
// patches, curve edges and the counts of the report. Curves that bound no patch stay in it as curve
// edges. Without normals, where more than two patches meet at a curve, where a border is no curve,
// where normals contradict the surface, and where smoothing fails or makes triangles cross, the
// remeshed patches are the result; curvatures are zero then where the mesh is no manifold. For
// smoothing, vertices between two samples of a curve move off the segment to where the normals at
// its ends bend it. Cost: that of remeshing (flow/remesh.h) and one smoothing. Sources: B. Sadri,
// K. Singh, "Flow-Complex-Based Shape Reconstruction from 3D Curves", 2014; A. Vlachos et al.,
// "Curved PN Triangles", 2001.
#pragma once

#include "flow/remesh.h"
#include "surface.h"

namespace wireskin {

struct FlowSettings {
  double spacing = 0.0;  // of the result; 0: patches stay as they are
  smooth::Method method = smooth::Method::fair;
  Span<const Vec3> normal;   // of the caller's samples, unit; empty: none
  Span<const Vec3> given;    // the caller's samples before noise was taken out
  uint32_t bare_curves = 0;  // without normals where others have some; k_none: all of them
};

// Numbered like WSK_FLOW_NORMALS_...
enum class NormalsUse {
  none,
  used,
  incomplete,
  not_manifold,
  free_border,
  contradicting,
  crossing,
  too_thin
};

struct FlowOutcome {
  Array<uint32_t> vertex_of;  // of each sample, k_none where nothing uses it
  uint32_t held_back = 0;
  uint32_t crossings = 0;
  bool manifold = false;
  NormalsUse normals = NormalsUse::none;
  uint32_t normals_places = 0;  // that kept them from being used

  explicit FlowOutcome(Context& context) : vertex_of(context) {}
};

Status surface_from_flow(Context& context, const flow::Flow& flow,
                         const flow::Reconstruction& reconstruction, const FlowSettings& settings,
                         Surface* surface, FlowOutcome* outcome);

}  // namespace wireskin
