#include "sparse/ordering.h"

#include <cmath>

#include "base/in_parts.h"

namespace wireskin::sparse {

// The quotient graph in the middle of an elimination. A node is a variable (a column still to be
// eliminated, or several with equal structure: a supervariable), an element (an eliminated pivot,
// which stands for the clique of the variables in its list), or dead. The list of a variable holds
// first its elements, then those variables that it is adjacent to outside of any common element;
// the list of an element holds variables. Lists may still name dead nodes, which readers skip.
struct QuotientGraph {
  uint32_t n = 0;
  Array<uint32_t> list;      // all the lists, with gaps between them
  uint32_t list_end = 0;     // the room behind this is free
  Array<uint32_t> start;     // where the list of a node begins
  Array<uint32_t> length;    // its entries; 0 for a dead node
  Array<uint32_t> elements;  // how many of the entries of a variable are elements
  Array<uint32_t> weight;    // columns in a supervariable; 0 for elements and the dead
  Array<uint32_t> degree;    // variable: bound of its external degree; element: weight of its list

  // Variables of equal degree, in doubly linked lists.
  Array<uint32_t> head;
  Array<uint32_t> next;
  Array<uint32_t> previous;
  uint32_t least_degree = 0;

  // What the pivot step under way knows. seen[v] == step: variable v is in the new element, or
  // outside[v] is valid for element v.
  uint32_t step = 0;
  Array<uint32_t> seen;
  Array<uint32_t> outside;  // weight of an element's variables that are not in the new element
  Array<uint32_t> hash;     // of the list of a variable
  Array<uint32_t> bucket;   // variables of equal hash, linked through `next`
  Array<uint32_t> mark;     // mark[v] == stamp: v is in the list compared with
  uint32_t stamp = 0;

  // The columns that go with a supervariable or a pivot, as linked lists.
  Array<uint32_t> member_next;
  Array<uint32_t> member_last;
  Array<uint32_t> pivots;  // in the order of elimination

  uint32_t remaining = 0;  // columns not yet eliminated
  size_t work = 0;         // list entries visited since the last checkpoint

