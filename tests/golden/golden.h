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
    {"octants", WSK_METHOD_STANKO, 0x90061480e7397662u},
    {"saddle", WSK_METHOD_STANKO, 0x970020a608dc28f5u},
    {"band", WSK_METHOD_STANKO, 0xca9b8ec3075f392cu},
    {"octants", WSK_METHOD_BIHARMONIC, 0x436781bdc93ba967u},
    {"octants", WSK_METHOD_TRIHARMONIC, 0x9a8f1579bd3503e0u},
    {"octants", WSK_METHOD_CLAMPED, 0x7ae96e60f34d56c8u},
};
