// The line on a terminal that tells how far long work has come, and the wish to cancel (Ctrl-C).
//
// Nothing is printed in the first half second, nor when standard error is no terminal.
#pragma once

#include <chrono>

#include "build.h"

namespace wireskin_cli {

// From now on Ctrl-C and a polite kill only set a flag.
void catch_signals();
bool cancel_wanted();

class ProgressLine {
 public:
  explicit ProgressLine(bool wanted);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(wsk_stage stage, double fraction);
  void clear();

  // Both for the library, with this object as their user pointer.
  BuildCallbacks callbacks();

 private:
  using Clock = std::chrono::steady_clock;
  bool wanted_;
  bool on_screen_ = false;
  Clock::time_point next_;
};

}  // namespace wireskin_cli
