// The plan of a multifrontal factorisation: where the update matrix of each supernode stands in the
// workspace, how its rows fall on those of the front above it, and which subtrees of the tree of
// supernodes are tasks of their own.
//
// A task is a greatest subtree of little work; the supernodes above the tasks are done one by one,
// with the work inside each divided instead. Steps alternate between a batch of tasks and the
// supernodes whose children are done by then; the tasks of a batch touch no memory in common. The
// plan depends on the structure alone, so the bits do not depend on how many threads follow it.
// Invariants: supernodes are in postorder; a supernode's runs list the rows of its tail in order;
// what is alive at the same time does not overlap. Cost: linear in the rows listed.
//
// Source: Iain Duff, John Reid, "The Multifrontal Solution of Indefinite Sparse Symmetric Linear
// Equations", 1983.
#pragma once

#include "sparse/dense.h"
#include "sparse/supernodes.h"

namespace wireskin::sparse {

// The supernodes first .. root: a subtree.
struct Task {
  uint32_t first;
  uint32_t root;
};

// First the tasks first_task .. end_task, side by side, then the supernodes listed in `upper`.
struct Step {
  uint32_t first_task, end_task;
  uint32_t first_upper, end_upper;
};

struct Fronts {
  static constexpr uint32_t k_batch = 16;  // tasks side by side, at most

  Array<Run> run;
  Array<uint32_t> run_start;  // of each supernode; count + 1
  Array<uint32_t> parent;     // supernodes
  Array<uint32_t> child;      // the first one; siblings ascend
  Array<uint32_t> sibling;
  Array<size_t> update;  // where the update matrix begins in the workspace
  Array<Task> task;
  Array<uint32_t> upper;
  Array<Step> step;
  size_t workspace = 0;  // numbers
  double work = 0.0;     // multiplications of the factorisation

  explicit Fronts(Context& c)
      : run(c),
        run_start(c),
        parent(c),
        child(c),
        sibling(c),
        update(c),
        task(c),
        upper(c),
        step(c) {}
};

// Numbers in the update matrix of a supernode with `tail` rows below its columns.
inline size_t update_size(uint32_t tail) {
  return size_t{round_up_rows(tail)} * tail;
}

// `batch`: the tasks of a step, at most k_batch; with fewer the workspace is smaller.
Status plan_fronts(const Supernodes& supernodes, uint32_t batch, Fronts* fronts);

}  // namespace wireskin::sparse
