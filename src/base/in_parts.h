// A pass over many things that may take longer than a caller wants to wait: body(i) for each index
// below `count`, in order, with a checkpoint after every part of 4096, or of another size for steps
// that take next to no time. Short passes have none, so that small calls are not slowed down; the
// stage that makes many of them has its own.
//
// Pace is for loops whose steps can fail or are of unequal work: they say how many steps they made,
// and the checkpoint comes with the 4096th.
#pragma once

#include "base/array.h"

namespace wireskin {

// Set shorter in builds that count what tests reach, so that small scenes pass the checkpoints of
// large ones; no result depends on it.
#ifndef WIRESKIN_STEPS_PER_CHECKPOINT
#define WIRESKIN_STEPS_PER_CHECKPOINT 4096
#endif
inline constexpr size_t k_steps_per_checkpoint = WIRESKIN_STEPS_PER_CHECKPOINT;

template <size_t k_part = k_steps_per_checkpoint, class Body>
Status in_parts(Context& context, size_t count, const Body& body) {
  // The body stands here once, or the compiler would make a call of it.
  for (size_t i = 0; i < count;) {
    const bool whole = count - i >= k_part;
    for (const size_t end = whole ? i + k_part : count; i < end; ++i) body(i);
    if (whole) TRY(context.checkpoint());
  }
  return {};
}

// For steps that take next to no time, as those that only fill or copy: most of what these cost is
// that the system brings fresh memory.
inline constexpr size_t k_light_steps_per_checkpoint = 16 * k_steps_per_checkpoint;

// The array alone says what T is.
template <typename T>
Status assign_in_parts(size_t size, const std::enable_if_t<true, T>& value, Array<T>* array) {
  const T kept = value;  // it may live in the memory that resize() gives back
  TRY(array->resize_anew(size));
  return in_parts<k_light_steps_per_checkpoint>(array->context(), size,
                                                [&](size_t i) { (*array)[i] = kept; });
}

// `source`: an array or a span.
template <typename Source, typename T>
Status copy_in_parts(const Source& source, Array<T>* target) {
  TRY(target->resize(source.size()));
  return in_parts<k_light_steps_per_checkpoint>(target->context(), source.size(),
                                                [&](size_t i) { (*target)[i] = source[i]; });
}

// Room for so many elements more, growing by a half at least, as push() does; for arrays so large
// that to move them takes its time.
template <typename T>
Status make_room_in_parts(size_t more, Array<T>* array) {
  const size_t room = array->capacity_bytes() / sizeof(T), size = array->size();
  if (more <= room - size) return {};
  Array<T> larger(array->context());
  TRY(larger.reserve(size + more > room + room / 2 ? size + more : room + room / 2));
  TRY(in_parts(array->context(), size, [&](size_t i) { larger.push_reserved((*array)[i]); }));
  *array = static_cast<Array<T>&&>(larger);
  return {};
}

class Pace {
 public:
  explicit Pace(Context& context, size_t steps_per_checkpoint = k_steps_per_checkpoint)
      : context_(context), most_(steps_per_checkpoint) {}

  // Counts only; for places that have no status to return.
  void add(size_t steps) { steps_ += steps; }

  Status after(size_t steps = 1) {
    steps_ += steps;
    if (steps_ < most_) return {};
    steps_ = 0;
    return context_.checkpoint();
  }

 private:
  Context& context_;
  size_t most_;
  size_t steps_ = 0;
};

}  // namespace wireskin
