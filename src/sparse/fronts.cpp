#include "sparse/fronts.h"

namespace wireskin::sparse {

namespace {

// Free stretches of a growing memory, ascending; requests take the first that is large enough.
struct Room {
  struct Gap {
    size_t at, size;
  };
  Array<Gap> gap;
  size_t end = 0;
  size_t peak = 0;

  explicit Room(Context& context) : gap(context) {}

  size_t take(size_t size) {
    for (size_t k = 0; k < gap.size(); ++k) {
      if (gap[k].size < size) continue;
      const size_t at = gap[k].at;
      gap[k].at += size;
      gap[k].size -= size;
      if (gap[k].size == 0) remove(k);
      return at;
    }
    const size_t at = end;
    end += size;
    if (end > peak) peak = end;
    return at;
  }

  Status give(size_t at, size_t size) {
    if (size == 0) return {};
    size_t k = 0;
    while (k < gap.size() && gap[k].at < at) ++k;
    TRY(gap.push({0, 0}));
    for (size_t i = gap.size() - 1; i > k; --i) gap[i] = gap[i - 1];
    gap[k] = {at, size};
    if (k + 1 < gap.size() && gap[k].at + gap[k].size == gap[k + 1].at) {
      gap[k].size += gap[k + 1].size;
      remove(k + 1);
    }
    if (k > 0 && gap[k - 1].at + gap[k - 1].size == gap[k].at) {
      gap[k - 1].size += gap[k].size;
      remove(k);
    }
    if (gap.back().at + gap.back().size == end) {
      end = gap.back().at;
      gap.pop();
    }
    return {};
  }

