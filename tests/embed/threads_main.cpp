// All reference scenes in two threads at once, and one large one whose bodies run on a pool: the
// same bits as alone, and nothing for ThreadSanitizer to say. threads.cmake builds and runs it.
#include <atomic>
#include <cstdio>
#include <thread>

#include "support/scenes.h"

static std::vector<uint64_t> hashes_of_all() {
  std::vector<uint64_t> hashes;
  for (const scenes::Scene& scene : scenes::all()) {
    hashes.push_back(scenes::hash_of(scenes::result_of(scene)));
  }
  return hashes;
}

static std::atomic<uint32_t> bodies;

static void in_three_threads(uint32_t count, void (*body)(uint32_t, void*), void* data, void*) {
  std::atomic<uint32_t> next{0};
  const auto work = [&] {
    for (uint32_t i; (i = next++) < count;) body(i, data);
  };
  bodies += count;
  std::thread a(work), b(work);
  work();
  a.join();
  b.join();
}

static uint64_t hash_of_large(bool parallel) {
  scenes::Scene scene = scenes::octants();
  scene.spacing = 0.02;
  wsk_options options = scenes::options_of(scene);
  if (parallel) options.parallel_for = in_three_threads;
  wsk_surface* surface = nullptr;
  if (scenes::run(scene, options, &surface, nullptr) != WSK_OK) return 0;
  const uint64_t hash = scenes::hash_of(scenes::copy_of(surface));
  wsk_surface_free(surface);
  return hash;
}

int main() {
  std::vector<uint64_t> first, second;
  std::thread one([&] { first = hashes_of_all(); });
  std::thread two([&] { second = hashes_of_all(); });
  one.join();
  two.join();
  const uint64_t alone = hash_of_large(false), shared = hash_of_large(true);
  std::printf("%zu scenes in two threads, %u bodies in three\n", first.size(), bodies.load());
  const bool equal = first == second && alone == shared && alone != 0;
  return equal && first.size() > 20 && bodies > 0 ? 0 : 1;
}
