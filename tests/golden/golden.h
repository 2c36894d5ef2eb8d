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
    {"octants", WSK_METHOD_STANKO, 0x0u},      {"saddle", WSK_METHOD_STANKO, 0x0u},
    {"band", WSK_METHOD_STANKO, 0x0u},         {"octants", WSK_METHOD_BIHARMONIC, 0x0u},
    {"octants", WSK_METHOD_TRIHARMONIC, 0x0u}, {"octants", WSK_METHOD_CLAMPED, 0x0u},
};
