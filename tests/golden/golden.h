// The committed hashes of the reference scenes. They change only together with a change of method
// that was meant to change results; golden_print writes the table anew.
#pragma once

#include <cstdint>

#include "wireskin.h"

struct Golden {
  const char* scene;
  wsk_method method;
  uint64_t hash;
};

inline constexpr Golden k_golden[] = {
    {"octants", WSK_METHOD_STANKO, 0xe236025f01c41158u},
    {"saddle", WSK_METHOD_STANKO, 0x3634387a8f6565bcu},
    {"band", WSK_METHOD_STANKO, 0x000497db08bb5d3cu},
    {"octants", WSK_METHOD_BIHARMONIC, 0x551cd2adbf99ff0du},
    {"octants", WSK_METHOD_TRIHARMONIC, 0x4a6640952ca6cff7u},
    {"octants", WSK_METHOD_CLAMPED, 0x7246a404acf3e9e4u},
    {"octants", WSK_METHOD_ITERATED, 0x1b3c8c998ab1cd7bu},
    {"noisy", WSK_METHOD_FAIR, 0xf95f68112ac6f76au},
    {"band", WSK_METHOD_FAIR, 0x86ba29475ec9871bu},
    {"saddle", WSK_METHOD_FAIR, 0xe36f15b3dbd4916fu},
};
