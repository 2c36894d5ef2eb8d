// Prints the golden hashes as they come out now, a line for each reference scene, and returns 1
// where they are not those of golden.h. Needs no doctest: other compilers and other machines run
// it.
//
//     golden_print --header > golden.h    the file anew
//     golden_print --arrays               with the hash of each array, to see where results part
#include "golden/golden.h"

#include <cinttypes>
#include <cstdio>
#include <cstring>

#include "support/scenes.h"

static const Golden* find_golden(const scenes::Scene& scene) {
  for (const Golden& golden : k_golden) {
    if (scene.name == golden.scene && scene.method == golden.method) return &golden;
  }
  return nullptr;
}

static const char k_head[] =
    "// The committed hashes of the reference scenes. They change only together with a change of "
    "method\n"
    "// that was meant to change results; `golden_print --header` writes this file anew.\n"
    "#pragma once\n\n#include <cstdint>\n\n#include \"wireskin.h\"\n\n"
    "struct Golden {\n  const char* scene;\n  wsk_method method;\n  uint64_t hash;\n};\n\n"
    "inline constexpr Golden k_golden[] = {\n";

int main(int argc, char** argv) {
  const bool by_array = argc > 1 && std::strcmp(argv[1], "--arrays") == 0;
  const bool header = argc > 1 && std::strcmp(argv[1], "--header") == 0;
  int wrong = 0;
  if (header) std::printf("%s", k_head);
  for (const scenes::Scene& scene : scenes::all()) {
    const scenes::Result result = scenes::result_of(scene);
    const uint64_t hash = scenes::hash_of(result);
    const Golden* golden = find_golden(scene);
    const bool equal = golden != nullptr && golden->hash == hash;
    wrong += !equal || result.triangles.empty();
    std::printf("    {\"%s\", WSK_METHOD_%s, 0x%016" PRIx64 "u},%s\n", scene.name.c_str(),
                scenes::name_of_method(scene.method), hash,
                equal || header ? "" : "  // not that of golden.h");
    if (by_array) std::printf("%s", scenes::hashes_by_array(result).c_str());
  }
  if (header) std::printf("};\n");
  return wrong != 0 && !header;
}
