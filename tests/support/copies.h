// Copies of the process that take another way from the place where they are made: what happens
// after a failure at each of a thousand places of one call costs a thousand ends of it instead of a
// thousand calls. Where a system has no fork(), can_copy() says so.
#pragma once

#include <cstddef>
#include <cstdlib>

#if defined(__unix__) && !defined(__EMSCRIPTEN__) && __has_include(<sys/wait.h>)
#include <sys/wait.h>
#include <unistd.h>
#define SCENES_HAS_FORK 1
#endif

namespace scenes {

inline bool can_copy() {
#ifdef SCENES_HAS_FORK
  return true;
#else
  return false;
#endif
}

struct Copies {
  bool is_copy = false;
  size_t made = 0;
  size_t wrong = 0;  // that ended otherwise than with `end(k_fine)` or `end(k_fine_after_more)`

  // The second: fine, and after the failure the call asked for more.
  static constexpr int k_fine = 0, k_fine_after_more = 2, k_wrong = 1;

  // Returns twice: in the copy, and here with what the copy said at its end.
  int make() {
#ifdef SCENES_HAS_FORK
    const pid_t copy = fork();
    if (copy == 0) {
      is_copy = true;
      return k_fine;
    }
    ++made;
    int status = 0;
    const bool ended = copy > 0 && waitpid(copy, &status, 0) == copy && WIFEXITED(status);
    const int said = ended ? WEXITSTATUS(status) : k_wrong;
    if (said != k_fine && said != k_fine_after_more) ++wrong;
    return said;
#else
    std::abort();
#endif
  }
  [[noreturn]] static void end(int say) {
#ifdef SCENES_HAS_FORK
    _exit(say);
#else
    std::exit(say);
#endif
  }
};

}  // namespace scenes
