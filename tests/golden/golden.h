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
    {"octants", WSK_METHOD_STANKO, 0x6b75fe2bb45ef952u},
    {"saddle", WSK_METHOD_STANKO, 0x98b60a2eee2838b9u},
    {"band", WSK_METHOD_STANKO, 0x7f7ead32c20552acu},
    {"noisy", WSK_METHOD_FAIR, 0xb688245bdc86f46du},
    {"sphere_biharmonic", WSK_METHOD_BIHARMONIC, 0xc52ad37aaa9f7f82u},
    {"sphere_triharmonic", WSK_METHOD_TRIHARMONIC, 0x80f7d8d1384b12ddu},
    {"sphere_clamped", WSK_METHOD_CLAMPED, 0xf89c116346e4604fu},
    {"sphere_iterated", WSK_METHOD_ITERATED, 0x1a24d13a4d4a0b70u},
    {"sphere_fair", WSK_METHOD_FAIR, 0xa4af8e0e0b86cb79u},
    {"saddle_fair", WSK_METHOD_FAIR, 0x7fc802e8851bcb23u},
    {"saddle_iterated", WSK_METHOD_ITERATED, 0xe938f0df4155b3a8u},
    {"band_fair", WSK_METHOD_FAIR, 0x0b76a2a67c628094u},
    {"band_iterated", WSK_METHOD_ITERATED, 0x036cbdb1142d53b4u},
    {"noise_given", WSK_METHOD_ITERATED, 0xa9589cd3b4c2c456u},
    {"soft", WSK_METHOD_ITERATED, 0xe1799cec1b8b309bu},
    {"soft_curve", WSK_METHOD_FAIR, 0x021b4072fca4e996u},
    {"box", WSK_METHOD_FAIR, 0xd97e2bef30b89baeu},
    {"box_stanko", WSK_METHOD_STANKO, 0xe274b120e7df6198u},
    {"box_bare", WSK_METHOD_ITERATED, 0xdeed8f9b4702db8au},
    {"jump", WSK_METHOD_FAIR, 0x29279eb07b12c6c9u},
    {"hole", WSK_METHOD_FAIR, 0x572f6f43e3af76dcu},
    {"tube", WSK_METHOD_FAIR, 0x6d9f202c5a991d37u},
    {"one_circle", WSK_METHOD_ITERATED, 0xc2951f5ce0fe678du},
    {"inner_loop", WSK_METHOD_STANKO, 0xc201972a14c21698u},
    {"held_points", WSK_METHOD_ITERATED, 0xdd16aae560e71898u},
    {"dangling", WSK_METHOD_FAIR, 0xe0244d7b36e213feu},
    {"two_spheres", WSK_METHOD_ITERATED, 0x39f8672d405065acu},
    {"partial", WSK_METHOD_STANKO, 0xe25f2c4d529a1010u},
    {"untagged", WSK_METHOD_STANKO, 0x98b60a2eee2838b9u},
    {"torus", WSK_METHOD_FAIR, 0x3deb32c2595c1083u},
    {"fragments", WSK_METHOD_ITERATED, 0xd68a53965b044285u},
    {"segments", WSK_METHOD_FAIR, 0x258a77533565bf0bu},
    {"flipped", WSK_METHOD_STANKO, 0x11e4c62fcd6ba5adu},
    {"sensors", WSK_METHOD_FAIR, 0x70a461ed43a726d4u},
    {"sensors_by_step", WSK_METHOD_ITERATED, 0x1159e50268689adfu},
    {"flow_box", WSK_METHOD_FAIR, 0xca4e79bb6f8213cdu},
    {"flow_rooms", WSK_METHOD_FAIR, 0x80b6d3f1d8b5fd5bu},
    {"flow_normals", WSK_METHOD_ITERATED, 0x1954222ad789cd9au},
    {"flow_bare", WSK_METHOD_FAIR, 0x62ecbedd9e7b0218u},
};
