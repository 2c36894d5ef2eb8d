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
    {"octants", WSK_METHOD_STANKO, 0x4dd627dbb6777194u},
    {"saddle", WSK_METHOD_STANKO, 0x88f8217504c0c314u},
    {"band", WSK_METHOD_STANKO, 0xa2655a6f7acc3859u},
    {"octants", WSK_METHOD_BIHARMONIC, 0x84cfcf068738117cu},
    {"octants", WSK_METHOD_TRIHARMONIC, 0x3644d899adc2c920u},
    {"octants", WSK_METHOD_CLAMPED, 0xc955dbd913d36d0eu},
    {"octants", WSK_METHOD_ITERATED, 0xcd1530772c5b0006u},
    {"noisy", WSK_METHOD_FAIR, 0xe99db8eb29254240u},
    {"band", WSK_METHOD_FAIR, 0x743514c6f40d67e1u},
    {"saddle", WSK_METHOD_FAIR, 0x63f5c9078edd2929u},
};
