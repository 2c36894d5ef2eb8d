#include "base/in_parts.h"

#include <doctest/doctest.h>

#include <vector>

#include "support/context.h"

using wireskin::Context;

TEST_CASE("a pass in parts takes each index once, in order, and asks after every part") {
  for (const size_t count : {0, 1, 4095, 4096, 4097, 10000, 12288}) {
    size_t asked = 0;
    wireskin::Callbacks callbacks;
    callbacks.cancel = [](void* user) {
      ++*static_cast<size_t*>(user);
      return int32_t{0};
    };
    callbacks.cancel_user = &asked;
    Context context({}, 0, callbacks);
    std::vector<size_t> seen;
    CHECK(in_parts(context, count, [&](size_t i) { seen.push_back(i); }).ok());
    REQUIRE(seen.size() == count);
    for (size_t i = 0; i < count; ++i) REQUIRE(seen[i] == i);
    CHECK(asked == count / 4096);
  }
}

TEST_CASE("a pass in parts ends where the caller cancels") {
  wireskin::Callbacks callbacks;
  callbacks.cancel = [](void*) { return int32_t{1}; };
  Context context({}, 0, callbacks);
  size_t done = 0;
  CHECK(in_parts(context, 10000, [&](size_t) { ++done; }).code == wireskin::Code::cancelled);
  CHECK(done == 4096);
}

TEST_CASE("a pace asks once so many steps have been made, however they are counted") {
  size_t asked = 0;
  wireskin::Callbacks callbacks;
  callbacks.cancel = [](void* user) { return int32_t{++*static_cast<size_t*>(user) == 3}; };
  callbacks.cancel_user = &asked;
  Context context({}, 0, callbacks);
  wireskin::Pace pace(context);
  for (size_t i = 0; i < 4095; ++i) REQUIRE(pace.after().ok());
  CHECK(asked == 0);
  CHECK(pace.after().ok());
  CHECK(asked == 1);
  CHECK(pace.after(4000).ok());
  CHECK(asked == 1);
  CHECK(pace.after(100000).ok());
  CHECK(asked == 2);
  pace.add(4000);
  CHECK(pace.after(95).ok());
  CHECK(pace.after(1).code == wireskin::Code::cancelled);
}

TEST_CASE("room made in parts keeps what there was, and grows as push() does") {
  unit::Heap heap;
  wireskin::Array<uint32_t> array(heap.context);
  const auto room = [&] { return array.capacity_bytes() / sizeof(uint32_t); };
  unit::must(make_room_in_parts(9000, &array));
  CHECK(room() == 9000);
  CHECK(heap.checkpoints == 0);
  for (uint32_t i = 0; i < 9000; ++i) array.push_reserved(i);
  unit::must(make_room_in_parts(0, &array));
  CHECK(room() == 9000);
  unit::must(make_room_in_parts(1, &array));
  CHECK(room() == 13500);
  CHECK(heap.checkpoints == 2);
  // A cancelled call leaves all as it was.
  heap.cancel_at = 3;
  CHECK(make_room_in_parts(50000, &array).code == wireskin::Code::cancelled);
  CHECK(room() == 13500);
  unit::must(make_room_in_parts(50000, &array));
  CHECK(room() == 59000);
  REQUIRE(array.size() == 9000);
  for (uint32_t i = 0; i < 9000; ++i) REQUIRE(array[i] == i);
}

TEST_CASE("arrays are filled and copied in parts, and a caller is asked by the way") {
  constexpr size_t k_light = wireskin::k_light_steps_per_checkpoint;
  for (const size_t size : {size_t{0}, size_t{5}, k_light - 1, k_light, 2 * k_light + 7}) {
    unit::Heap heap;
    wireskin::Array<uint32_t> array(heap.context), copy(heap.context), again(heap.context);
    unit::must(assign_in_parts(3, 1, &array));
    unit::must(assign_in_parts(size, 7, &array));
    REQUIRE(array.size() == size);
    for (const uint32_t value : array) REQUIRE(value == 7);
    for (size_t i = 0; i < size; ++i) array[i] = static_cast<uint32_t>(i);
    unit::must(copy_in_parts(array, &copy));
    unit::must(copy_in_parts(array.span(), &again));
    CHECK(heap.checkpoints == 3 * (size / k_light));
    REQUIRE(copy.size() == size);
    REQUIRE(again.size() == size);
    for (size_t i = 0; i < size; ++i) REQUIRE((copy[i] == i && again[i] == i));
    // A value may stand in the array that it fills.
    if (size == 5) {
      unit::must(assign_in_parts(3 * size, array[4], &array));
      for (const uint32_t value : array) REQUIRE(value == 4);
    }
    heap.cancel_at = heap.checkpoints;
    CHECK(assign_in_parts(k_light, 0, &array).code == wireskin::Code::cancelled);
  }
}

TEST_CASE("a pace of light steps asks less often") {
  unit::Heap heap;
  wireskin::Pace pace(heap.context, 10);
  for (int i = 0; i < 9; ++i) unit::must(pace.after());
  CHECK(heap.checkpoints == 0);
  unit::must(pace.after());
  CHECK(heap.checkpoints == 1);
}
