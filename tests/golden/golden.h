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
    {"octants", WSK_METHOD_STANKO, 0x4d65daff209c35c2u},
    {"saddle", WSK_METHOD_STANKO, 0x063f2889f06b9fefu},
    {"band", WSK_METHOD_STANKO, 0xca9b8ec3075f392cu},
    {"octants", WSK_METHOD_BIHARMONIC, 0x84cfcf068738117cu},
    {"octants", WSK_METHOD_TRIHARMONIC, 0x3644d899adc2c920u},
    {"octants", WSK_METHOD_CLAMPED, 0x24fb9a746cbdfd8fu},
};
