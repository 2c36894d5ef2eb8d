// The committed hashes of the reference scenes. They change only together with a change of method
// that was meant to change results; `golden_print --header` writes this file anew.
#pragma once

#include <cstdint>

#include "wireskin.h"

struct Golden {
  const char* scene;
  wsk_method method;
  uint64_t hash;
};

inline constexpr Golden k_golden[] = {
    {"octants", WSK_METHOD_STANKO, 0x07c9fd7f3c2c14d2u},
    {"saddle", WSK_METHOD_STANKO, 0x2efbdae9c52f4279u},
    {"band", WSK_METHOD_STANKO, 0x5fe87831965f47acu},
    {"noisy", WSK_METHOD_FAIR, 0x3c1596edc2dd712du},
    {"sphere_biharmonic", WSK_METHOD_BIHARMONIC, 0x22f06c5e79a98f02u},
    {"sphere_triharmonic", WSK_METHOD_TRIHARMONIC, 0x4ee1faf6bcf6739du},
    {"sphere_clamped", WSK_METHOD_CLAMPED, 0x3134a00b7486d48fu},
    {"sphere_iterated", WSK_METHOD_ITERATED, 0x3321394191bbaf70u},
    {"sphere_fair", WSK_METHOD_FAIR, 0xbcd56b5e52932539u},
    {"saddle_fair", WSK_METHOD_FAIR, 0x6e2e291aa9c8ea63u},
    {"saddle_iterated", WSK_METHOD_ITERATED, 0x14d687ccf8c389a8u},
    {"band_fair", WSK_METHOD_FAIR, 0x154f69076539bb94u},
    {"band_iterated", WSK_METHOD_ITERATED, 0xf9c73d088316c6b4u},
    {"noise_given", WSK_METHOD_ITERATED, 0x6d8001078f10fed6u},
    {"soft", WSK_METHOD_ITERATED, 0x3df02997301b31dbu},
    {"soft_curve", WSK_METHOD_FAIR, 0xb20df582b8ffd416u},
    {"box", WSK_METHOD_FAIR, 0xc6ffb757760c827fu},
    {"box_stanko", WSK_METHOD_STANKO, 0xe6715dc62b4aa7b0u},
    {"box_bare", WSK_METHOD_ITERATED, 0xe9b2f6ff28e5ca36u},
    {"jump", WSK_METHOD_FAIR, 0x90b9f690b4070335u},
    {"hole", WSK_METHOD_FAIR, 0x00fc91ab51eedfdcu},
    {"tube", WSK_METHOD_FAIR, 0xf56a73e1075d1777u},
    {"one_circle", WSK_METHOD_ITERATED, 0xfb7a4c089d3f1c4du},
    {"inner_loop", WSK_METHOD_STANKO, 0x73c44cb0e3cfb098u},
    {"held_points", WSK_METHOD_ITERATED, 0x0b79c0a364a43298u},
    {"dangling", WSK_METHOD_FAIR, 0x2b2a76585d57247eu},
    {"two_spheres", WSK_METHOD_ITERATED, 0xa628fb00f24d9aacu},
    {"partial", WSK_METHOD_STANKO, 0x54a290756ec58c10u},
    {"untagged", WSK_METHOD_STANKO, 0x2efbdae9c52f4279u},
    {"torus", WSK_METHOD_FAIR, 0x5f5f944b7decd7c3u},
    {"fragments", WSK_METHOD_ITERATED, 0xc2f85fdfd65e7945u},
    {"segments", WSK_METHOD_FAIR, 0x2f990e49ff2ea44bu},
    {"flipped", WSK_METHOD_STANKO, 0x9c84d1f524cbd26du},
    {"sensors", WSK_METHOD_FAIR, 0x533412f4d4e2d1d4u},
    {"sensors_by_step", WSK_METHOD_ITERATED, 0xb882528d1dd7eb1fu},
    {"flow_box", WSK_METHOD_FAIR, 0x65a652f38e481a7fu},
    {"flow_rooms", WSK_METHOD_FAIR, 0x28d9edee0eac74b3u},
    {"flow_normals", WSK_METHOD_ITERATED, 0x918f179e3857971au},
    {"flow_bare", WSK_METHOD_FAIR, 0x02200de19e040c8eu},
};
