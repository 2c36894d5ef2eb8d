// What the files of the C boundary share: the surface's handle, and the checking, scaling and
// reporting that every call does. Contracts are those of wireskin.h.
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

Status read_options(const wsk_options* given, wsk_options* options);
Allocator allocator_of(const wsk_options& options);
Callbacks callbacks_of(const wsk_options& options);

// One position or normal, checked; the normal comes out unit whatever its length was.
Status read_position(const Rows& rows, size_t i, const Place& place, Vec3* position);
Status read_normal(const Rows& rows, size_t i, const Place& place, Vec3* normal);

// The power of two that brings the extent of the points to one half up to one.
Status find_scale(Span<const Vec3> points, int* exponent);

void report_counts(const Counts& counts, const Scale& unscale, wsk_report* report);
void report_costs(Context& context, wsk_report* report);
// Copies the report out, as much of it as the caller's version has.
wsk_status finish(const Status& status, wsk_report* report, wsk_report* out);

Status make_handle(Context& context, const Surface& surface, int exponent, wsk_surface** out);

}  // namespace wireskin::api
