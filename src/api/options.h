// Reading the structs of options: what every one of them is asked first, and what the options that
// all calls share mean inside. Nothing else reads a caller's struct, whose size may be that of an
// older version.
#pragma once

#include <cstring>

#include "network/smoothing.h"
#include "num/scale.h"
#include "wireskin.h"

namespace wireskin::api {

inline size_t least(size_t a, size_t b) {
  return a < b ? a : b;
}

inline bool finite_and_not_negative(double x) {
  return x >= 0.0 && x - x == 0.0;
}

// Copies a caller's struct over the defaults that stand in *out, as much of it as his version has.
// Null leaves the defaults. A size below `least_size`, that of the first release, means that he
// forgot to initialise.
template <typename Struct>
Status read_struct(const Struct* given, size_t least_size, const char* not_initialised,
                   Struct* out) {
  if (given == nullptr) return {};
  if (given->size < least_size) return fail(Code::bad_argument, not_initialised);
  std::memcpy(out, given, least(given->size, sizeof *out));
  return {};
}

// Fills a caller's struct with defaults, as much of it as his version has.
template <typename Struct>
void write_defaults(const Struct& defaults, size_t size, Struct* out) {
  std::memset(out, 0, size);
  std::memcpy(out, &defaults, least(size, sizeof defaults));
  out->size = size;
}

inline constexpr size_t k_options_size = offsetof(wsk_options, now_user) + sizeof(void*);

Status read_options(const wsk_options* given, wsk_options* options);
Allocator allocator_of(const wsk_options& options);
Callbacks callbacks_of(const wsk_options& options);

// fair looks for noise unless told otherwise; the other methods take the samples as they are.
network::SmoothingOptions smoothing_of(const wsk_options& options, const Scale& scale);

}  // namespace wireskin::api
