// The caller's memory in a fuzz target: one block, handed out from front to back and never twice in
// an execution, poisoned before and behind every piece and again where a piece was released. So
// AddressSanitizer sees what it sees with malloc, for a fraction of the time: a small execution is
// mostly allocations. What does not fit comes from malloc. Fresh memory is filled with a pattern.
#pragma once

#include <sanitizer/asan_interface.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "wireskin.h"

namespace fuzz {

class Arena {
 public:
  Arena() {
    ASAN_POISON_MEMORY_REGION(block_, used_);
    used_ = 0;
  }
  Arena(const Arena&) = delete;

  void install(wsk_options* options) {
    options->allocate = allocate;
    options->release = release;
    options->allocator_user = this;
  }

  // Whether all was given back, with the sizes that were asked for.
  bool clean() const { return live_blocks_ == 0 && live_bytes_ == 0 && !wrong_release_; }

  static void* allocate(size_t bytes, void* user) {
    Arena& self = *static_cast<Arena*>(user);
    const size_t room = (bytes + k_margin - 1) / k_margin * k_margin + k_margin;
    char* piece;
    if (bytes > k_size || room + k_margin > k_size - used_) {
      piece = static_cast<char*>(std::malloc(bytes + k_margin));
      if (piece == nullptr) return nullptr;
      ASAN_POISON_MEMORY_REGION(piece, k_margin);
    } else {
      piece = block_ + used_;
      used_ += room;
    }
    piece += k_margin;
    ASAN_UNPOISON_MEMORY_REGION(piece, bytes);
    std::memset(piece, 0xcd, bytes);
    write_size(piece, bytes);
    self.live_bytes_ += bytes;
    ++self.live_blocks_;
    return piece;
  }

  static void release(void* memory, size_t bytes, void* user) {
    Arena& self = *static_cast<Arena*>(user);
    char* piece = static_cast<char*>(memory);
    if (piece == nullptr || read_size(piece) != bytes) {
      self.wrong_release_ = true;
      return;
    }
    self.live_bytes_ -= bytes;
    --self.live_blocks_;
    if (piece < block_ || piece >= block_ + k_size) {
      ASAN_UNPOISON_MEMORY_REGION(piece - k_margin, k_margin);
      std::free(piece - k_margin);
      return;
    }
    write_size(piece, k_released);
    ASAN_POISON_MEMORY_REGION(piece, bytes);
  }

 private:
  static constexpr size_t k_size = size_t{1} << 22;
  static constexpr size_t k_margin = 32;  // a multiple of any alignment
  static constexpr size_t k_released = SIZE_MAX;

  // The size stands before the piece, where nobody else may look.
  __attribute__((no_sanitize("address"))) static size_t read_size(const char* piece) {
    return *reinterpret_cast<const size_t*>(piece - k_margin);
  }
  __attribute__((no_sanitize("address"))) static void write_size(char* piece, size_t size) {
    *reinterpret_cast<size_t*>(piece - k_margin) = size;
  }

  alignas(k_margin) static inline char block_[k_size];
  static inline size_t used_ = k_size;  // of the last execution; at first all is to be poisoned

  size_t live_bytes_ = 0;
  size_t live_blocks_ = 0;
  bool wrong_release_ = false;
};

}  // namespace fuzz
