// From the network read to the library's surface, and from the library's report to one line.
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

// What is known of a surface that was made of curves alone. The view's arrays are gone.
struct FlowSummary {
  wsk_flow_view view = {};
  std::vector<wsk_void> voids;
  std::vector<wsk_flow_patch> patches;
};

struct BuildResult {
  std::unique_ptr<wsk_surface, FreeSurface> surface;  // null if the status is not WSK_OK
  wsk_report report;
  std::unique_ptr<FlowSummary> flow;  // null if normals gave the patches
};

// `cancel` and `progress` may be null, as in wsk_options.
struct BuildCallbacks {
  int32_t (*cancel)(void* user) = nullptr;
  void (*progress)(wsk_stage stage, double fraction, void* user) = nullptr;
  void* user = nullptr;
};

BuildResult build_surface(const Network& network, const Arguments& arguments,
                          const BuildCallbacks& callbacks);

// "FILE: curve 3, sample 17: the normal has zero length (line 21)".
std::string failure_line(const std::string& file, const Network& network, const wsk_report& report);

}  // namespace wireskin_cli