  explicit QuotientGraph(Context& c)
      : list(c),
        start(c),
        length(c),
        elements(c),
        weight(c),
        degree(c),
        head(c),
        next(c),
        previous(c),
        seen(c),
        outside(c),
        hash(c),
        bucket(c),
        mark(c),
        member_next(c),
        member_last(c),
        pivots(c) {}
};

static Status allocate_graph(const Csc& lower, QuotientGraph* g) {
  const uint32_t n = lower.cols;
  // The live lists never need more than the first lists did, and a new element at most n entries
  // beside them; a fifth more saves most of the compressions.
  const size_t entries = 2 * (lower.row.size() - n);
  const size_t room = entries + entries / 5 + n;
  if (n >= k_none / 2 || room >= k_none) {
    return fail(Code::too_large, "the matrix is too large for 32-bit indices");
  }
  g->n = n;
  TRY(g->list.resize(room));
  TRY(g->start.resize(n));
  TRY(assign_in_parts(n, 0, &g->length));
  TRY(assign_in_parts(n, 0, &g->elements));
  TRY(assign_in_parts(n, 1, &g->weight));
  TRY(assign_in_parts(n, 0, &g->degree));
  TRY(assign_in_parts(n, k_none, &g->head));
  TRY(assign_in_parts(n, k_none, &g->next));
  TRY(assign_in_parts(n, k_none, &g->previous));
  TRY(assign_in_parts(n, 0, &g->seen));
  TRY(g->outside.resize(n));
  TRY(g->hash.resize(n));
  TRY(assign_in_parts(n, k_none, &g->bucket));
  TRY(assign_in_parts(n, 0, &g->mark));
  TRY(assign_in_parts(n, k_none, &g->member_next));
  TRY(g->member_last.resize(n));
  return g->pivots.reserve(n);
}

// The adjacency of the matrix, both triangles without the diagonal.
static Status load_lists(const Csc& lower, QuotientGraph* g) {
  Context& context = lower.start.context();
  for (uint32_t j = 0; j < g->n; ++j) {
    TRY(checkpoint_at_column(context, j));
    for (uint32_t k = lower.start[j] + 1; k < lower.start[j + 1]; ++k) {
      ++g->length[j];
      ++g->length[lower.row[k]];
    }
  }
  TRY(in_parts(context, g->n, [&](size_t i) {
    g->start[i] = g->list_end;
    g->list_end += g->length[i];
    g->length[i] = 0;
    g->member_last[i] = static_cast<uint32_t>(i);
  }));
  for (uint32_t j = 0; j < g->n; ++j) {
    TRY(checkpoint_at_column(context, j));
    for (uint32_t k = lower.start[j] + 1; k < lower.start[j + 1]; ++k) {
      const uint32_t i = lower.row[k];
      g->list[g->start[j] + g->length[j]++] = i;
      g->list[g->start[i] + g->length[i]++] = j;
    }
  }
  return {};
}

// Takes nearly full rows out of the graph: they would make every degree useless and every step
// slow, and standing last they cause no fill that they would not cause elsewhere.
static void set_dense_aside(QuotientGraph* g) {
  const double limit = 10.0 * std::sqrt(static_cast<double>(g->n));
  g->remaining = g->n;
  for (uint32_t i = 0; i < g->n; ++i) {
    if (g->length[i] <= 16 || g->length[i] <= limit) continue;
    g->weight[i] = 0;
    g->length[i] = 0;
    --g->remaining;
  }
}

static void insert_by_degree(QuotientGraph* g, uint32_t i) {
  const uint32_t d = g->degree[i];
  const uint32_t old = g->head[d];
  g->next[i] = old;
  g->previous[i] = k_none;
  if (old != k_none) g->previous[old] = i;
  g->head[d] = i;
  if (d < g->least_degree) g->least_degree = d;
}

static void remove_by_degree(QuotientGraph* g, uint32_t i) {
  const uint32_t before = g->previous[i], after = g->next[i];
  if (after != k_none) g->previous[after] = before;
  if (before != k_none) {
    g->next[before] = after;
  } else {
    g->head[g->degree[i]] = after;
  }
}

static Status insert_all(QuotientGraph* g) {
  for (uint32_t i = g->n; i-- > 0;) {
    TRY(checkpoint_at_column(g->list.context(), i));
    if (g->weight[i] == 0) continue;
    for (uint32_t k = 0; k < g->length[i]; ++k) {
      g->degree[i] += g->weight[g->list[g->start[i] + k]];
    }
    insert_by_degree(g, i);
  }
  return {};
}

static uint32_t take_least_degree(QuotientGraph* g) {
  while (g->head[g->least_degree] == k_none) ++g->least_degree;
  const uint32_t i = g->head[g->least_degree];
  remove_by_degree(g, i);
  return i;
}

// Moves the live lists to the front. Each list's first entry is parked in `start` and replaced by
// the complement of its owner, which no index can be, so that one scan finds the lists.
static Status compress_lists(QuotientGraph* g) {
  Context& context = g->list.context();
  TRY(in_parts(context, g->n, [&](size_t i) {
    if (g->length[i] == 0) return;
    const uint32_t first = g->list[g->start[i]];
    g->list[g->start[i]] = ~static_cast<uint32_t>(i);
    g->start[i] = first;
  }));
  uint32_t write = 0, lists = 0;
  for (uint32_t read = 0; read < g->list_end;) {
    const uint32_t owner = ~g->list[read++];
    if (owner >= g->n) continue;
    const uint32_t first = g->start[owner];
    g->start[owner] = write;
    g->list[write++] = first;
    for (uint32_t k = 1; k < g->length[owner]; ++k) g->list[write++] = g->list[read++];
    TRY(checkpoint_at_column(context, lists++));
  }
  g->work += g->list_end;
  g->list_end = write;
  return {};
}

static void append_members(QuotientGraph* g, uint32_t to, uint32_t from) {
  g->member_next[g->member_last[to]] = from;
  g->member_last[to] = g->member_last[from];
}

static void kill(QuotientGraph* g, uint32_t node) {
  g->weight[node] = 0;
  g->length[node] = 0;
}

// Appends the variables in [first, first + count) that are not yet in the new element `p` to it.
static void gather_variables(QuotientGraph* g, uint32_t p, uint32_t first, uint32_t count,
                             uint32_t* write) {
  for (uint32_t k = first; k < first + count; ++k) {
    const uint32_t i = g->list[k];
    if (g->weight[i] == 0 || g->seen[i] == g->step) continue;
    g->seen[i] = g->step;
    g->degree[p] += g->weight[i];
    remove_by_degree(g, i);
    g->list[(*write)++] = i;
  }
  g->work += count;
}

// A bound of the length of the element that pivot `p` will become.
static uint32_t bound_element(const QuotientGraph& g, uint32_t p) {
  size_t bound = g.length[p] - g.elements[p];
  for (uint32_t k = 0; k < g.elements[p]; ++k) bound += g.length[g.list[g.start[p] + k]];
  return bound < g.n ? static_cast<uint32_t>(bound) : g.n;
}

// Turns the variable `p` into an element: the union of its variables and of the variables of its
// elements, which are absorbed. Without elements it shrinks in place.
static Status form_element(QuotientGraph* g, uint32_t p) {
  if (g->elements[p] != 0 && bound_element(*g, p) > g->list.size() - g->list_end) {
    TRY(compress_lists(g));
  }
  ++g->step;
  g->seen[p] = g->step;
  g->degree[p] = 0;
  const uint32_t first = g->start[p];
  const uint32_t element_count = g->elements[p];
  const uint32_t to = element_count == 0 ? first : g->list_end;
  uint32_t write = to;
  gather_variables(g, p, first + element_count, g->length[p] - element_count, &write);
  for (uint32_t k = first; k < first + element_count; ++k) {
    const uint32_t e = g->list[k];
    gather_variables(g, p, g->start[e], g->length[e], &write);
    g->length[e] = 0;
  }
  if (element_count != 0) g->list_end = write;
  g->start[p] = to;
  g->length[p] = write - to;
  g->elements[p] = 0;
  return {};
}

// For every element e next to the new element `p`: the weight of e's variables outside p.
static void weigh_outside(QuotientGraph* g, uint32_t p) {
  for (uint32_t k = g->start[p]; k < g->start[p] + g->length[p]; ++k) {
    const uint32_t i = g->list[k];
    for (uint32_t m = g->start[i]; m < g->start[i] + g->elements[i]; ++m) {
      const uint32_t e = g->list[m];
      if (g->length[e] == 0) continue;
      if (g->seen[e] != g->step) {
        g->seen[e] = g->step;
        g->outside[e] = g->degree[e];
      }
      WIRESKIN_ASSERT(g->outside[e] >= g->weight[i]);
      g->outside[e] -= g->weight[i];
    }
  }
}

// What is left of a variable's list once the new element covers a part of it.
struct Remainder {
  uint32_t end;       // behind the last entry
  size_t weight = 0;  // a bound of the weight reached outside the new element
  uint32_t hash = 0;
};

// Drops dead elements, and those that lie within the new element (they add nothing to it any more).
static void keep_elements(QuotientGraph* g, uint32_t i, Remainder* left) {
  const uint32_t first = g->start[i];
  for (uint32_t k = first; k < first + g->elements[i]; ++k) {
    const uint32_t e = g->list[k];
    if (g->length[e] == 0) continue;
    if (g->outside[e] == 0) {
      g->length[e] = 0;
      continue;
    }
    left->weight += g->outside[e];
    left->hash += e;
    g->list[left->end++] = e;
  }
}

// Drops dead variables, and those that the new element reaches anyway.
static void keep_variables(QuotientGraph* g, uint32_t i, Remainder* left) {
  for (uint32_t k = g->start[i] + g->elements[i]; k < g->start[i] + g->length[i]; ++k) {
    const uint32_t j = g->list[k];
    if (g->weight[j] == 0 || g->seen[j] == g->step) continue;
    left->weight += g->weight[j];
    left->hash += j;
    g->list[left->end++] = j;
  }
}

// Brings the variable `i` of the new element `p` up to date: list, hash and the part of the degree
// outside p. A variable with nothing outside p can be eliminated together with p, without more
// fill.
static void update_variable(QuotientGraph* g, uint32_t p, uint32_t i) {
  g->work += g->length[i];
  Remainder left = {g->start[i]};
  keep_elements(g, i, &left);
  const uint32_t variables = left.end;
  keep_variables(g, i, &left);
  if (left.end == g->start[i]) {
    g->degree[p] -= g->weight[i];
    g->remaining -= g->weight[i];
    append_members(g, p, i);
    kill(g, i);
    return;
  }
  // Either p itself or an element that p absorbed was in the list, so there is room for p.
  WIRESKIN_ASSERT(left.end < g->start[i] + g->length[i]);
  g->list[left.end] = g->list[variables];
  g->list[variables] = p;
  g->elements[i] = variables + 1 - g->start[i];
  g->length[i] = left.end + 1 - g->start[i];
  if (left.weight < g->degree[i]) g->degree[i] = static_cast<uint32_t>(left.weight);
  g->hash[i] = (left.hash + p) % g->n;
}

static void mark_list(QuotientGraph* g, uint32_t i) {
  if (++g->stamp == k_none) {
    for (uint32_t& m : g->mark) m = 0;
    g->stamp = 1;
  }
  for (uint32_t k = g->start[i]; k < g->start[i] + g->length[i]; ++k) {
    g->mark[g->list[k]] = g->stamp;
  }
  g->work += g->length[i];
}

// True if the list of `j` has the same entries as the marked list of `i`.
static bool is_indistinguishable(const QuotientGraph& g, uint32_t i, uint32_t j) {
  if (g.length[i] != g.length[j] || g.elements[i] != g.elements[j]) return false;
  for (uint32_t k = g.start[j]; k < g.start[j] + g.length[j]; ++k) {
    if (g.mark[g.list[k]] != g.stamp) return false;
  }
  return true;
}

// Within one bucket of equal hashes: every variable takes in the later ones with the same list.
static void merge_bucket(QuotientGraph* g, uint32_t first) {
  for (uint32_t i = first; i != k_none; i = g->next[i]) {
    if (g->next[i] == k_none) return;
    mark_list(g, i);
    uint32_t before = i;
    for (uint32_t j = g->next[i]; j != k_none; j = g->next[j]) {
      if (!is_indistinguishable(*g, i, j)) {
        before = j;
        continue;
      }
      g->weight[i] += g->weight[j];
      if (g->degree[j] < g->degree[i]) g->degree[i] = g->degree[j];
      append_members(g, i, j);
      kill(g, j);
      g->next[before] = g->next[j];
    }
  }
}

// Variables of the new element with equal lists stay alike for ever: from now on they are one.
static void merge_indistinguishable(QuotientGraph* g, uint32_t p) {
  const uint32_t first = g->start[p], end = g->start[p] + g->length[p];
  for (uint32_t k = first; k < end; ++k) {
    const uint32_t i = g->list[k];
    if (g->weight[i] == 0) continue;
    g->next[i] = g->bucket[g->hash[i]];
    g->bucket[g->hash[i]] = i;
  }
  for (uint32_t k = first; k < end; ++k) {
    const uint32_t i = g->list[k];
    if (g->weight[i] == 0) continue;
    const uint32_t bucket_first = g->bucket[g->hash[i]];
    g->bucket[g->hash[i]] = k_none;
    merge_bucket(g, bucket_first);
  }
}

// Drops what died from the new element and files its variables under their new degrees.
static void close_element(QuotientGraph* g, uint32_t p) {
  const uint32_t end = g->start[p] + g->length[p];
  uint32_t write = g->start[p];
  for (uint32_t k = g->start[p]; k < end; ++k) {
    const uint32_t i = g->list[k];
    if (g->weight[i] == 0) continue;
    const uint32_t bound = g->degree[i] + (g->degree[p] - g->weight[i]);
    const uint32_t most = g->remaining - g->weight[i];
    g->degree[i] = bound < most ? bound : most;
    insert_by_degree(g, i);
    g->list[write++] = i;
  }
  if (end == g->list_end) g->list_end = write;
  g->length[p] = write - g->start[p];
}

static Status eliminate(QuotientGraph* g, uint32_t p) {
  g->remaining -= g->weight[p];
  g->weight[p] = 0;
  g->pivots.push_reserved(p);
  TRY(form_element(g, p));
  weigh_outside(g, p);
  for (uint32_t k = g->start[p]; k < g->start[p] + g->length[p]; ++k) {
    update_variable(g, p, g->list[k]);
  }
  merge_indistinguishable(g, p);
  close_element(g, p);
  return {};
}

// Each pivot, then the columns that went with it; the rows set aside come last.
static Status write_order(QuotientGraph* g, Array<uint32_t>* order) {
  for (uint32_t& m : g->mark) m = 0;
  TRY(in_parts(order->context(), g->pivots.size(), [&](size_t k) {
    for (uint32_t i = g->pivots[k]; i != k_none; i = g->member_next[i]) {
      g->mark[i] = 1;
      order->push_reserved(i);
    }
  }));
  return in_parts(order->context(), g->n, [&](size_t i) {
    if (g->mark[i] == 0) order->push_reserved(static_cast<uint32_t>(i));
  });
}

Status minimum_degree(const Csc& lower, Array<uint32_t>* order) {
  WIRESKIN_ASSERT(is_lower_triangle(lower));
  constexpr size_t k_work_per_checkpoint = 1u << 18;
  Context& context = lower.start.context();
  QuotientGraph graph(context);
  TRY(allocate_graph(lower, &graph));
  TRY(order->reserve(lower.cols));
  order->clear();
  TRY(load_lists(lower, &graph));
  set_dense_aside(&graph);
  TRY(insert_all(&graph));
  while (graph.remaining > 0) {
    TRY(eliminate(&graph, take_least_degree(&graph)));
    if (graph.work < k_work_per_checkpoint) continue;
    graph.work = 0;
    TRY(context.checkpoint());
  }
  return write_order(&graph, order);
}

}  // namespace wireskin::sparse
