// A context on the counting allocator for tests of single source files, and the small glue between
// library and standard containers.
#pragma once

#include <cstdint>
#include <random>
#include <stdexcept>
#include <vector>

#include "base/array.h"
#include "num/vec.h"
#include "support/faulty_allocator.h"

namespace unit {

using wireskin::Array;
using wireskin::Code;
using wireskin::k_none;
using wireskin::Span;
using wireskin::Status;
using wireskin::Vec2;
using wireskin::Vec3;

inline void must(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.sentence);
}

// Counts allocations and checkpoints, may fail one, or cancel, or cap the memory; the destructor of
// a test's last array leaves `allocator.clean()` true.
struct Heap {
  scenes::FaultyAllocator allocator;
  size_t checkpoints = 0;
  size_t cancel_at = SIZE_MAX;
  wireskin::Context context;

  explicit Heap(size_t cap = 0)
      : context({&allocator.allocate, &allocator.release, &allocator}, cap, callbacks(this)) {}

 private:
  static wireskin::Callbacks callbacks(Heap* self) {
    wireskin::Callbacks result;
    result.cancel = [](void* user) {
      Heap& heap = *static_cast<Heap*>(user);
      return heap.checkpoints++ == heap.cancel_at ? 1 : 0;
    };
    result.cancel_user = self;
    return result;
  }
};

template <typename T>
Span<T> span(std::vector<T>& v) {
  return {v.data(), v.size()};
}
template <typename T>
Span<const T> span(const std::vector<T>& v) {
  return {v.data(), v.size()};
}
// For calls whose parameter is a view of constants and whose argument is not.
template <typename T>
Span<const T> view(const std::vector<T>& v) {
  return {v.data(), v.size()};
}

template <typename T>
std::vector<T> to_vector(const Array<T>& a) {
  return std::vector<T>(a.begin(), a.end());
}

// Uniform in [-1, 1], the same numbers with every standard library.
struct Random {
  std::mt19937 engine;

  explicit Random(uint32_t seed) : engine(seed) {}
  double operator()() { return static_cast<double>(engine()) / 2147483648.0 - 1.0; }
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(engine() % n); }
};

}  // namespace unit
