// An allocator for wsk_options that counts, checks sizes on release, fills fresh memory with a
// pattern or with small numbers (so that a read of what was never written changes the result) and
// fails on demand.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "support/fault_places.h"
#include "wireskin.h"

namespace scenes {

struct FaultyAllocator {
  static constexpr size_t k_never = SIZE_MAX;

  size_t fail_at = k_never;     // zero-based number of the allocation that fails
  bool fail_from_then = false;  // and all after it
  static constexpr int k_small_numbers = -1;
  int pattern = 0xcd;  // every fresh byte, or k_small_numbers: stale indices and counters

  size_t calls = 0;
  size_t live_bytes = 0;
  size_t live_blocks = 0;
  size_t peak_bytes = 0;
  std::vector<uint64_t>* places = nullptr;  // where given: running_calls() of each allocation
  bool wrong_release = false;               // a size that was not the one asked for, or a null
  Copies* copies = nullptr;  // where given: each allocation fails in copies of the process

  void install(wsk_options* options) {
    options->allocate = allocate;
    options->release = release;
    options->allocator_user = this;
  }
  bool clean() const { return live_bytes == 0 && live_blocks == 0 && !wrong_release; }

  static void* allocate(size_t bytes, void* user) {
    FaultyAllocator& self = *static_cast<FaultyAllocator*>(user);
    const size_t call = self.calls++;
    if (self.places != nullptr) self.places->push_back(running_calls());
    if (self.copies != nullptr && !self.copies->is_copy) self.fail_in_copies(call);
    if (call == self.fail_at || (self.fail_from_then && call > self.fail_at)) return nullptr;
    char* block = static_cast<char*>(std::malloc(bytes + k_header));
    if (block == nullptr) return nullptr;
    std::memcpy(block, &bytes, sizeof bytes);
    self.fill(block + k_header, bytes);
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
  // Once in one copy; and in another from then on, unless the first asked for nothing more.
  void fail_in_copies(size_t call) {
    for (const bool from_then : {false, true}) {
      const int said = copies->make();
      if (copies->is_copy) {
        fail_at = call;
        fail_from_then = from_then;
        return;
      }
      if (said != Copies::k_fine_after_more) return;
    }
  }

  void fill(char* memory, size_t bytes) {
    if (pattern != k_small_numbers) {
      std::memset(memory, pattern, bytes);
      return;
    }
    for (size_t i = 0; i < bytes; ++i) {
      random = 1664525 * random + 1013904223;
      memory[i] = i % 4 == 0 ? static_cast<char>(random >> 25) : '\0';
    }
  }

  uint32_t random = 1;
  static constexpr size_t k_header = 16;  // keeps the alignment of malloc
};

}  // namespace scenes
