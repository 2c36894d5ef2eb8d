// What a failable function returns: a code, one English sentence and the place in the caller's
// input that the sentence speaks of. Statuses are plain values; nothing here allocates.
//
// The sentence is a string literal, without the place, without a full stop: "the normal has zero
// length". Whoever shows it puts the place in front. Indices in a Place are zero-based, k_none
// means "does not apply".
#pragma once

#include "base/platform.h"

namespace wireskin {

// The numbers are those of the public header (api.cpp checks that they agree) and never change.
enum class Code : int32_t {
  ok = 0,
  bad_argument = 1,
  out_of_memory = 2,
  memory_cap = 3,
  cancelled = 4,
  too_large = 5,
  empty = 6,
  too_few_samples = 7,
  not_a_number = 8,
  infinite = 9,
  zero_length_curve = 10,
  duplicate_samples = 11,
  zero_normal = 12,
  missing_normals = 13,
  index_out_of_range = 14,
  node_mismatch = 15,
  open_network = 16,
  inconsistent_normals = 17,
  tangent_normal = 18,
  patch_without_plane = 19,
  patch_folded = 20,
  patch_several_loops = 21,
  bad_mesh = 22,
  unconstrained = 23,
  not_positive_definite = 24,
};

struct Place {
  uint32_t curve = k_none;
  uint32_t sample = k_none;
  uint32_t node = k_none;
  uint32_t patch = k_none;
  uint32_t vertex = k_none;
  uint32_t triangle = k_none;
};

struct [[nodiscard]] Status {
  Code code = Code::ok;
  const char* sentence = "";
  Place place = {};

  bool ok() const { return code == Code::ok; }
};

inline Status fail(Code code, const char* sentence, const Place& place = {}) {
  return {code, sentence, place};
}

inline Status fail_at_sample(Code code, const char* sentence, uint32_t curve, uint32_t sample) {
  Place place;
  place.curve = curve;
  place.sample = sample;
  return {code, sentence, place};
}

inline Status fail_at_patch(Code code, const char* sentence, uint32_t patch) {
  Place place;
  place.patch = patch;
  return {code, sentence, place};
}

}  // namespace wireskin

// Hands a failure up to the caller; the whole of our error propagation.
#define TRY(expression)                                          \
  do {                                                           \
    const ::wireskin::Status wireskin_try_status = (expression); \
    if (!wireskin_try_status.ok()) return wireskin_try_status;   \
  } while (0)
