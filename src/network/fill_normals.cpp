#include "network/fill_normals.h"

#include "base/in_parts.h"
#include "num/trig.h"

namespace wireskin::network {

static bool has_normal(const Wires& wires, uint32_t i) {
  return wires.normal[i] != Vec3{};
}

// Fills the samples strictly between a and b, both with normals; `carried` is scratch.
static void fill_between(uint32_t c, uint32_t a, uint32_t b, Span<Vec3> carried, Wires* wires) {
  const Span<const Vec3> position = wires->position.span();
  double whole = 0.0;
  Vec3 normal = wires->normal[a];
  for (uint32_t i = a; i != b; i = wires->next(c, i)) {
    const uint32_t j = wires->next(c, i);
    whole += length(position[j] - position[i]);
    normal = carry_normal(position[i], position[j], normal);
    carried[j] = normal;
  }
  normal = wires->normal[b];
  double left = 0.0;
  for (uint32_t i = b; wires->previous(c, i) != a;) {
    const uint32_t j = wires->previous(c, i);
    left += length(position[j] - position[i]);
    normal = carry_normal(position[i], position[j], normal);
    const double part = whole > 0.0 ? left / whole : 0.0;
    const Vec3 mixed = unit(part * carried[j] + (1.0 - part) * normal);
    wires->normal[j] = mixed == Vec3{} ? carried[j] : mixed;
    i = j;
  }
}

// Carries the normal of sample i on to the end of an open curve.
static void fill_beyond(uint32_t c, uint32_t i, bool forward, Wires* wires) {
  while (true) {
    const uint32_t j = forward ? wires->next(c, i) : wires->previous(c, i);
    if (j == k_none) return;
    wires->normal[j] = carry_normal(wires->position[i], wires->position[j], wires->normal[i]);
    i = j;
  }
}

static uint32_t count_known(const Wires& wires, uint32_t c) {
  uint32_t known = 0;
  for (uint32_t i = wires.start[c]; i < wires.start[c + 1]; ++i) known += has_normal(wires, i);
  return known;
}

// For a curve with one normal at least.
static void fill_curve(uint32_t c, Span<Vec3> carried, Wires* wires) {
  uint32_t first = k_none, last = k_none;
  for (uint32_t i = wires->start[c]; i < wires->start[c + 1]; ++i) {
    if (!has_normal(*wires, i)) continue;
    if (first == k_none) first = i;
    if (last != k_none && last + 1 != i) fill_between(c, last, i, carried, wires);
    last = i;
  }
  if (!wires->closed[c]) {
    fill_beyond(c, first, false, wires);
    fill_beyond(c, last, true, wires);
  } else if (wires->next(c, last) != first) {
    // All round from the one normal there is, and back to it: once round is no loop for the walk.
    if (first != last) return fill_between(c, last, first, carried, wires);
    const uint32_t far = wires->next(c, first);
    wires->normal[far] =
        carry_normal(wires->position[first], wires->position[far], wires->normal[first]);
    if (wires->next(c, far) != first) fill_between(c, far, first, carried, wires);
  }
}

Status fill_along(Wires* wires, FillCounts* counts) {
  Array<Vec3> carried(wires->position.context());
  TRY(carried.assign(wires->samples(), Vec3{}));
  Pace pace(wires->position.context());
  for (uint32_t c = 0; c < wires->curves(); ++c) {
    TRY(pace.after(wires->size(c)));
    const uint32_t known = count_known(*wires, c);
    if (wires->sharp[c] || known == 0 || known == wires->size(c)) continue;
    fill_curve(c, carried.span(), wires);
    counts->filled += wires->size(c) - known;
  }
  return {};
}

// The mean of the normals at a point, of curves that are not sharp.
static Vec3 mean_normal(const Wires& wires, Span<const uint32_t> curve,
                        Span<const uint32_t> members) {
  Vec3 sum;
  for (uint32_t i : members) {
    if (!wires.sharp[curve[i]]) sum += wires.normal[i];
  }
  return unit(sum);
}

Status fill_from_nodes(Wires* wires, FillCounts* counts) {
  Context& context = wires->position.context();
  PointMembers members(context);
  Array<uint32_t> curve(context);
  Array<Vec3> carried(context), mean(context);
  TRY(list_members(*wires, &members));
  TRY(curve_of_samples(*wires, &curve));
  TRY(carried.assign(wires->samples(), Vec3{}));
  TRY(mean.resize(wires->points));
  TRY(in_parts(context, wires->points, [&](size_t p) {
    mean[p] = mean_normal(*wires, curve.span(), members[static_cast<uint32_t>(p)]);
  }));
  Pace pace(context);
  for (uint32_t c = 0; c < wires->curves(); ++c) {
    TRY(pace.after(wires->size(c)));
    if (wires->sharp[c] || count_known(*wires, c) != 0) continue;
    const uint32_t first = wires->start[c], end = wires->start[c + 1];
    for (uint32_t i = first; i < end; ++i) wires->normal[i] = mean[wires->point[i]];
    const bool enough = wires->closed[c] ? count_known(*wires, c) >= 2
                                         : has_normal(*wires, first) && has_normal(*wires, end - 1);
    if (enough) {
      fill_curve(c, carried.span(), wires);
      counts->filled += end - first;
    } else {
      for (uint32_t i = first; i < end; ++i) wires->normal[i] = Vec3{};
      ++counts->missing;
    }
  }
  return {};
}

Status reconcile_normals(Span<const uint8_t> joined, Wires* wires,
                         Array<Contradiction>* contradictions) {
  constexpr double k_limit = k_pi / 4.0, k_most_united = k_pi / 3.0;
  Context& context = wires->position.context();
  PointMembers members(context);
  Array<uint32_t> curve(context);
  TRY(list_members(*wires, &members));
  TRY(curve_of_samples(*wires, &curve));
  Pace pace(context);
  for (uint32_t p = 0; p < wires->points; ++p) {
    const Span<const uint32_t> own = members[p];
    TRY(pace.after(own.size()));
    if (own.size() < 2) continue;
    const Vec3 mean = mean_normal(*wires, curve.span(), own);
    bool unite = joined[p] && mean != Vec3{};
    for (uint32_t i : own) {
      if (wires->sharp[curve[i]] || !has_normal(*wires, i)) continue;
      const double angle = angle_between(mean, wires->normal[i]);
      unite = unite && angle <= k_most_united;
      const uint32_t other = i == own[0] ? own[1] : own[0];
      if (angle > k_limit || mean == Vec3{}) {
        TRY(contradictions->push({wires->origin[i], wires->origin[other],
                                  angle_between(wires->normal[i], wires->normal[other])}));
      }
    }
    for (uint32_t i : own) {
      const bool smooth = !wires->sharp[curve[i]] && has_normal(*wires, i);
      if (unite && smooth) wires->normal[i] = mean;
    }
  }
  return {};
}

}  // namespace wireskin::network
