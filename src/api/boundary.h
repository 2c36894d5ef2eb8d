// What the entry points of the C API share: reading options and arrays, the scaling, blocks of
// memory that hold a handle with all its arrays, and the way a call ends. Defined in api.cpp.
#pragma once

#include <cstring>

#include "num/scale.h"
#include "surface.h"
#include "wireskin.h"

// One block of the caller's memory holds the handle and, behind it, all arrays of the view.
struct wsk_surface {
  wireskin::Allocator allocator;
  size_t bytes;
  wsk_surface_view view;
};

namespace wireskin::api {

// Structs of the first release; a smaller size means that the caller forgot to initialise.
inline constexpr size_t k_options_size = offsetof(wsk_options, now_user) + sizeof(void*);
inline constexpr size_t k_report_size = offsetof(wsk_report, total_ms) + sizeof(double);

inline size_t least(size_t a, size_t b) {
  return a < b ? a : b;
}

// Rows of three doubles at any stride, aligned or not.
struct Rows {
  const double* data;
  size_t stride;

  Vec3 operator[](size_t i) const {
    double row[3];
    const size_t step = stride == 0 ? sizeof row : stride;
    std::memcpy(row, reinterpret_cast<const unsigned char*>(data) + i * step, sizeof row);
    return {row[0], row[1], row[2]};
  }
};

// Places one array after the other in a block, all aligned for double.
class Layout {
 public:
  explicit Layout(size_t bytes) { add(bytes); }
  template <typename T>
  size_t add_array(size_t count) {
    return add(count * sizeof(T));
  }
  size_t bytes() const { return bytes_; }

 private:
  size_t add(size_t bytes) {
    const size_t offset = bytes_;
    bytes_ += (bytes + 7) / 8 * 8;
    return offset;
  }
  size_t bytes_ = 0;
};

// Fills a caller's view, as much of it as his version has; empty without a handle.
template <typename Handle, typename View>
void fill_view(const Handle* handle, View* view, size_t size) {
  if (view == nullptr) return;
  std::memset(view, 0, size);
  if (size < sizeof view->size) return;
  if (handle != nullptr) std::memcpy(view, &handle->view, least(size, sizeof *view));
  view->size = size;
}

Status read_options(const wsk_options* given, wsk_options* options);
Allocator allocator_of(const wsk_options& options);
Callbacks callbacks_of(const wsk_options& options);

void report_counts(const Counts& counts, const Scale& unscale, wsk_report* report);
void report_costs(Context& context, wsk_report* report);

// Copies the report out, as much of it as the caller's version has.
wsk_status finish(const Status& status, wsk_report* report, wsk_report* out);

double greatest_component(const Vec3& a);

// One position and normal, checked; the normal comes out unit whatever its length was.
Status read_position(const Rows& rows, size_t i, const Place& place, Vec3* position);
Status read_normal(const Rows& rows, size_t i, const Place& place, Vec3* normal);

// The power of two that brings the extent of the points to one half up to one.
Status find_scale(Span<const Vec3> points, int* exponent);

inline const double* write_vectors(unsigned char* block, size_t offset, Span<const Vec3> values,
                                   const Scale& scale) {
  double* out = reinterpret_cast<double*>(block + offset);
  for (size_t i = 0; i < values.size(); ++i) {
    const Vec3 v = scale(values[i]);
    out[3 * i] = v.x, out[3 * i + 1] = v.y, out[3 * i + 2] = v.z;
  }
  return out;
}

// The surface in the caller's units, in one block.
Status make_handle(Context& context, const Surface& surface, int exponent, wsk_surface** out);

}  // namespace wireskin::api
