// An allocator for wsk_options that counts, checks sizes on release, fills fresh memory with a
// pattern (so that a read of what was never written changes the result) and fails on demand.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "wireskin.h"

namespace scenes {

struct FaultyAllocator {
  static constexpr size_t k_never = SIZE_MAX;

  size_t fail_at = k_never;     // zero-based number of the allocation that fails
  bool fail_from_then = false;  // and all after it
  int pattern = 0xcd;

  size_t calls = 0;
  size_t live_bytes = 0;
  size_t live_blocks = 0;
  size_t peak_bytes = 0;
  bool wrong_release = false;  // a size that was not the one asked for, or a null

  void install(wsk_options* options) {
    options->allocate = allocate;
    options->release = release;
    options->allocator_user = this;
  }
  bool clean() const { return live_bytes == 0 && live_blocks == 0 && !wrong_release; }

  static void* allocate(size_t bytes, void* user) {
    FaultyAllocator& self = *static_cast<FaultyAllocator*>(user);
    const size_t call = self.calls++;
    if (call == self.fail_at || (self.fail_from_then && call > self.fail_at)) return nullptr;
    char* block = static_cast<char*>(std::malloc(bytes + k_header));
    if (block == nullptr) return nullptr;
    std::memcpy(block, &bytes, sizeof bytes);
    std::memset(block + k_header, self.pattern, bytes);
    self.live_bytes += bytes;
    ++self.live_blocks;
    if (self.live_bytes > self.peak_bytes) self.peak_bytes = self.live_bytes;
    return block + k_header;
  }

  static void release(void* memory, size_t bytes, void* user) {
    FaultyAllocator& self = *static_cast<FaultyAllocator*>(user);
    if (memory == nullptr) {
      self.wrong_release = true;
      return;
    }
    char* block = static_cast<char*>(memory) - k_header;
    size_t asked;
    std::memcpy(&asked, block, sizeof asked);
    if (asked != bytes) self.wrong_release = true;
    self.live_bytes -= asked;
    --self.live_blocks;
    std::free(block);
  }

 private:
  static constexpr size_t k_header = 16;  // keeps the alignment of malloc
};

}  // namespace scenes
