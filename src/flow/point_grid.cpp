#include "flow/point_grid.h"

#include "base/in_parts.h"
#include "base/sort.h"
#include "num/minmax.h"

namespace wireskin::flow {

// Halves the cells as long as there are not many more of them than points.
void PointGrid::choose_cells(size_t points, const Vec3& extent) {
  constexpr double k_cells_per_point = 8.0, k_most_cells = 0x1p+24;
  const double most = smaller(k_cells_per_point * static_cast<double>(points), k_most_cells);
  const double greatest = larger(extent.x, larger(extent.y, extent.z));
  if (!(greatest > 0.0)) return;
  for (double along = 1.0; along < 4096.0; along *= 2.0) {
    const double per_cell = along / greatest;
    const double x = extent.x * per_cell + 1.0, y = extent.y * per_cell + 1.0;
    const double z = extent.z * per_cell + 1.0;
    if (along > 1.0 && x * y * z > most) return;
    per_cell_ = per_cell;
    size_ = {static_cast<uint32_t>(x), static_cast<uint32_t>(y), static_cast<uint32_t>(z)};
  }
}

uint32_t PointGrid::widest_axis(const Range& range) const {
  Vec3 low = item_[range.first].at, high = low;
  for (uint32_t i = range.first; i < range.last; ++i) {
    const Vec3& p = item_[i].at;
    low = {smaller(low.x, p.x), smaller(low.y, p.y), smaller(low.z, p.z)};
    high = {larger(high.x, p.x), larger(high.y, p.y), larger(high.z, p.z)};
  }
  const Vec3 extent = high - low;
  if (extent.x >= extent.y && extent.x >= extent.z) return 0;
  return extent.y >= extent.z ? 1 : 2;
}

void PointGrid::put_median_in_the_middle(const Range& range, uint32_t axis) {
  const auto less = [axis](const Item& a, const Item& b) {
    const double x = along(a.at, axis), y = along(b.at, axis);
    return x < y || (x == y && a.index < b.index);
  };
  Item *first = item_.begin() + range.first, *last = item_.begin() + range.last;
  Item* const median = item_.begin() + range.middle();
  // Where the pivots turn out badly, sorting all keeps the bound.
  uint32_t budget = 8;
  for (uint32_t n = range.size(); n > 1; n >>= 1) budget += 2;
  for (; last - first > 16 && budget > 0; --budget) {
    Item* const split = partition(first, last, less);
    (median < split ? last : first) = split;
  }
  heap_sort(first, last, less);
}

void PointGrid::make_tree(const Range& whole) {
  Range stack[k_most_depth] = {whole};
  for (uint32_t depth = 1; depth > 0;) {
    const Range range = stack[--depth];
    if (range.size() <= k_crowd) continue;
    const uint32_t axis = widest_axis(range), middle = range.middle();
    put_median_in_the_middle(range, axis);
    axis_[middle] = static_cast<uint8_t>(axis);
    stack[depth++] = {range.first, middle};
    stack[depth++] = {middle + 1, range.last};
  }
}

Status PointGrid::build(Span<const Vec3> points) {
  per_cell_ = 0.0;
  size_ = Cell();
  low_ = points.empty() ? Vec3{} : points[0];
  Vec3 high = low_;
  for (const Vec3& p : points) {
    low_ = {smaller(low_.x, p.x), smaller(low_.y, p.y), smaller(low_.z, p.z)};
    high = {larger(high.x, p.x), larger(high.y, p.y), larger(high.z, p.z)};
  }
  choose_cells(points.size(), high - low_);
  TRY(start_.assign(size_t{size_.x} * size_.y * size_.z + 1, 0));
  TRY(item_.resize(points.size()));
  TRY(axis_.resize(points.size()));
  Context& context = start_.context();
  TRY(in_parts(context, points.size(), [&](size_t i) { ++start_[index_of(points[i])]; }));
  starts_from_counts(start_.span());
  TRY(in_parts(context, points.size(), [&](size_t i) {
    item_[start_[index_of(points[i])]++] = {points[i], static_cast<uint32_t>(i)};
  }));
  // Each start stands at the next one's place now.
  shift_starts_back(start_.span());
  Pace pace(context);
  for (size_t c = 0; c + 1 < start_.size(); ++c) {
    make_tree({start_[c], start_[c + 1]});
    TRY(pace.after(size_t{start_[c + 1]} - start_[c]));
  }
  return {};
}

}  // namespace wireskin::flow
