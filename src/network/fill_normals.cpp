#include "network/fill_normals.h"

#include "base/in_parts.h"
#include "num/trig.h"

namespace wireskin::network {

static bool has_normal(const Wires& wires, uint32_t i) {
  return wires.normal[i] != Vec3{};
}

namespace {

struct Filler {
  Wires* wires;
  Array<Vec3> carried;  // scratch, of each sample
  Pace pace;

  explicit Filler(Wires* of)
      : wires(of), carried(of->position.context()), pace(of->position.context()) {}
};

}  // namespace

// Fills the samples strictly between a and b, both with normals.
static Status fill_between(uint32_t c, uint32_t a, uint32_t b, Filler* filler) {
  Wires* const wires = filler->wires;
  const Span<Vec3> carried = filler->carried.span();
  const Span<const Vec3> position = wires->position.span();
  double whole = 0.0;
  Vec3 normal = wires->normal[a];
  for (uint32_t i = a; i != b; i = wires->next(c, i)) {
    TRY(filler->pace.after());
    const uint32_t j = wires->next(c, i);
    whole += length(position[j] - position[i]);
    normal = carry_normal(position[i], position[j], normal);
    carried[j] = normal;
  }
  normal = wires->normal[b];
  double left = 0.0;
  for (uint32_t i = b; wires->previous(c, i) != a;) {
    TRY(filler->pace.after());
    const uint32_t j = wires->previous(c, i);
    left += length(position[j] - position[i]);
    normal = carry_normal(position[i], position[j], normal);
    const double part = whole > 0.0 ? left / whole : 0.0;
    const Vec3 mixed = unit(part * carried[j] + (1.0 - part) * normal);
    wires->normal[j] = mixed == Vec3{} ? carried[j] : mixed;
    i = j;
  }
  return {};
}

// Carries the normal of sample i on to the end of an open curve.
static Status fill_beyond(uint32_t c, uint32_t i, bool forward, Filler* filler) {
  Wires* const wires = filler->wires;
  while (true) {
    TRY(filler->pace.after());
    const uint32_t j = forward ? wires->next(c, i) : wires->previous(c, i);
    if (j == k_none) return {};
    wires->normal[j] = carry_normal(wires->position[i], wires->position[j], wires->normal[i]);
    i = j;
  }
}

static Status count_known(uint32_t c, Filler* filler, uint32_t* known) {
  const Wires& wires = *filler->wires;
  *known = 0;
  for (uint32_t i = wires.start[c]; i < wires.start[c + 1]; ++i) {
    TRY(filler->pace.after());
    *known += has_normal(wires, i);
  }
  return {};
}

// For a curve with one normal at least.
static Status fill_curve(uint32_t c, Filler* filler) {
  Wires* const wires = filler->wires;
  uint32_t first = k_none, last = k_none;
  for (uint32_t i = wires->start[c]; i < wires->start[c + 1]; ++i) {
    TRY(filler->pace.after());
    if (!has_normal(*wires, i)) continue;
    if (first == k_none) first = i;
    if (last != k_none && last + 1 != i) TRY(fill_between(c, last, i, filler));
    last = i;
  }
  if (!wires->closed[c]) {
    TRY(fill_beyond(c, first, false, filler));
    TRY(fill_beyond(c, last, true, filler));
  } else if (wires->next(c, last) != first) {
    // All round from the one normal there is, and back to it: once round is no loop for the walk.
    if (first != last) return fill_between(c, last, first, filler);
    const uint32_t far = wires->next(c, first);
    wires->normal[far] =
        carry_normal(wires->position[first], wires->position[far], wires->normal[first]);
    if (wires->next(c, far) != first) return fill_between(c, far, first, filler);
  }
  return {};
}

Status fill_along(Wires* wires, FillCounts* counts) {
  Filler filler(wires);
  TRY(filler.carried.resize(wires->samples()));
  for (uint32_t c = 0; c < wires->curves(); ++c) {
    uint32_t known = 0;
    TRY(count_known(c, &filler, &known));
    if (wires->sharp[c] || known == 0 || known == wires->size(c)) continue;
    TRY(fill_curve(c, &filler));
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
  Array<Vec3> mean(context);
  Filler filler(wires);
  TRY(list_members(*wires, &members));
  TRY(curve_of_samples(*wires, &curve));
  TRY(filler.carried.resize(wires->samples()));
  TRY(mean.resize(wires->points));
  TRY(in_parts(context, wires->points, [&](size_t p) {
    mean[p] = mean_normal(*wires, curve.span(), members[static_cast<uint32_t>(p)]);
  }));
  for (uint32_t c = 0; c < wires->curves(); ++c) {
    uint32_t known = 0;
    TRY(count_known(c, &filler, &known));
    if (wires->sharp[c] || known != 0) continue;
    const uint32_t first = wires->start[c], end = wires->start[c + 1];
    TRY(in_parts(context, end - first, [&](size_t i) {
      wires->normal[first + i] = mean[wires->point[first + i]];
    }));
    TRY(count_known(c, &filler, &known));
    const bool enough = wires->closed[c] ? known >= 2
                                         : has_normal(*wires, first) && has_normal(*wires, end - 1);
    if (enough) {
      TRY(fill_curve(c, &filler));
      counts->filled += end - first;
    } else {
      TRY(in_parts(context, end - first, [&](size_t i) { wires->normal[first + i] = Vec3{}; }));
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
    TRY(pace.after());
    if (own.size() < 2) continue;
    const Vec3 mean = mean_normal(*wires, curve.span(), own);
    bool unite = joined[p] && mean != Vec3{};
    for (uint32_t i : own) {
      TRY(pace.after());
      if (wires->sharp[curve[i]] || !has_normal(*wires, i)) continue;
      const double angle = angle_between(mean, wires->normal[i]);
      unite = unite && angle <= k_most_united;
      const uint32_t other = i == own[0] ? own[1] : own[0];
      if (angle > k_limit || mean == Vec3{}) {
        TRY(make_room_in_parts(1, contradictions));
        contradictions->push_reserved({wires->origin[i], wires->origin[other],
                                       angle_between(wires->normal[i], wires->normal[other])});
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
