#include "flow/point_grid.h"

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
  for (const Vec3& p : points) ++start_[index_of(p)];
  starts_from_counts(start_.span());
  for (uint32_t i = 0; i < points.size(); ++i) item_[start_[index_of(points[i])]++] = i;
  // Each start stands at the next one's place now.
  for (size_t c = start_.size() - 1; c > 0; --c) start_[c] = start_[c - 1];
  start_[0] = 0;
  return {};
}

}  // namespace wireskin::flow
