#include "progress.h"

#include <csignal>
#include <cstdio>

#if defined(__EMSCRIPTEN__)
#include <emscripten.h>
#include <unistd.h>
#elif defined(_WIN32)
#include <io.h>
#else
#include <unistd.h>
#endif

namespace wireskin_cli {

static volatile std::sig_atomic_t signal_came = 0;

static void note_signal(int) {
  signal_came = 1;
}

void catch_signals() {
  std::signal(SIGINT, note_signal);
  std::signal(SIGTERM, note_signal);
#ifdef SIGXFSZ
  // A file beyond the size limit is then an error of the write, which is reported, not a death.
  std::signal(SIGXFSZ, SIG_IGN);
#endif
}

bool cancel_wanted() {
  return signal_came != 0;
}

static bool stderr_is_terminal() {
#ifdef _WIN32
  return _isatty(_fileno(stderr)) != 0;
#else
  return isatty(STDERR_FILENO) != 0;
#endif
}

ProgressLine::ProgressLine(bool wanted)
    : wanted_(wanted && stderr_is_terminal()),
      start_(Clock::now()),
      next_(start_ + std::chrono::milliseconds(500)) {}

void ProgressLine::set(wsk_stage stage, double fraction) {
  stage_ = stage;
  fraction_ = fraction;
#ifdef __EMSCRIPTEN__
  // There is no terminal: the page that runs the command hears of it.
  EM_ASM(
      {
        if (Module.onProgress) Module.onProgress(UTF8ToString($0), $1);
      },
      wsk_stage_name(stage), fraction);
#endif
  refresh();
}

void ProgressLine::refresh() {
  if (!wanted_) return;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(200);
  const std::chrono::duration<double> elapsed = now - start_;
  std::fprintf(stderr, "\r%-10s", wsk_stage_name(stage_));
  // Stages that do not say how far they are stay at zero.
  if (fraction_ > 0.0) {
    std::fprintf(stderr, "%3.0f %%", 100.0 * fraction_);
  } else {
    std::fprintf(stderr, "     ");
  }
  std::fprintf(stderr, "%6.1f s", elapsed.count());
  std::fflush(stderr);
  on_screen_ = true;
}

void ProgressLine::clear() {
  if (!on_screen_) return;
  std::fprintf(stderr, "\r%24s\r", "");
  std::fflush(stderr);
  on_screen_ = false;
}

BuildCallbacks ProgressLine::callbacks() {
  BuildCallbacks callbacks;
  callbacks.cancel = [](void* user) -> int32_t {
    static_cast<ProgressLine*>(user)->refresh();
    return cancel_wanted() ? 1 : 0;
  };
  callbacks.progress = [](wsk_stage stage, double fraction, void* user) {
    static_cast<ProgressLine*>(user)->set(stage, fraction);
  };
  callbacks.user = this;
  return callbacks;
}

}  // namespace wireskin_cli
