#include "api/curves.h"

#include "base/in_parts.h"

namespace wireskin::api {

// A point has no sides.
static bool is_sharp(const wsk_curve& curve) {
  return curve.sharp != 0 && (curve.sample_count != 1 || curve.closed != 0);
}

static Status count_samples(const wsk_curve* curves, size_t count, size_t* total, bool* sharp) {
  *total = 0;
  *sharp = false;
  for (size_t c = 0; c < count; ++c) {
    const Place place = curve_place(c);
    const wsk_curve& curve = curves[c];
    if (curve.sample_count == 0) {
      return fail(Code::too_few_samples, "the curve has no samples", place);
    }
    if (curve.sample_count >= k_none - *total) {
      return fail(Code::too_large, "too many samples for 32-bit indices", place);
    }
    if (curve.positions == nullptr) {
      return fail(Code::bad_argument, "the curve has no positions", place);
    }
    *sharp = *sharp || is_sharp(curve);
    if (curve.normals == nullptr && curve.sharp == 0 && curve.sample_count != 1) {
      return fail(Code::missing_normals, "the curve has no normals", place);
    }
    if (curve.soft - curve.soft != 0.0) {
      return fail(Code::bad_argument, "the cutoff length of the curve is not finite", place);
    }
    *total += curve.sample_count;
  }
  return {};
}

// A normal of one side of a sharp curve; zero where the side has none.
static Status read_side_normal(const double* data, size_t stride, size_t i, const Place& place,
                               Vec3* normal) {
  *normal = Vec3{};
  return data == nullptr ? Status{} : read_normal({data, stride}, i, place, normal);
}

static Status read_curve(const wsk_curve& curve, uint32_t index, Pace* pace,
                         CurveStorage* storage) {
  const Rows positions = {curve.positions, curve.position_stride};
  for (size_t i = 0; i < curve.sample_count; ++i) {
    TRY(pace->after());
    const Place place = sample_place(index, i);
    Vec3 position, normal;
    TRY(read_position(positions, i, place, &position));
    TRY(read_side_normal(curve.normals, curve.normal_stride, i, place, &normal));
    storage->position.push_reserved(position);
    storage->normal.push_reserved(normal);
    storage->number.push_reserved(curve.nodes == nullptr ? k_none : curve.nodes[i]);
    if (storage->sharp.empty()) continue;
    const double* right = is_sharp(curve) ? curve.normals_right : nullptr;
    TRY(read_side_normal(right, curve.normal_right_stride, i, place, &normal));
    storage->right.push_reserved(normal);
  }
  storage->closed.push_reserved(curve.closed != 0);
  storage->boundary.push_reserved(curve.boundary != 0);
  storage->soft.push_reserved(curve.soft);
  storage->start.push_reserved(static_cast<uint32_t>(storage->position.size()));
  return {};
}

Status read_curves(const wsk_curve* curves, size_t count, CurveStorage* storage) {
  size_t total = 0;
  if (count == 0) return fail(Code::empty, "there are no curves");
  if (curves == nullptr) return fail(Code::bad_argument, "the curves are null");
  if (count >= k_none) return fail(Code::too_large, "too many curves for 32-bit indices");
  bool sharp = false;
  TRY(count_samples(curves, count, &total, &sharp));
  TRY(storage->start.reserve(count + 1));
  TRY(storage->closed.reserve(count));
  TRY(storage->boundary.reserve(count));
  TRY(storage->soft.reserve(count));
  TRY(storage->position.reserve(total));
  TRY(storage->normal.reserve(total));
  TRY(storage->number.reserve(total));
  if (sharp) {
    TRY(storage->sharp.resize(count));
    TRY(storage->right.reserve(total));
    for (size_t c = 0; c < count; ++c) storage->sharp[c] = is_sharp(curves[c]);
  }
  storage->start.push_reserved(0);
  Pace pace(storage->position.context());
  for (size_t c = 0; c < count; ++c) {
    TRY(pace.after());
    TRY(read_curve(curves[c], static_cast<uint32_t>(c), &pace, storage));
  }
  return {};
}

}  // namespace wireskin::api
