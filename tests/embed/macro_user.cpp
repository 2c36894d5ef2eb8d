// A C++ program that has macros of the names that the library uses inside, and code after it.
#define TRY(x) (7 + (x))
#define WIRESKIN_ASSERT(x) (9 + (x))
#define WIRESKIN_IMPLEMENTATION
#include "wireskin.h"
// A second time does no harm.
#include "wireskin.h"

static_assert(TRY(1) == 8, "the includer's macro is back");
static_assert(WIRESKIN_ASSERT(1) == 10, "the includer's macro is back");
#undef TRY
#undef WIRESKIN_ASSERT

const char* version_of_the_library() {
  return wsk_version_string();
}
