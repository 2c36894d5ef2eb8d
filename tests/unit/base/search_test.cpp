#include "base/search.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>

using wireskin::first_failing;
using wireskin::last_holding;

TEST_CASE("search: every length and every place, and few questions") {
  for (uint32_t first = 0; first < 3; ++first) {
    for (uint32_t end = first; end < first + 40; ++end) {
      for (uint32_t cut = first; cut <= end; ++cut) {
        uint32_t asked = 0;
        const auto holds = [&](uint32_t i) {
          REQUIRE(i >= first);
          REQUIRE(i < end);
          ++asked;
          return i < cut;
        };
        CHECK(first_failing(first, end, holds) == cut);
        CHECK(asked <= 6);
        if (cut > first) CHECK(last_holding(first, end, holds) == cut - 1);
        CHECK(asked <= 12);
      }
    }
  }
}

TEST_CASE("search: the whole range of an index does not overflow") {
  const std::size_t far = SIZE_MAX - 5;
  CHECK(first_failing(std::size_t{0}, SIZE_MAX, [&](std::size_t i) { return i < far; }) == far);
  CHECK(last_holding(std::size_t{0}, SIZE_MAX, [&](std::size_t i) { return i <= far; }) == far);
}
