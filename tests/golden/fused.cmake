# Sets `fused`: where the processor has fused multiply-add, the flags by which a compiler may use it
# (and must not).
set(fused "")
if(EXISTS /proc/cpuinfo)
  file(STRINGS /proc/cpuinfo flags REGEX "^flags.* fma .* avx2 |^flags.* avx2 .* fma " LIMIT_COUNT 1)
  if(flags)
    set(fused "-mavx2 -mfma")
  endif()
endif()