  void remove(size_t k) {
    for (size_t i = k + 1; i < gap.size(); ++i) gap[i - 1] = gap[i];
    gap.pop();
  }
};

}  // namespace

static uint32_t tail_of(const Supernodes& s, uint32_t k) {
  return s.height(k) - s.width(k);
}

static double work_of(const Supernodes& s, uint32_t k) {
  double sum = 0.0;
  for (uint32_t j = 0; j < s.width(k); ++j) {
    const double below = s.height(k) - j;
    sum += below * below;
  }
  return 0.5 * sum;
}

static Status link_tree(const Supernodes& s, Fronts* f) {
  TRY(f->parent.assign(s.count, k_none));
  TRY(f->child.assign(s.count, k_none));
  TRY(f->sibling.assign(s.count, k_none));
  for (uint32_t k = s.count; k-- > 0;) {
    TRY(checkpoint_at_column(f->child.context(), k));
    if (tail_of(s, k) == 0) continue;
    const uint32_t above = s.of_column[s.rows(k)[s.width(k)]];
    f->parent[k] = above;
    f->sibling[k] = f->child[above];
    f->child[above] = k;
  }
  return {};
}

// The rows of a tail are among those of the parent, and both ascend.
static Status list_runs(const Supernodes& s, Fronts* f) {
  constexpr uint32_t k_rows_per_checkpoint = 1u << 18;
  TRY(f->run_start.resize(size_t{s.count} + 1));
  TRY(f->run.reserve(size_t{s.count} * 4));
  f->run.clear();
  uint32_t rows_met = 0;
  for (uint32_t k = 0; k < s.count; ++k) {
    f->run_start[k] = static_cast<uint32_t>(f->run.size());
    const uint32_t tail = tail_of(s, k);
    if (tail == 0) continue;
    const uint32_t* rows = s.rows(k) + s.width(k);
    const uint32_t* above = s.rows(f->parent[k]);
    uint32_t to = 0;
    for (uint32_t i = 0; i < tail;) {
      while (above[to] != rows[i]) ++to;
      Run run = {i, to, 1};
      for (++i, ++to; i < tail && rows[i] == above[to]; ++i, ++to) ++run.length;
      TRY(f->run.push(run));
    }
    rows_met += to;
    if (rows_met < k_rows_per_checkpoint) continue;
    rows_met = 0;
    TRY(f->run.context().checkpoint());
  }
  f->run_start[s.count] = static_cast<uint32_t>(f->run.size());
  return {};
}

// Subtrees of at most a certain work, in postorder; everything else goes above them.
static Status cut_tasks(const Supernodes& s, Fronts* f) {
  constexpr double k_share = 1.0 / 16.0;  // of all work in one task, at most
  constexpr double k_least = 1e6, k_most = 5e7;
  Context& context = f->run.context();
  Array<double> work(context);
  Array<uint32_t> first(context);
  TRY(work.resize(s.count));
  TRY(first.resize(s.count));
  for (uint32_t k = 0; k < s.count; ++k) {
    TRY(checkpoint_at_column(context, k));
    work[k] = work_of(s, k);
    first[k] = k;
    for (uint32_t c = f->child[k]; c != k_none; c = f->sibling[c]) {
      work[k] += work[c];
      if (first[c] < first[k]) first[k] = first[c];
    }
  }
  f->work = 0.0;
  for (uint32_t k = 0; k < s.count; ++k) {
    if (f->parent[k] == k_none) f->work += work[k];
  }
  double limit = k_share * f->work;
  limit = limit < k_least ? k_least : limit > k_most ? k_most : limit;
  f->task.clear();
  f->upper.clear();
  for (uint32_t k = 0; k < s.count; ++k) {
    TRY(checkpoint_at_column(context, k));
    const bool light = work[k] <= limit;
    const bool top = f->parent[k] == k_none || work[f->parent[k]] > limit;
    if (light && top) TRY(f->task.push({first[k], k}));
    if (!light) TRY(f->upper.push(k));
  }
  return {};
}

static Status give_children(const Supernodes& s, const Fronts& f, uint32_t k, Room* room) {
  for (uint32_t c = f.child[k]; c != k_none; c = f.sibling[c]) {
    TRY(room->give(f.update[c], update_size(tail_of(s, c))));
  }
  return {};
}

// The inside of a task, from `base` on once that is known: places are relative here.
static Status place_task(const Supernodes& s, const Task& task, Room* inside, Fronts* f) {
  inside->gap.clear();
  inside->end = inside->peak = 0;
  for (uint32_t k = task.first; k <= task.root; ++k) {
    if (k != task.root) f->update[k] = inside->take(update_size(tail_of(s, k)));
    TRY(give_children(s, *f, k, inside));
  }
  return {};
}

static Status place_batch(const Supernodes& s, const Step& step, Room* inside, Room* room,
                          Fronts* f) {
  size_t base[Fronts::k_batch], size[Fronts::k_batch];
  for (uint32_t t = step.first_task; t < step.end_task; ++t) {
    f->update[f->task[t].root] = room->take(update_size(tail_of(s, f->task[t].root)));
  }
  for (uint32_t t = step.first_task; t < step.end_task; ++t) {
    const uint32_t slot = t - step.first_task;
    TRY(place_task(s, f->task[t], inside, f));
    size[slot] = inside->peak;
    base[slot] = room->take(size[slot]);
    for (uint32_t k = f->task[t].first; k < f->task[t].root; ++k) f->update[k] += base[slot];
  }
  for (uint32_t t = step.first_task; t < step.end_task; ++t) {
    TRY(room->give(base[t - step.first_task], size[t - step.first_task]));
  }
  return {};
}

static Status place_updates(const Supernodes& s, uint32_t batch, Fronts* f) {
  Context& context = f->run.context();
  Room room(context), inside(context);
  TRY(f->update.resize(s.count));
  f->step.clear();
  Step step = {0, 0, 0, 0};
  const uint32_t tasks = static_cast<uint32_t>(f->task.size());
  const uint32_t uppers = static_cast<uint32_t>(f->upper.size());
  while (step.end_task < tasks || step.end_upper < uppers) {
    step.first_task = step.end_task;
    step.first_upper = step.end_upper;
    step.end_task = tasks - step.first_task < batch ? tasks : step.first_task + batch;
    const uint32_t done = step.end_task < tasks ? f->task[step.end_task].first : s.count;
    while (step.end_upper < uppers && f->upper[step.end_upper] < done) ++step.end_upper;
    TRY(place_batch(s, step, &inside, &room, f));
    for (uint32_t u = step.first_upper; u < step.end_upper; ++u) {
      const uint32_t k = f->upper[u];
      f->update[k] = room.take(update_size(tail_of(s, k)));
      TRY(give_children(s, *f, k, &room));
    }
    TRY(f->step.push(step));
    TRY(context.checkpoint());
  }
  f->workspace = room.peak;
  return {};
}

Status plan_fronts(const Supernodes& supernodes, uint32_t batch, Fronts* fronts) {
  WIRESKIN_ASSERT(batch > 0 && batch <= Fronts::k_batch);
  TRY(link_tree(supernodes, fronts));
  TRY(list_runs(supernodes, fronts));
  TRY(cut_tasks(supernodes, fronts));
  return place_updates(supernodes, batch, fronts);
}

}  // namespace wireskin::sparse
