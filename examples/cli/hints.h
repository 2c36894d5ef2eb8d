// What a person can do about a failure, where the sentence of the library does not say it.
#pragma once

#include <string>

#include "arguments.h"
#include "build.h"

namespace wireskin_cli {

// The option whose value the library refused for this network, with the value: "--soft 5"; "" where
// something else is at fault.
std::string option_at_fault(const Arguments& arguments, const wsk_report& report);

// "; the file gives no normals ...", or "".
std::string failure_hint(const Arguments& arguments, const Network& network,
                         const BuildResult& result);

}  // namespace wireskin_cli
