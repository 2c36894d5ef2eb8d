// How a call at the C boundary goes: the options are read, a context is made, the task runs in it,
// and whatever happened is reported. Brings in what the tasks share: options, input, report, views.
#pragma once

#include "api/input.h"
#include "api/options.h"
#include "api/report.h"
#include "api/view.h"

namespace wireskin::api {

// Where a result goes: the caller's pointer, what is said if it is null, and how a result is freed.
template <typename Handle>
struct Destination {
  Handle** handle;
  const char* missing;
  void (*release)(Handle* handle);
};

inline Destination<wsk_surface> to_surface(wsk_surface** surface) {
  return {surface, "there is no place for the surface", wsk_surface_free};
}

// `earlier`: what reading other options said. A result that failed at the very end, cancelled while
// it was copied out, is freed.
template <typename Handle, typename Task>
wsk_status run_call(const Status& earlier, const wsk_options* given,
                    const Destination<Handle>& destination, wsk_report* out, const Task& task) {
  wsk_report report;
  wsk_report_init(&report, sizeof report);
  if (out != nullptr && out->size < k_report_size) return WSK_ERROR_BAD_ARGUMENT;
  if (destination.handle == nullptr) {
    return finish(fail(Code::bad_argument, destination.missing), &report, out);
  }
  wsk_options options;
  Status status = earlier;
  if (status.ok()) status = read_options(given, &options);
  if (!status.ok()) return finish(status, &report, out);
  Context context(allocator_of(options), options.memory_cap, callbacks_of(options));
  Handle* made = nullptr;
  status = task(context, options, &report, &made);
  if (!status.ok() && made != nullptr) destination.release(made);
  report_costs(context, &report);
  if (status.ok()) *destination.handle = made;
  return finish(status, &report, out);
}

}  // namespace wireskin::api
