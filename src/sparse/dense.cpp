#include "sparse/dense.h"

namespace wireskin::sparse {

#if (defined(__GNUC__) || defined(__clang__)) && !defined(_MSC_VER)
#define WIRESKIN_VECTORS(bytes) __attribute__((vector_size(bytes)))
#if defined(__x86_64__)
#define WIRESKIN_X86
#endif
#endif

namespace {

#ifdef WIRESKIN_VECTORS
typedef double Pair WIRESKIN_VECTORS(16);
typedef double Quad WIRESKIN_VECTORS(32);
typedef double Oct WIRESKIN_VECTORS(64);
#else
struct Pair {
  double v[2];
  Pair operator-(const Pair& o) const { return {{v[0] - o.v[0], v[1] - o.v[1]}}; }
  Pair operator+(const Pair& o) const { return {{v[0] + o.v[0], v[1] + o.v[1]}}; }
  Pair operator*(double s) const { return {{v[0] * s, v[1] * s}}; }
  Pair operator*(const Pair& o) const { return {{v[0] * o.v[0], v[1] * o.v[1]}}; }
};
#endif

}  // namespace

// Builds that count what tests reach set it to `inline`, or each copy would count for itself.
#ifndef WIRESKIN_INLINE
#ifdef WIRESKIN_VECTORS
#define WIRESKIN_INLINE __attribute__((always_inline)) inline
#else
#define WIRESKIN_INLINE inline
#endif
#endif
// A tile lives in registers only if the loops over it are unrolled, which gcc leaves undone at -O2.
#if defined(__GNUC__) && !defined(__clang__)
#define WIRESKIN_UNROLL _Pragma("GCC unroll 8")
#else
#define WIRESKIN_UNROLL
#endif

namespace baseline {
#define WIRESKIN_LANES 2
#define WIRESKIN_TARGET
#include "sparse/dense_kernels.inc"
#undef WIRESKIN_TARGET
#undef WIRESKIN_LANES
}  // namespace baseline

#ifdef WIRESKIN_X86
namespace avx2 {
#define WIRESKIN_LANES 4
#define WIRESKIN_TARGET __attribute__((target("avx2")))
#include "sparse/dense_kernels.inc"
#undef WIRESKIN_TARGET
#undef WIRESKIN_LANES
}  // namespace avx2

namespace avx512 {
#define WIRESKIN_LANES 8
#define WIRESKIN_TARGET __attribute__((target("avx512f")))
#include "sparse/dense_kernels.inc"
#undef WIRESKIN_TARGET
#undef WIRESKIN_LANES
}  // namespace avx512
#endif

#ifdef WIRESKIN_X86
struct CpuidAnswer {
  uint32_t a, b, c, d;
};

static CpuidAnswer cpuid(uint32_t leaf) {
  CpuidAnswer r;
  __asm__ volatile("cpuid" : "=a"(r.a), "=b"(r.b), "=c"(r.c), "=d"(r.d) : "a"(leaf), "c"(0));
  return r;
}

// The vector registers that the operating system keeps for us.
static uint32_t enabled_state() {
  uint32_t low = 0, high = 0;
  __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
  return low;
}

bool has_instructions(Instructions instructions) {
  constexpr uint32_t k_osxsave = 1u << 27, k_avx = 1u << 28, k_avx2 = 1u << 5, k_avx512f = 1u << 16;
  constexpr uint32_t k_ymm = 0x06, k_zmm = 0xe6;
  if (instructions == Instructions::baseline) return true;
  if (cpuid(0).a < 7) return false;
  const uint32_t basic = cpuid(1).c;
  if ((basic & k_osxsave) == 0 || (basic & k_avx) == 0) return false;
  const uint32_t extended = cpuid(7).b;
  const uint32_t state = enabled_state();
  if ((extended & k_avx2) == 0 || (state & k_ymm) != k_ymm) return false;
  if (instructions == Instructions::avx2) return true;
  return (extended & k_avx512f) != 0 && (state & k_zmm) == k_zmm;
}
#else
bool has_instructions(Instructions instructions) {
  return instructions == Instructions::baseline;
}
#endif

Instructions best_instructions() {
  if (has_instructions(Instructions::avx512)) return Instructions::avx512;
  return has_instructions(Instructions::avx2) ? Instructions::avx2 : Instructions::baseline;
}

static const DenseKernels k_baseline_kernels = {&baseline::update, &baseline::subtract_dots,
                                                &baseline::solve_block, &baseline::add_runs};
#ifdef WIRESKIN_X86
static const DenseKernels k_avx2_kernels = {&avx2::update, &avx2::subtract_dots, &avx2::solve_block,
                                            &avx2::add_runs};
static const DenseKernels k_avx512_kernels = {&avx512::update, &avx512::subtract_dots,
                                              &avx512::solve_block, &avx512::add_runs};
#endif

DenseKernels dense_kernels(Instructions instructions) {
#ifdef WIRESKIN_X86
  if (instructions == Instructions::avx512) return k_avx512_kernels;
  if (instructions == Instructions::avx2) return k_avx2_kernels;
#endif
  WIRESKIN_ASSERT(has_instructions(instructions));
  return k_baseline_kernels;
}

}  // namespace wireskin::sparse
