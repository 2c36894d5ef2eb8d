// What the command says when it is done: one line of the surface, and one for whatever a person
// would not expect: patches left out, options that did nothing.
#pragma once

#include <string>
#include <vector>

#include "arguments.h"
#include "build.h"

namespace wireskin_cli {

// The options given that had no effect on this result, because of how its patches were found or
// because nothing that was written shows it: "--voids", with the reason.
struct IdleOption {
  std::string name;
  const char* reason;
};

std::vector<IdleOption> idle_options(const Arguments& arguments, const Network& network,
                                     const BuildResult& result);

// The names of the columns that were passed over, in quotes; "" for none.
std::string ignored_columns(const Network& network);

// Lines with their ends. `result` holds a surface.
std::string summary(const Arguments& arguments, const Network& network, const BuildResult& result,
                    double seconds);

}  // namespace wireskin_cli
