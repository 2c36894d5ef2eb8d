#include "api/raw_curves.h"

#include "base/in_parts.h"

namespace wireskin::api {

// A unit normal, or zero where the caller has none.
static Status read_known_normal(const double* data, size_t stride, size_t i, const Place& place,
                                Vec3* normal) {
  *normal = Vec3{};
  if (data == nullptr) return {};
  const Rows rows = {data, stride};
  if (greatest_component(rows[i]) == 0.0) return {};
  return read_normal(rows, i, place, normal);
}

// The sum of the sample counts; Kind is wsk_curve or wsk_sensor_curve.
template <typename Kind>
static Status count_raw_samples(const Kind* curves, size_t count, size_t* total) {
  *total = 0;
  if (count == 0) return fail(Code::empty, "there are no curves");
  if (curves == nullptr) return fail(Code::bad_argument, "the curves are null");
  if (count >= k_none / 2) return fail(Code::too_large, "too many curves for 32-bit indices");
  for (size_t c = 0; c < count; ++c) {
    const Place place = curve_place(c);
    if (curves[c].sample_count == 0) {
      return fail(Code::too_few_samples, "the curve has no samples", place);
    }
    if (curves[c].sample_count >= k_none / 4 - *total) {
      return fail(Code::too_large, "too many samples for 32-bit indices", place);
    }
    *total += curves[c].sample_count;
  }
  return {};
}

static Status read_raw_curve(const wsk_curve& curve, uint32_t index, bool sharp, Pace* pace,
                             network::Wires* wires) {
  for (uint32_t i = 0; i < curve.sample_count; ++i) {
    TRY(pace->after());
    const Place place = sample_place(index, i);
    Vec3 position, normal, right;
    TRY(read_position({curve.positions, curve.position_stride}, i, place, &position));
    TRY(read_known_normal(curve.normals, curve.normal_stride, i, place, &normal));
    wires->position.push_reserved(position);
    wires->normal.push_reserved(normal);
    wires->number.push_reserved(curve.nodes == nullptr ? k_none : curve.nodes[i]);
    wires->origin.push_reserved({index, i, 0.0});
    wires->along.push_reserved({index, i, 0});
    if (!sharp) continue;
    const double* data = curve.sharp != 0 ? curve.normals_right : nullptr;
    TRY(read_known_normal(data, curve.normal_right_stride, i, place, &right));
    wires->right.push_reserved(right);
  }
  wires->closed.push_reserved(curve.closed != 0);
  wires->boundary.push_reserved(curve.boundary != 0);
  wires->sharp.push_reserved(curve.sharp != 0);
  wires->soft.push_reserved(curve.soft);
  wires->start.push_reserved(wires->samples());
  return {};
}

Status read_raw_curves(const wsk_curve* curves, size_t count, network::Wires* wires) {
  size_t total = 0;
  bool sharp = false;
  TRY(count_raw_samples(curves, count, &total));
  for (uint32_t c = 0; c < count; ++c) {
    const Place place = curve_place(c);
    sharp = sharp || curves[c].sharp != 0;
    if (curves[c].positions == nullptr) {
      return fail(Code::bad_argument, "the curve has no positions", place);
    }
    if (curves[c].soft - curves[c].soft != 0.0) {
      return fail(Code::bad_argument, "the cutoff length of the curve is not finite", place);
    }
  }
  TRY(network::reserve_wires(static_cast<uint32_t>(count), static_cast<uint32_t>(total), sharp,
                             wires));
  wires->start.push_reserved(0);
  Pace pace(wires->position.context());
  for (uint32_t c = 0; c < count; ++c) TRY(read_raw_curve(curves[c], c, sharp, &pace, wires));
  return {};
}

static Status read_sensor_sample(const wsk_sensor_curve& curve, uint32_t index, uint32_t i,
                                 SensorCurves* sensor) {
  const Place place = sample_place(index, i);
  const double s = curve.arc_lengths[i];
  Vec3 normal, direction;
  TRY(read_known_normal(curve.tangents, curve.tangent_stride, i, place, &direction));
  TRY(read_known_normal(curve.normals, curve.normal_stride, i, place, &normal));
  if (direction == Vec3{}) return fail(Code::bad_argument, "the tangent has zero length", place);
  if (s != s) return fail(Code::not_a_number, "the arc length is not a number", place);
  if (s - s != 0.0) return fail(Code::infinite, "the arc length is infinite", place);
  if (i > 0 && !(s > sensor->arc.back())) {
    return fail(Code::duplicate_samples, "the arc length does not increase", place);
  }
  sensor->arc.push_reserved(s);
  sensor->tangent.push_reserved(direction);
  sensor->wires.position.push_reserved(Vec3{});
  sensor->wires.normal.push_reserved(normal);
  sensor->wires.number.push_reserved(curve.nodes == nullptr ? k_none : curve.nodes[i]);
  sensor->wires.origin.push_reserved({index, i, 0.0});
  return {};
}

static Status read_sensor_curve(const wsk_sensor_curve& curve, uint32_t index, Pace* pace,
                                SensorCurves* sensor) {
  if (curve.sample_count < (curve.closed != 0 ? 4u : 2u)) {
    return fail(Code::too_few_samples, "the curve has too few samples", curve_place(index));
  }
  if (curve.arc_lengths == nullptr || curve.tangents == nullptr) {
    return fail(Code::bad_argument, "the curve has no arc lengths or no tangents",
                curve_place(index));
  }
  for (uint32_t i = 0; i < curve.sample_count; ++i) {
    TRY(pace->after());
    TRY(read_sensor_sample(curve, index, i, sensor));
  }
  network::Wires& wires = sensor->wires;
  wires.closed.push_reserved(curve.closed != 0);
  wires.boundary.push_reserved(curve.boundary != 0);
  wires.sharp.push_reserved(0);
  wires.soft.push_reserved(0.0);
  wires.start.push_reserved(wires.samples());
  sensor->to_next.push_reserved(curve.tangents_to_next != 0);
  return {};
}

Status read_sensor_curves(const wsk_sensor_curve* curves, size_t count, SensorCurves* sensor) {
  size_t total = 0;
  TRY(count_raw_samples(curves, count, &total));
  TRY(network::reserve_wires(static_cast<uint32_t>(count), static_cast<uint32_t>(total), false,
                             &sensor->wires));
  TRY(sensor->arc.reserve(total));
  TRY(sensor->tangent.reserve(total));
  TRY(sensor->to_next.reserve(count));
  sensor->wires.start.push_reserved(0);
  Pace pace(sensor->arc.context());
  for (uint32_t c = 0; c < count; ++c) TRY(read_sensor_curve(curves[c], c, &pace, sensor));
  return {};
}

}  // namespace wireskin::api
