// What one call of the library carries through every stage: the caller's allocator with the memory
// cap, the cancel and progress callbacks and the optional clock. There is no global state, so calls
// on different contexts are independent of each other, in any number of threads.
//
// Cost: one counter update per allocation, one callback per checkpoint. Stages call checkpoint() at
// least once in about 10 ms of work (release build), never in an innermost loop.
#pragma once

#include <cstring>

#include "base/status.h"

namespace wireskin {

// Memory from `allocate` must be aligned for double and pointers; null means failure. `release`
// gets the size that was asked for. Both get `user`.
struct Allocator {
  void* (*allocate)(size_t bytes, void* user) = nullptr;
  void (*release)(void* memory, size_t bytes, void* user) = nullptr;
  void* user = nullptr;
};

// The stages in the order in which they run; the numbers are those of the public header.
enum class Stage : int32_t {
  input = 0,
  curves = 1,
  network = 2,
  patches = 3,
  operators = 4,
  factor = 5,
  solve = 6,
  result = 7,
};
inline constexpr int k_stage_count = 8;

struct Callbacks {
  int32_t (*cancel)(void* user) = nullptr;  // non-zero: stop as soon as possible
  void* cancel_user = nullptr;
  void (*progress)(int32_t stage, double fraction, void* user) = nullptr;
  void* progress_user = nullptr;
  double (*now)(void* user) = nullptr;  // milliseconds from any origin
  void* now_user = nullptr;
  // Calls body(index, data) for every index below `count`, in any order and on any threads, and
  // returns when all are done.
  void (*parallel_for)(uint32_t count, void (*body)(uint32_t index, void* data), void* data,
                       void* user) = nullptr;
  void* parallel_for_user = nullptr;
};

class Context {
 public:
  Context(const Allocator& allocator, size_t memory_cap, const Callbacks& callbacks)
      : allocator_(allocator), cap_(memory_cap), callbacks_(callbacks) {}
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Memory of `count` elements of `size` bytes, or a status; a product that does not fit size_t is
  // `too_large`, a request beyond the cap `memory_cap`. count == 0 gives null and ok.
  Status allocate(size_t count, size_t size, void** memory) {
    *memory = nullptr;
    if (count == 0) return {};
    if (count > SIZE_MAX / 2 / size) return fail(Code::too_large, k_too_large);
    const size_t bytes = count * size;
    if (cap_ != 0 && (bytes > cap_ || used_ > cap_ - bytes)) {
      return fail(Code::memory_cap, "the memory cap does not allow another allocation");
    }
    *memory = allocator_.allocate(bytes, allocator_.user);
    if (*memory == nullptr) return fail(Code::out_of_memory, "the allocator returned no memory");
    used_ += bytes;
    if (used_ > peak_) peak_ = used_;
    return {};
  }

  void release(void* memory, size_t count, size_t size) {
    // The count first: where a loop would set the elements, were there any, gcc 12 takes the pointer
    // for one that cannot be null.
    if (count == 0 || memory == nullptr) return;
    used_ -= count * size;
    allocator_.release(memory, count * size, allocator_.user);
  }

  Status checkpoint() {
    if (callbacks_.cancel != nullptr && callbacks_.cancel(callbacks_.cancel_user) != 0) {
      return fail(Code::cancelled, "the caller cancelled");
    }
    return {};
  }

  // Announces that `fraction` (0 to 1) of the current stage is done; also a checkpoint.
  Status progress(double fraction) {
    if (callbacks_.progress != nullptr) {
      callbacks_.progress(static_cast<int32_t>(stage_), fraction, callbacks_.progress_user);
    }
    return checkpoint();
  }

  bool is_parallel() const { return callbacks_.parallel_for != nullptr; }

  // The bodies may run at the same time: they share no memory that one of them writes, and know
  // nothing of this context, so that allocation, checkpoints and progress stay with the caller.
  void for_each(uint32_t count, void (*body)(uint32_t index, void* data), void* data) {
    if (is_parallel() && count > 1) {
      callbacks_.parallel_for(count, body, data, callbacks_.parallel_for_user);
      return;
    }
    for (uint32_t i = 0; i < count; ++i) body(i, data);
  }

  // Closes the books of the running stage and opens those of `stage`.
  Status enter(Stage stage) {
    stop_clock();
    stage_ = stage;
    start_clock();
    return progress(0.0);
  }

  void stop_clock() {
    if (callbacks_.now == nullptr || !running_) return;
    milliseconds_[static_cast<int>(stage_)] += callbacks_.now(callbacks_.now_user) - since_;
    running_ = false;
  }

  // For a context that outlives its call: the callbacks' users may not.
  void forget_callbacks() {
    stop_clock();
    callbacks_ = {};
  }

  // Numerical factorisations so far, for the report.
  void count_factorisation() { ++factorisations_; }
  uint32_t factorisations() const { return factorisations_; }

  // Iterations that stood in for a factorisation which did not fit under the memory cap.
  void count_iterations(uint32_t count) {
    iterations_ += count;
    iterative_ = true;
  }
  uint32_t iterations() const { return iterations_; }
  bool is_iterative() const { return iterative_; }

  Stage stage() const { return stage_; }
  double milliseconds(int stage) const { return milliseconds_[stage]; }
  size_t used_bytes() const { return used_; }
  size_t peak_bytes() const { return peak_; }
  // What the cap still allows, SIZE_MAX without one.
  size_t room_bytes() const { return cap_ == 0 ? SIZE_MAX : cap_ - used_; }
  const Allocator& allocator() const { return allocator_; }

 private:
  static constexpr const char* k_too_large = "the size needed does not fit the address space";

  void start_clock() {
    if (callbacks_.now == nullptr) return;
    since_ = callbacks_.now(callbacks_.now_user);
    running_ = true;
  }

  Allocator allocator_;
  size_t cap_;
  Callbacks callbacks_;
  size_t used_ = 0;
  size_t peak_ = 0;
  uint32_t factorisations_ = 0;
  uint32_t iterations_ = 0;
  bool iterative_ = false;
  Stage stage_ = Stage::input;
  double milliseconds_[k_stage_count] = {};
  double since_ = 0.0;
  bool running_ = false;
};

}  // namespace wireskin
