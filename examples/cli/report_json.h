// The library's report as JSON: valid whatever the file names and numbers are (bytes that are no
// UTF-8 become U+FFFD, numbers that JSON cannot hold become null).
#pragma once

#include <string>
#include <string_view>

#include "arguments.h"
#include "build.h"
#include "failure.h"

namespace wireskin_cli {

// What is known; null pointers for what there is not.
struct ReportInput {
  const Arguments& arguments;
  const wsk_report& report;
  const wsk_surface_view* surface = nullptr;
  const wsk_network_view* prepared = nullptr;
  const FlowSummary* flow = nullptr;
  size_t line = 0;  // of the input, that the place of the report speaks of
  std::vector<std::string> idle_options = {};  // given, but without effect
};

std::string report_json(const ReportInput& input);

// The same members for an input that could not be read: all counts are zero, the status is one of
// those of ReadFailure.
std::string read_failure_json(const Arguments& arguments, const ReadFailure& failure);

// The text in quotes, escaped.
std::string json_string(std::string_view text);

}  // namespace wireskin_cli
