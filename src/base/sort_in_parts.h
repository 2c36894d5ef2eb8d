// sort() of so many values that a caller should not have to wait for its end: a checkpoint before
// each partition of a long run. Short runs are left to sort(), and so are those whose pivots have
// turned out badly; the result is the same, for `less` must be a total order.
#pragma once

#include "base/in_parts.h"
#include "base/sort.h"

namespace wireskin {

// One order for all who sort numbers, so that the code is there once.
struct Ascending {
  bool operator()(double a, double b) const { return a < b; }
};

template <typename T, typename Less>
Status sort_in_parts(Context& context, Span<T> values, const Less& less) {
  struct Run {
    Span<T> values;
    int budget;
  };
  Run stack[64];  // the longer part waits, so the depth is at most log2 of the size
  int depth = 0, budget = 2;
  for (size_t n = values.size(); n > 1; n >>= 1) budget += 2;
  stack[depth++] = {values, budget};
  while (depth > 0) {
    Run run = stack[--depth];
    while (run.values.size() > k_steps_per_checkpoint && run.budget-- > 0) {
      TRY(context.checkpoint());
      T* const middle = partition(run.values.begin(), run.values.end(), less);
      const size_t cut = static_cast<size_t>(middle - run.values.begin());
      const Span<T> left = run.values.part(0, cut);
      const Span<T> right = run.values.part(cut, run.values.size() - cut);
      const bool right_waits = left.size() < right.size();
      stack[depth++] = {right_waits ? right : left, run.budget};
      run.values = right_waits ? left : right;
    }
    sort(run.values, less);
  }
  return {};
}

}  // namespace wireskin
