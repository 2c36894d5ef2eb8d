// What a person can do about a failure, where the sentence of the library does not say it.
#pragma once

#include <string>

#include "arguments.h"
#include "build.h"

namespace wireskin_cli {

// "; the file gives no normals ...", or "".
std::string failure_hint(const Arguments& arguments, const Network& network,
                         const BuildResult& result);

}  // namespace wireskin_cli
