#include "network/kept_parts.h"

#include "base/in_parts.h"
#include "network/wires.h"

namespace wireskin::network {

static Span<const uint32_t> kept_of_curve(const KeptSamples& samples, size_t curve) {
  const uint32_t first = samples.kept_start[curve];
  return samples.kept.part(first, samples.kept_start[curve + 1] - first);
}

static Status count_nodes(Context& context, const KeptSamples& samples, uint32_t* nodes) {
  *nodes = 0;
  return in_parts(context, samples.node.size(), [&](size_t i) {
    const uint32_t node = samples.node[i];
    if (node != k_none && node >= *nodes) *nodes = node + 1;
  });
}

// Which part each curve is of, parts being numbered in the order of their first curves.
static Status number_parts(const KeptSamples& samples, Array<uint32_t>* part, uint32_t* parts) {
  const uint32_t curves = static_cast<uint32_t>(samples.closed.size());
  DisjointSets sets(part->context());
  Array<uint32_t> curve_of_node(part->context());
  Pace pace(part->context());
  uint32_t nodes = 0;
  TRY(sets.reset(curves));
  TRY(count_nodes(part->context(), samples, &nodes));
  TRY(assign_in_parts(nodes, k_none, &curve_of_node));
  TRY(part->resize(curves));
  for (uint32_t c = 0; c < curves; ++c) {
    for (const uint32_t k : kept_of_curve(samples, c)) {
      TRY(pace.after());
      const uint32_t node = samples.node[samples.start[c] + k];
      if (node == k_none) continue;
      if (curve_of_node[node] == k_none) curve_of_node[node] = c;
      sets.unite(curve_of_node[node], c);
    }
  }
  Array<uint32_t> number(part->context());
  TRY(number.assign(curves, k_none));
  *parts = 0;
  for (uint32_t c = 0; c < curves; ++c) {
    uint32_t& own = number[sets.find(c)];
    if (own == k_none) own = (*parts)++;
    (*part)[c] = own;
  }
  return {};
}

// The curves part by part, in each in the order given.
Status KeptParts::sort_curves(Array<uint32_t>* order) {
  Array<uint32_t> part(order->context()), fill(order->context());
  uint32_t parts = 0;
  TRY(number_parts(samples_, &part, &parts));
  TRY(first_curve_.assign(size_t{parts} + 1, 0));
  for (const uint32_t p : part) ++first_curve_[p + 1];
  for (uint32_t p = 0; p < parts; ++p) first_curve_[p + 1] += first_curve_[p];
  TRY(fill.copy(first_curve_.span()));
  TRY(order->resize(part.size()));
  for (uint32_t c = 0; c < part.size(); ++c) (*order)[fill[part[c]]++] = c;
  return {};
}

Status KeptParts::copy_curves(Span<const uint32_t> order) {
  TRY(start_.resize(order.size()));
  TRY(closed_.resize(order.size()));
  TRY(first_kept_.resize(first_curve_.size()));
  TRY(kept_start_.reserve(order.size() + count()));
  TRY(kept_.reserve(samples_.kept.size()));
  Pace pace(kept_.context());
  kept_start_.clear();
  kept_.clear();
  first_kept_[0] = 0;
  for (uint32_t p = 0; p < count(); ++p) {
    kept_start_.push_reserved(0);
    for (uint32_t i = first_curve_[p]; i < first_curve_[p + 1]; ++i) {
      start_[i] = samples_.start[order[i]];
      closed_[i] = samples_.closed[order[i]];
      for (const uint32_t k : kept_of_curve(samples_, order[i])) {
        TRY(pace.after());
        kept_.push_reserved(k);
      }
      kept_start_.push_reserved(static_cast<uint32_t>(kept_.size()) - first_kept_[p]);
    }
    first_kept_[p + 1] = static_cast<uint32_t>(kept_.size());
  }
  return {};
}

KeptSamples KeptParts::part(uint32_t p) const {
  const uint32_t first = first_curve_[p], curves = first_curve_[p + 1] - first;
  const uint32_t first_kept = first_kept_[p];
  KeptSamples part = samples_;
  part.start = start_.span().part(first, curves);
  part.kept_start = kept_start_.span().part(first + p, curves + 1);
  part.kept = kept_.span().part(first_kept, first_kept_[p + 1] - first_kept);
  part.node = node_.span();
  part.closed = closed_.span().part(first, curves);
  return part;
}

// Every node is of one part only, so one array of numbers serves all of them.
Status KeptParts::number_nodes() {
  Array<uint32_t> number(node_.context());
  Pace pace(node_.context());
  uint32_t all = 0;
  TRY(count_nodes(node_.context(), samples_, &all));
  TRY(assign_in_parts(all, k_none, &number));
  TRY(assign_in_parts(samples_.node.size(), k_none, &node_));
  for (uint32_t p = 0; p < count(); ++p) {
    const KeptSamples own = part(p);
    uint32_t nodes = 0;
    for (uint32_t c = 0; c < own.closed.size(); ++c) {
      for (const uint32_t k : kept_of_curve(own, c)) {
        TRY(pace.after());
        const uint32_t sample = own.start[c] + k, node = samples_.node[sample];
        if (node == k_none) continue;
        if (number[node] == k_none) number[node] = nodes++;
        node_[sample] = number[node];
      }
    }
  }
  return {};
}

Status KeptParts::split(const KeptSamples& samples) {
  samples_ = samples;
  Array<uint32_t> order(start_.context());
  TRY(sort_curves(&order));
  TRY(copy_curves(order.span()));
  return number_nodes();
}

}  // namespace wireskin::network
