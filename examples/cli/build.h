// From the network read to the library's surface, and from the library's report to one line.
//
// Curves are prepared first (joined where they almost meet, or integrated where only their tangents
// were measured); then their normals give the patches, or the curves alone do.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "arguments.h"
#include "network.h"
#include "wireskin.h"

namespace wireskin_cli {

struct FreeSurface {
  void operator()(wsk_surface* surface) const { wsk_surface_free(surface); }
};

struct FreeNetwork {
  void operator()(wsk_network* network) const { wsk_network_free(network); }
};

// What is known of a surface that was made of curves alone. The view's arrays are gone.
struct FlowSummary {
  wsk_flow_view view = {};
  std::vector<wsk_void> voids;
  std::vector<wsk_flow_patch> patches;
};

// The curves of a file as the library takes them, with what they point to.
struct GivenCurves {
  std::vector<double> positions, normals;
  std::vector<uint32_t> nodes;
  std::vector<wsk_curve> curves;  // points of their own come last, as curves of one sample
  size_t point_count = 0;
};

struct BuildResult {
  std::unique_ptr<wsk_surface, FreeSurface> surface;   // null if the status is not WSK_OK
  std::unique_ptr<wsk_network, FreeNetwork> prepared;  // null if not even the curves could be read
  std::unique_ptr<FlowSummary> flow;                   // null if normals gave the patches
  GivenCurves given;                                   // empty for measured tangents
  wsk_report report;

  // Empty if there is no network.
  wsk_network_view prepared_view() const;
};

// `cancel` and `progress` may be null, as in wsk_options.
struct BuildCallbacks {
  int32_t (*cancel)(void* user) = nullptr;
  void (*progress)(wsk_stage stage, double fraction, void* user) = nullptr;
  void* user = nullptr;
};

BuildResult build_surface(const Network& network, const Arguments& arguments,
                          const BuildCallbacks& callbacks);

// The line of the file that the place of the report speaks of; 0 if there is none.
size_t line_of(const Network& network, const wsk_report& report);

// "FILE: curve 3, sample 17: the normal has zero length (line 21)".
std::string failure_line(const std::string& file, const Network& network, const wsk_report& report);

}  // namespace wireskin_cli
