// Prints the table of golden.h as it comes out now, one line a scene and method, and last the flows
// that it lacks. Needs no doctest: variants.cmake builds it with every compiler at hand.
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <iterator>

#include "golden/golden.h"
#include "support/scenes.h"

int main(int argc, char** argv) {
  const bool by_array = argc > 1 && std::strcmp(argv[1], "--arrays") == 0;
  const char* const k_methods[] = {"STANKO",  "BIHARMONIC", "TRIHARMONIC",
                                   "CLAMPED", "ITERATED",   "FAIR"};
  std::vector<scenes::Scene> all = scenes::all();
  for (const scenes::Scene& flow : scenes::flows()) all.push_back(flow);
  std::vector<Golden> table(std::begin(k_golden), std::end(k_golden));
  for (const scenes::Scene& scene : all) {
    bool listed = !scene.flow;
    for (const Golden& golden : k_golden) listed = listed || scene.name == golden.scene;
    if (!listed) table.push_back({scene.name.c_str(), scene.method, 0});
  }
  int wrong = 0;
  for (const Golden& golden : table) {
    for (const scenes::Scene& scene : all) {
      if (scene.name != golden.scene) continue;
      const scenes::Result result = scenes::result_of(scene, golden.method);
      const uint64_t hash = scenes::hash_of(result);
      std::printf("    {\"%s\", WSK_METHOD_%s, 0x%016" PRIx64 "u},\n", golden.scene,
                  k_methods[golden.method], hash);
      if (by_array) std::printf("%s", scenes::hashes_by_array(result).c_str());
      wrong += hash != golden.hash;
    }
  }
  return wrong != 0;
}
