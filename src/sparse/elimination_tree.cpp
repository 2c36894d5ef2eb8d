#include "sparse/elimination_tree.h"

#include "base/in_parts.h"

namespace wireskin::sparse {

Status elimination_tree(const Pattern& upper, Array<uint32_t>* parent) {
  const uint32_t n = static_cast<uint32_t>(upper.start.size() - 1);
  Array<uint32_t> ancestor(upper.start.context());  // a shortcut towards the root
  TRY(assign_in_parts(n, k_none, &ancestor));
  TRY(assign_in_parts(n, k_none, parent));
  for (uint32_t j = 0; j < n; ++j) {
    TRY(checkpoint_at_column(parent->context(), j));
    for (uint32_t k = upper.start[j]; k < upper.start[j + 1]; ++k) {
      // Row j reaches every node from index[k] up to j; the root found on the way hangs below j.
      uint32_t i = upper.index[k];
      while (i != k_none && i != j) {
        const uint32_t next = ancestor[i];
        ancestor[i] = j;
        if (next == k_none) (*parent)[i] = j;
        i = next;
      }
    }
  }
  return {};
}

static uint32_t first_leaf(const Array<uint32_t>& first_child, uint32_t node) {
  while (first_child[node] != k_none) node = first_child[node];
  return node;
}

Status postorder(Span<const uint32_t> parent, Array<uint32_t>* order) {
  const uint32_t n = static_cast<uint32_t>(parent.size());
  Array<uint32_t> first_child(order->context());
  Array<uint32_t> sibling(order->context());
  TRY(assign_in_parts(n, k_none, &first_child));
  TRY(assign_in_parts(n, k_none, &sibling));
  TRY(order->reserve(n));
  order->clear();
  for (uint32_t j = n; j-- > 0;) {
    TRY(checkpoint_at_column(order->context(), j));
    if (parent[j] == k_none) continue;
    sibling[j] = first_child[parent[j]];
    first_child[parent[j]] = j;
  }
  for (uint32_t root = 0; root < n; ++root) {
    if (parent[root] != k_none) continue;
    uint32_t node = first_leaf(first_child, root);
    order->push_reserved(node);
    while (node != root) {
      TRY(checkpoint_at_column(order->context(), static_cast<uint32_t>(order->size())));
      const bool last = sibling[node] == k_none;
      node = last ? parent[node] : first_leaf(first_child, sibling[node]);
      order->push_reserved(node);
    }
  }
  return {};
}

// The root of `i` in the forest of the columns done so far, with the path to it halved.
static uint32_t find_root(Span<uint32_t> ancestor, uint32_t i) {
  while (ancestor[i] != i) {
    ancestor[i] = ancestor[ancestor[i]];
    i = ancestor[i];
  }
  return i;
}

// Row i of the factor is a subtree of the elimination tree, rooted at i. Count one for each of its
// leaves, take one away where the paths of two leaves meet, and one above each node for its own
// diagonal: the sums over subtrees are then the column counts.
Status column_counts(const Pattern& lower, Span<const uint32_t> parent, Array<uint32_t>* count) {
  const uint32_t n = static_cast<uint32_t>(parent.size());
  Context& context = count->context();
  Array<uint32_t> first(context);          // the least node of the subtree of a node
  Array<uint32_t> ancestor(context);       // disjoint sets of the columns done
  Array<uint32_t> previous_leaf(context);  // of the subtree of a row
  Array<uint32_t> latest_first(context);   // 1 + the greatest `first` among the leaves of a row
  TRY(first.resize(n));
  TRY(ancestor.resize(n));
  TRY(assign_in_parts(n, k_none, &previous_leaf));
  TRY(assign_in_parts(n, 0, &latest_first));
  TRY(assign_in_parts(n, 0, count));
  for (uint32_t j = 0; j < n; ++j) first[j] = ancestor[j] = j;
  for (uint32_t j = 0; j < n; ++j) {
    TRY(checkpoint_at_column(context, j));
    if (first[j] == j) ++(*count)[j];
    if (parent[j] != k_none && first[j] < first[parent[j]]) first[parent[j]] = first[j];
  }
  for (uint32_t j = 0; j < n; ++j) {
    TRY(checkpoint_at_column(context, j));
    // The counts wrap below zero on the way and are right at the end.
    if (parent[j] != k_none) --(*count)[parent[j]];
    for (uint32_t k = lower.start[j]; k < lower.start[j + 1]; ++k) {
      const uint32_t i = lower.index[k];
      if (i == j || first[j] < latest_first[i]) continue;
      ++(*count)[j];
      if (previous_leaf[i] != k_none) --(*count)[find_root(ancestor.span(), previous_leaf[i])];
      previous_leaf[i] = j;
      latest_first[i] = first[j] + 1;
    }
    if (parent[j] != k_none) ancestor[j] = parent[j];
  }
  return in_parts(context, n, [&](size_t j) {
    if (parent[j] != k_none) (*count)[parent[j]] += (*count)[j];
  });
}

}  // namespace wireskin::sparse
