// Prints the table of golden.h as it comes out now, one line a scene and method. Needs no doctest:
// variants.cmake builds it with every compiler at hand.
#include <cinttypes>
#include <cstdio>
#include <cstring>

#include "golden/golden.h"
#include "support/scenes.h"

int main(int argc, char** argv) {
  const bool by_array = argc > 1 && std::strcmp(argv[1], "--arrays") == 0;
  const char* const k_methods[] = {"STANKO",  "BIHARMONIC", "TRIHARMONIC",
                                   "CLAMPED", "ITERATED",   "FAIR"};
  int wrong = 0;
  for (const Golden& golden : k_golden) {
    for (const scenes::Scene& scene : scenes::all()) {
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
