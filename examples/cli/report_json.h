// The library's report as JSON: valid whatever the file names and numbers are (bytes that are no
// UTF-8 become U+FFFD, numbers that JSON cannot hold become null).
#pragma once

#include <string>
#include <string_view>

#include "arguments.h"
#include "build.h"
#include "wireskin.h"

namespace wireskin_cli {

// `flow` may be null: the patches came from normals.
std::string report_json(const Arguments& arguments, const wsk_report& report,
                        const FlowSummary* flow = nullptr);

// The text in quotes, escaped.
std::string json_string(std::string_view text);

}  // namespace wireskin_cli
