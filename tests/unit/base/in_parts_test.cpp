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
