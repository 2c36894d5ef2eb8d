// Builds networks through the C API and measures the result against the surface they were taken
// from.
#pragma once

#include <string>
#include <vector>

#include "closed_forms.h"
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

  bool is_free(size_t v) const { return vertex_curve[v] == WSK_NONE; }
};

Result build(const networks::Network& network, wsk_method method, double spacing);
Result smooth(const networks::BandMesh& mesh, wsk_method method);

// Root mean square and greatest distance of the free vertices.
struct Error {
  double rms = 0.0;
  double max = 0.0;
};
Error distance_error(const Result& result, const networks::Surface& surface);

// Greatest and mean angle, in degrees, between the normals of the mesh and those given on the
// curves.
struct Deviation {
  double mean = 0.0;
  double max = 0.0;
};
Deviation curve_normal_deviation(const Result& result);

}  // namespace accuracy
