// The ground every other file stands on: the compiler settings without which the promise of equal
// bits on every target cannot be kept, checked at compile time, and the assertion macro.
//
// Invariants: IEEE double arithmetic without excess precision, reassociation or fused multiply-add.
// Assertions state lemmas about our own code; bad input never reaches one. They are compiled in
// only where WIRESKIN_DEBUG is defined (tests and sanitizer builds), so a release cannot abort its
// host.
#pragma once

#include <cfloat>
#include <cstddef>
#include <cstdint>

#ifdef __FAST_MATH__
#error "wireskin promises the same bits everywhere: build it without -ffast-math"
#endif
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0
#error "wireskin needs plain double arithmetic: on 32-bit x86 build with -msse2 -mfpmath=sse"
#endif

// CMake passes -ffp-contract=off; whoever compiles the single header without it gets the same here.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#endif

#ifdef WIRESKIN_DEBUG
#include <cassert>
#define WIRESKIN_ASSERT(condition) assert(condition)
#else
#define WIRESKIN_ASSERT(condition) ((void)0)
#endif

namespace wireskin {

// "No such curve, vertex, triangle ...": every index in the library is a uint32_t, and this is
// none.
inline constexpr uint32_t k_none = 0xffffffffu;

}  // namespace wireskin
