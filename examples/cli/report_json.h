// The library's report as JSON: valid whatever the file names and numbers are (bytes that are no
// UTF-8 become U+FFFD, numbers that JSON cannot hold become null).
#pragma once

#include <string>
#include <string_view>

#include "arguments.h"
#include "wireskin.h"

namespace wireskin_cli {

// `surface`: of the result, null where there is none; of its patches those are listed that were not
// meshed in their plane.
std::string report_json(const Arguments& arguments, const wsk_report& report,
                        const wsk_surface_view* surface = nullptr);

// The text in quotes, escaped.
std::string json_string(std::string_view text);

}  // namespace wireskin_cli
