// make_networks OUTPUT_DIR [SPOT.obj]: writes the networks of examples/data, that of the cow only
// where its mesh is given.
// make_networks --check FILE...: traces the cycles of networks and judges every patch; exit status
// 1 where a patch cannot be seen without folds along its mean normal.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "io.h"
#include "shipped.h"
#include "trace.h"

namespace networks {

static void write_shipped(const std::string& folder, const Shipped& shipped) {
  write_network(folder + "/" + shipped.file, shipped.network);
  std::printf("%s: %zu vertices, %zu curves\n", shipped.file.c_str(),
              shipped.network.positions.size(), shipped.network.curves.size());
}

static bool check(const std::string& path) {
  const Network network = read_network(path);
  const Trace result = trace(network);
  std::printf(
      "%s: %zu vertices, %zu curves, %zu nodes, %zu segments, %zu patches, "
      "%zu components, Euler characteristic %ld\n",
      path.c_str(), network.positions.size(), network.curves.size(), result.nodes, result.segments,
      result.patches.size(), result.components, result.euler_characteristic());
  bool good = true;
  for (size_t i = 0; i < result.patches.size(); ++i) {
    const Patch& patch = result.patches[i];
    std::printf("  patch %2zu: %3zu vertices, |mean normal| %.3f, least facing %+.3f, %s\n", i,
                patch.vertices.size(), patch.mean_normal, patch.least_facing,
                !patch.simple  ? "FOLDED"
                : patch.robust ? "simple"
                               : "simple, not if tilted");
    good = good && patch.simple;
  }
  return good;
}

static int run(const std::vector<std::string>& arguments) {
  const bool checking = !arguments.empty() && arguments[0] == "--check";
  if (checking ? arguments.size() < 2 : arguments.empty() || arguments.size() > 2) {
    std::fprintf(stderr,
                 "usage: make_networks OUTPUT_DIR [SPOT.obj]\n"
                 "       make_networks --check FILE...\n");
    return 2;
  }
  if (checking) {
    bool good = true;
    for (size_t i = 1; i < arguments.size(); ++i) good = check(arguments[i]) && good;
    return good ? 0 : 1;
  }
  for (const Shipped& shipped : shipped_closed_forms()) write_shipped(arguments[0], shipped);
  if (arguments.size() == 2) write_shipped(arguments[0], shipped_spot(read_obj(arguments[1])));
  return 0;
}

}  // namespace networks

int main(int count, char** arguments) {
  try {
    return networks::run({arguments + 1, arguments + count});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_networks: %s\n", error.what());
    return 1;
  }
}
