// Which allocations and checkpoints the fault tests try. WIRESKIN_FULL in the environment: all.
// Else a sample spread evenly, and each that is reached through calls that no place tried before
// was reached through, so that every TRY of the library returns its error at least once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <vector>

#include "support/copies.h"

#if __has_include(<execinfo.h>)
#include <execinfo.h>
#define SCENES_HAS_BACKTRACE 1
#endif

namespace scenes {

// The functions that are running, as one number; 0 where the system does not say. Under sanitizers,
// where each try takes long, those are told apart that differ in the innermost ones.
inline uint64_t running_calls() {
  uint64_t hash = 0;
#ifdef SCENES_HAS_BACKTRACE
#ifdef WIRESKIN_TESTS_SANITIZED
  constexpr int k_frames = 7;
#else
  constexpr int k_frames = 48;
#endif
  void* frames[k_frames];
  const int count = backtrace(frames, k_frames);
  for (int i = 0; i < count; ++i) {
    hash = (hash ^ reinterpret_cast<uintptr_t>(frames[i])) * 0x100000001b3u;
  }
#endif
  return hash;
}

inline bool tries_all_places() {
  return std::getenv("WIRESKIN_FULL") != nullptr;
}

// Whether all places are tried, and by copies of the process.
inline bool copies_at_all_places() {
  return tries_all_places() && can_copy();
}

struct FaultPlace {
  size_t index;
  bool sampled;  // one of the even sample; in the full tier all are
};

class FaultPlaces {
 public:
  explicit FaultPlaces(size_t sample) : sample_(sample) {}

  // `calls`: what running_calls() gave at each place, in order.
  std::vector<FaultPlace> choose(const std::vector<uint64_t>& calls) {
    std::vector<FaultPlace> places;
    const size_t step = std::max<size_t>(1, calls.size() / sample_);
    for (size_t i = 0; i < calls.size(); ++i) {
      const bool fresh = tried_.insert(calls[i]).second && calls[i] != 0;
      const bool sampled = i % step == 0 || tries_all_places();
      if (fresh || sampled) places.push_back({i, sampled});
    }
    return places;
  }

 private:
  size_t sample_;
  std::set<uint64_t> tried_;
};

}  // namespace scenes
