#include "base/in_parts.h"

#include <doctest/doctest.h>

#include <vector>

#include "support/context.h"

using wireskin::Context;

static constexpr size_t k_part = wireskin::k_steps_per_checkpoint;

TEST_CASE("a pass in parts takes each index once, in order, and asks after every part") {
  for (const size_t count :
       {size_t{0}, size_t{1}, k_part - 1, k_part, k_part + 1, 2 * k_part + 7, 3 * k_part}) {
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
    CHECK(asked == count / k_part);
  }
}

TEST_CASE("a pass in parts ends where the caller cancels") {
  wireskin::Callbacks callbacks;
  callbacks.cancel = [](void*) { return int32_t{1}; };
  Context context({}, 0, callbacks);
  size_t done = 0;
  CHECK(in_parts(context, 3 * k_part, [&](size_t) { ++done; }).code == wireskin::Code::cancelled);
  CHECK(done == k_part);
}

TEST_CASE("a pace asks once so many steps have been made, however they are counted") {
  size_t asked = 0;
  wireskin::Callbacks callbacks;
  callbacks.cancel = [](void* user) { return int32_t{++*static_cast<size_t*>(user) == 3}; };
  callbacks.cancel_user = &asked;
  Context context({}, 0, callbacks);
  wireskin::Pace pace(context);
  for (size_t i = 0; i + 1 < k_part; ++i) REQUIRE(pace.after().ok());
  CHECK(asked == 0);
  CHECK(pace.after().ok());
  CHECK(asked == 1);
  CHECK(pace.after(k_part - 1).ok());
  CHECK(asked == 1);
  CHECK(pace.after(100 * k_part).ok());
  CHECK(asked == 2);
  pace.add(k_part - 2);
  CHECK(pace.after(1).ok());
  CHECK(pace.after(1).code == wireskin::Code::cancelled);
}

TEST_CASE("room made in parts keeps what there was, and grows as push() does") {
  constexpr size_t k_size = 2 * k_part + k_part / 4, k_half_more = k_size + k_size / 2;
  constexpr size_t k_many = 10 * k_part;
  unit::Heap heap;
  wireskin::Array<uint32_t> array(heap.context);
  const auto room = [&] { return array.capacity_bytes() / sizeof(uint32_t); };
  unit::must(make_room_in_parts(k_size, &array));
  CHECK(room() == k_size);
  CHECK(heap.checkpoints == 0);
  for (uint32_t i = 0; i < k_size; ++i) array.push_reserved(i);
  unit::must(make_room_in_parts(0, &array));
  CHECK(room() == k_size);
  unit::must(make_room_in_parts(1, &array));
  CHECK(room() == k_half_more);
  CHECK(heap.checkpoints == 2);
  // A cancelled call leaves all as it was.
  heap.cancel_at = 3;
  CHECK(make_room_in_parts(k_many, &array).code == wireskin::Code::cancelled);
  CHECK(room() == k_half_more);
  unit::must(make_room_in_parts(k_many, &array));
  CHECK(room() == k_size + k_many);
  REQUIRE(array.size() == k_size);
  for (uint32_t i = 0; i < k_size; ++i) REQUIRE(array[i] == i);
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
