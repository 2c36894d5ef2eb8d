// Builds networks through the C API and measures the result against the surface they were taken
// from.
#pragma once

#include <string>
#include <vector>

#include "closed_forms.h"
#include "cut.h"
#include "network.h"
#include "wireskin.h"

namespace accuracy {

// A surface copied out of its handle, with its report.
struct Result {
  wsk_status status = WSK_OK;
  wsk_report report;
  std::vector<networks::Point> positions, normals, constraint_normals;
  std::vector<double> mean_curvature;
  std::vector<uint32_t> vertex_curve, triangles, patches;
  std::vector<uint32_t> guarded;  // the patches that were held back

  bool is_free(size_t v) const { return vertex_curve[v] == WSK_NONE; }
};

networks::Mesh mesh_of(const Result& result);

// Defaults, with a clock; spacing 0 is the library's.
wsk_options options_for(wsk_method method, double spacing);

Result build(const wsk_curve* curves, size_t count, const wsk_options& options);
Result build(const networks::Network& network, const wsk_options& options);
Result build(const networks::Network& network, wsk_method method, double spacing);
Result smooth(const networks::BandMesh& mesh, wsk_method method);

// Root mean square and greatest distance of the free vertices.
struct Error {
  double rms = 0.0;
  double max = 0.0;
};
Error distance_error(const Result& result, const networks::Surface& surface);

// Mean and greatest angle, in degrees, between the normals of the mesh and those given on the
// curves.
struct Deviation {
  double mean = 0.0;
  double max = 0.0;
};
Deviation curve_normal_deviation(const Result& result);

// The same between the normals of the mesh at free vertices and those of the surface next to them.
Deviation normal_deviation(const Result& result, const networks::Surface& surface);

// The greatest angle on the curves that no method can avoid: the normals of a mesh differ from the
// surface's, at an open border by half a triangle's bend. That of the same mesh with all vertices
// put on the surface.
double unavoidable_deviation(const Result& result, const networks::Surface& surface);

// area * integral |grad H|^2 with H linear on each triangle: how much the surface ripples, whatever
// its size. Triangles at an open border are left out, where H is one-sided.
double ripple_energy(const Result& result);

}  // namespace accuracy
