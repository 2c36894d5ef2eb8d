#include "network/box_tree.h"

#include "base/select.h"
#include "base/sort_in_parts.h"
#include "num/minmax.h"

namespace wireskin::network {

static constexpr uint32_t k_boxes_of_a_leaf = 8;

namespace {

struct TreeRange {
  uint32_t node, first, count;

  bool is_leaf() const { return count <= k_boxes_of_a_leaf; }
  TreeRange lower() const { return {2 * node + 1, first, count / 2}; }
  TreeRange upper() const { return {2 * node + 2, first + count / 2, count - count / 2}; }
};

// Ranges to come: one at most for each level, and its sibling.
struct RangeStack {
  TreeRange range[64];
  uint32_t size = 0;

  void push(const TreeRange& r) { range[size++] = r; }
  TreeRange pop() { return range[--size]; }
};

}  // namespace

static bool boxes_meet(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

static Vec3 twice_centre(const Box& box) {
  return box.low + box.high;
}

static double along(const Vec3& p, int axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

static void extend(const Box& more, Box* box) {
  const Vec3 &low = more.low, &high = more.high;
  box->low = {smaller(box->low.x, low.x), smaller(box->low.y, low.y), smaller(box->low.z, low.z)};
  box->high = {larger(box->high.x, high.x), larger(box->high.y, high.y),
               larger(box->high.z, high.z)};
}

Status BoxTree::bound(uint32_t first, uint32_t count, Box* box) const {
  *box = boxes_[order_[first]];
  return in_parts(order_.context(), count,
                  [&](size_t i) { extend(boxes_[order_[first + i]], box); });
}

// Moves the half of lesser centres, along the axis in which they spread most, to the front; equal
// ones are told apart by index.
Status BoxTree::halve(uint32_t first, uint32_t count) {
  Vec3 low = twice_centre(boxes_[order_[first]]), high = low;
  TRY(in_parts(order_.context(), count, [&](size_t i) {
    const Vec3 c = twice_centre(boxes_[order_[first + i]]);
    low = {smaller(low.x, c.x), smaller(low.y, c.y), smaller(low.z, c.z)};
    high = {larger(high.x, c.x), larger(high.y, c.y), larger(high.z, c.z)};
  }));
  const Vec3 spread = high - low;
  const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
  const auto before = [&](uint32_t a, uint32_t b) {
    const double x = along(twice_centre(boxes_[a]), axis), y = along(twice_centre(boxes_[b]), axis);
    return x != y ? x < y : a < b;
  };
  return select_least(order_.context(), order_.span().part(first, count), count / 2, before);
}

Status BoxTree::build(Span<const Box> boxes) {
  boxes_ = boxes;
  const uint32_t count = static_cast<uint32_t>(boxes.size());
  size_t nodes = 1;
  for (uint32_t rest = count; rest > k_boxes_of_a_leaf; rest -= rest / 2) nodes = 2 * nodes + 1;
  TRY(order_.resize(count));
  TRY(node_.resize(nodes));
  if (count == 0) return {};
  TRY(in_parts<k_light_steps_per_checkpoint>(
      order_.context(), count, [&](size_t i) { order_[i] = static_cast<uint32_t>(i); }));
  RangeStack todo;
  todo.push({0, 0, count});
  size_t work = 0;
  while (todo.size > 0) {
    const TreeRange range = todo.pop();
    TRY(bound(range.first, range.count, &node_[range.node]));
    if (range.is_leaf()) continue;
    TRY(halve(range.first, range.count));
    todo.push(range.upper());
    todo.push(range.lower());
    if ((work += range.count) < 65536) continue;
    work = 0;
    TRY(order_.context().checkpoint());
  }
  return {};
}

Status BoxTree::find(const Box& box, uint32_t after, Array<uint32_t>* found) const {
  found->clear();
  Pace pace(order_.context());
  RangeStack todo;
  todo.push({0, 0, static_cast<uint32_t>(order_.size())});
  while (todo.size > 0) {
    TRY(pace.after());
    const TreeRange range = todo.pop();
    if (range.count == 0 || !boxes_meet(box, node_[range.node])) continue;
    if (!range.is_leaf()) {
      todo.push(range.upper());
      todo.push(range.lower());
      continue;
    }
    for (uint32_t i = range.first; i < range.first + range.count; ++i) {
      const uint32_t other = order_[i];
      if (other > after && boxes_meet(box, boxes_[other])) TRY(found->push(other));
    }
  }
  const auto ascending = [](uint32_t a, uint32_t b) { return a < b; };
  return sort_in_parts(order_.context(), found->span(), ascending);
}

}  // namespace wireskin::network
