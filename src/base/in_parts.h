// A pass over many things that may take longer than a caller wants to wait: body(i) for each index
// below `count`, in order, with a checkpoint after every part of 4096. Short passes have none, so
// that small calls are not slowed down; the stage that makes many of them has its own.
#pragma once

#include "base/array.h"

namespace wireskin {

template <class Body>
Status in_parts(Context& context, size_t count, const Body& body) {
  constexpr size_t k_part = 4096;
  // The body stands here once, or the compiler would make a call of it.
  for (size_t i = 0; i < count;) {
    const bool whole = count - i >= k_part;
    for (const size_t end = whole ? i + k_part : count; i < end; ++i) body(i);
    if (whole) TRY(context.checkpoint());
  }
  return {};
}

template <typename T>
Status copy_in_parts(const Array<T>& source, Array<T>* target) {
  TRY(target->resize(source.size()));
  return in_parts(target->context(), source.size(), [&](size_t i) { (*target)[i] = source[i]; });
}

}  // namespace wireskin
