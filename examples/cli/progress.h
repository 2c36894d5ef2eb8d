// The line on a terminal that tells how far long work has come, and the wish to cancel (Ctrl-C).
//
// The line tells the stage, how much of it is done as far as the library says, and the seconds
// since the start. Nothing is printed in the first half second, nor when standard error is no
// terminal.
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

  void set(wsk_stage stage, double fraction);
  // Brings the screen up to date; to be called often.
  void refresh();
  void clear();

  // Both for the library, with this object as their user pointer.
  BuildCallbacks callbacks();

 private:
  using Clock = std::chrono::steady_clock;
  bool wanted_;
  bool on_screen_ = false;
  wsk_stage stage_ = WSK_STAGE_INPUT;
  double fraction_ = 0.0;
  Clock::time_point start_;
  Clock::time_point next_;
};

}  // namespace wireskin_cli
