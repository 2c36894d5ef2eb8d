// A uniform grid over points in space, for finding those near a place.
//
// In: points (finite, extent about one). Out: for a box, the indices of all points in the cells
// that it touches, a superset of those inside. About as many cells as points, so that points on
// curves and surfaces come a few to a cell. O(points) to build.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::flow {

class PointGrid {
 public:
  explicit PointGrid(Context& context) : start_(context), item_(context) {}

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
        // The cells of a row lie one behind the other, and so do their points.
        const uint32_t last = start_[row + high.x + 1];
        for (uint32_t i = start_[row + low.x]; i < last; ++i) {
          if (visit(item_[i])) return true;
        }
      }
    }
    return false;
  }

 private:
  struct Cell {
    uint32_t x = 1, y = 1, z = 1;
  };

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

  Vec3 low_;
  double per_cell_ = 0.0;
  Cell size_;
  Array<uint32_t> start_, item_;
};

}  // namespace wireskin::flow
