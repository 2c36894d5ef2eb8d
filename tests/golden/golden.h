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
    {"octants", WSK_METHOD_STANKO, 0xe236025f01c41158u},
    {"saddle", WSK_METHOD_STANKO, 0x3634387a8f6565bcu},
    {"band", WSK_METHOD_STANKO, 0x000497db08bb5d3cu},
    {"noisy", WSK_METHOD_FAIR, 0xf95f68112ac6f76au},
    {"sphere_biharmonic", WSK_METHOD_BIHARMONIC, 0x4e9f5f2f3582ec5du},
    {"sphere_triharmonic", WSK_METHOD_TRIHARMONIC, 0x1ce0b681bc1a1b37u},
    {"sphere_clamped", WSK_METHOD_CLAMPED, 0x655b51da90ea95b2u},
    {"sphere_iterated", WSK_METHOD_ITERATED, 0x720e63011e607df7u},
    {"sphere_fair", WSK_METHOD_FAIR, 0x4daf1a6289ebd0c8u},
    {"saddle_fair", WSK_METHOD_FAIR, 0x86d8028f25b07e8eu},
    {"saddle_iterated", WSK_METHOD_ITERATED, 0xab0e9d84995cebedu},
    {"band_fair", WSK_METHOD_FAIR, 0x550263a2c87d6558u},
    {"band_iterated", WSK_METHOD_ITERATED, 0xe9f67d24484a09c2u},
    {"noise_given", WSK_METHOD_ITERATED, 0x2b1c4c5f38b18002u},
    {"soft", WSK_METHOD_ITERATED, 0x1547f6dd88c6c1fdu},
    {"soft_curve", WSK_METHOD_FAIR, 0xd54f3324c0e3b361u},
    {"box", WSK_METHOD_FAIR, 0x2a0dbf599459cae0u},
    {"box_stanko", WSK_METHOD_STANKO, 0x00aabc113fe52667u},
    {"box_bare", WSK_METHOD_ITERATED, 0x6b184414ba45f467u},
    {"jump", WSK_METHOD_FAIR, 0x7c7dae20e1c67d0eu},
    {"hole", WSK_METHOD_FAIR, 0xe10bb4c6c6ea7e4du},
    {"tube", WSK_METHOD_FAIR, 0x3e2c7120470dfa97u},
    {"one_circle", WSK_METHOD_ITERATED, 0xdb496f2d20dbacb9u},
    {"inner_loop", WSK_METHOD_STANKO, 0xaf41cfba0d383f6eu},
    {"held_points", WSK_METHOD_ITERATED, 0x4d9ddc76c38e4359u},
    {"dangling", WSK_METHOD_FAIR, 0x626a97e05fcb36c4u},
    {"two_spheres", WSK_METHOD_ITERATED, 0xaecf3ba2f17f82deu},
    {"partial", WSK_METHOD_STANKO, 0xdb7e27aaed01e47eu},
    {"torus", WSK_METHOD_FAIR, 0x5330f6880e2a4ac4u},
    {"fragments", WSK_METHOD_ITERATED, 0x73734ec85ee9d19au},
    {"segments", WSK_METHOD_FAIR, 0x797fe8534bdf719bu},
    {"flipped", WSK_METHOD_STANKO, 0x1f72d0d702348a23u},
    {"sensors", WSK_METHOD_FAIR, 0xf4d7164316fbda5eu},
    {"sensors_by_step", WSK_METHOD_ITERATED, 0xdb80fcafe03062a2u},
    {"flow_box", WSK_METHOD_FAIR, 0x65a652f38e481a7fu},
    {"flow_rooms", WSK_METHOD_FAIR, 0xa4293279de2d9051u},
    {"flow_normals", WSK_METHOD_ITERATED, 0x35f90a32fee7118bu},
    {"flow_bare", WSK_METHOD_FAIR, 0x0c562dcad53bb9f7u},
};
