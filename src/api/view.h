// Results as the caller sees them: one block of his memory holds the handle and, behind it, all
// arrays of its view, in his units.
#pragma once

#include <cstring>

#include "api/options.h"
#include "base/in_parts.h"
#include "surface.h"

struct wsk_surface {
  wireskin::Allocator allocator;
  size_t bytes;
  wsk_surface_view view;
};

namespace wireskin::api {

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

inline Status write_vectors(Context& context, Span<const Vec3> values, const Scale& scale,
                            unsigned char* place, const double** vectors) {
  double* out = reinterpret_cast<double*>(place);
  *vectors = out;
  return in_parts(context, values.size(), [&](size_t i) {
    const Vec3 v = scale(values[i]);
    out[3 * i] = v.x, out[3 * i + 1] = v.y, out[3 * i + 2] = v.z;
  });
}

// The surface in the caller's units, in one block; half-written, and to be freed, where it fails
// after the allocation.
Status make_handle(Context& context, const Surface& surface, int exponent, wsk_surface** out);

}  // namespace wireskin::api
