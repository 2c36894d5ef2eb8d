// A uniform grid over points in space, for finding those near a place, however unevenly they lie.
//
// In: points (finite, extent about one). Out: for a ball, the indices of all points inside, and of
// some others. Up to eight cells to a point, so that most cells have few; in one that is crowded,
// because the points are dense there or fill only a line of the box, they are a balanced tree: each
// range's median, along the axis in which the range is widest, stands in its middle, those below
// before and those above after it. O(points log points) to build, O(points) where they lie evenly.
// Source of the trees: J. L. Bentley, "Multidimensional Binary Search Trees Used for Associative
// Searching", 1975.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::flow {

class PointGrid {
 public:
  explicit PointGrid(Context& context) : start_(context), item_(context), axis_(context) {}

  Status build(Span<const Vec3> points);

  // Calls visit(index) for every point within `radius` of `center`, and for some others, until it
  // returns true; then so does this.
  template <typename Visit>
  bool any_near(const Vec3& center, double radius, const Visit& visit) const {
    const Vec3 reach = {radius, radius, radius};
    const Cell low = cell_of(center - reach), high = cell_of(center + reach);
    for (uint32_t z = low.z; z <= high.z; ++z) {
      for (uint32_t y = low.y; y <= high.y; ++y) {
        const uint32_t row = (z * size_.y + y) * size_.x;
        for (uint32_t c = row + low.x; c <= row + high.x; ++c) {
          if (any_in_cell({start_[c], start_[c + 1]}, center, radius, visit)) return true;
        }
      }
    }
    return false;
  }

 private:
  static constexpr uint32_t k_crowd = 32;
  static constexpr uint32_t k_most_depth = 40;  // ranges halve, and there are less than 2^32 points

  struct Cell {
    uint32_t x = 1, y = 1, z = 1;
  };
  struct Range {
    uint32_t first, last;
    uint32_t size() const { return last - first; }
    uint32_t middle() const { return first + size() / 2; }
  };
  struct Item {
    Vec3 at;
    uint32_t index = 0;
  };

  template <typename Visit>
  bool any_in_cell(Range range, const Vec3& center, double radius, const Visit& visit) const {
    Range stack[k_most_depth];
    uint32_t depth = 0;
    while (true) {
      while (range.size() > k_crowd) {
        const uint32_t middle = range.middle();
        const double above = along(center - item_[middle].at, axis_[middle]);
        if (visit(item_[middle].index)) return true;
        // Rounding is monotonic, so that nothing inside of the ball is on a side left out.
        const Range before = {range.first, middle}, after = {middle + 1, range.last};
        if (above <= radius && above >= -radius) stack[depth++] = after;
        range = above <= radius ? before : after;
      }
      for (uint32_t i = range.first; i < range.last; ++i) {
        if (visit(item_[i].index)) return true;
      }
      if (depth == 0) return false;
      range = stack[--depth];
    }
  }

  static double along(const Vec3& p, uint32_t axis) {
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
  }
  static uint32_t clamp(double at, uint32_t size) {
    if (!(at > 0.0)) return 0;
    return at < size ? static_cast<uint32_t>(at) : size - 1;
  }
  Cell cell_of(const Vec3& p) const {
    const Vec3 at = per_cell_ * (p - low_);
    return {clamp(at.x, size_.x), clamp(at.y, size_.y), clamp(at.z, size_.z)};
  }
  uint32_t index_of(const Vec3& p) const {
    const Cell c = cell_of(p);
    return (c.z * size_.y + c.y) * size_.x + c.x;
  }
  void choose_cells(size_t points, const Vec3& extent);
  uint32_t widest_axis(const Range& range) const;
  void put_median_in_the_middle(const Range& range, uint32_t axis);
  void make_tree(const Range& whole);

  Vec3 low_;
  double per_cell_ = 0.0;
  Cell size_;
  Array<uint32_t> start_;
  Array<Item> item_;
  Array<uint8_t> axis_;  // of the range whose middle this is
};

}  // namespace wireskin::flow
