#include "network/wires.h"

#include "base/in_parts.h"
#include "base/sort_in_parts.h"

namespace wireskin::network {

// Every index names itself.
static Status count_up_in_parts(Array<uint32_t>* indices) {
  return in_parts<k_light_steps_per_checkpoint>(indices->context(), indices->size(), [&](size_t i) {
    (*indices)[i] = static_cast<uint32_t>(i);
  });
}

Status DisjointSets::reset(uint32_t size) {
  TRY(parent_.resize(size));
  return count_up_in_parts(&parent_);
}

uint32_t DisjointSets::find(uint32_t i) {
  while (parent_[i] != i) {
    parent_[i] = parent_[parent_[i]];
    i = parent_[i];
  }
  return i;
}

bool DisjointSets::unite(uint32_t a, uint32_t b) {
  a = find(a);
  b = find(b);
  if (a == b) return false;
  (a < b ? parent_[b] : parent_[a]) = a < b ? a : b;
  return true;
}

Status curve_of_samples(const Wires& wires, Array<uint32_t>* curve) {
  TRY(curve->resize(wires.samples()));
  uint32_t c = 0;
  return in_parts<k_light_steps_per_checkpoint>(curve->context(), wires.samples(), [&](size_t i) {
    while (i >= wires.start[c + 1]) ++c;
    (*curve)[i] = c;
  });
}

Status reserve_wires(uint32_t curves, uint32_t samples, bool sharp, Wires* wires) {
  TRY(wires->start.reserve(curves + size_t{1}));
  TRY(wires->closed.reserve(curves));
  TRY(wires->boundary.reserve(curves));
  TRY(wires->sharp.reserve(curves));
  TRY(wires->soft.reserve(curves));
  TRY(wires->position.reserve(samples));
  TRY(wires->normal.reserve(samples));
  TRY(wires->point.reserve(samples));
  TRY(wires->number.reserve(samples));
  TRY(wires->origin.reserve(samples));
  TRY(wires->along.reserve(samples));
  return sharp ? wires->right.reserve(samples) : Status{};
}

static bool lies_before(const Vec3& a, const Vec3& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

Status unite_numbers(const Wires& wires, DisjointSets* sets) {
  Context& context = wires.position.context();
  Array<uint32_t> order(context);
  TRY(order.reserve(wires.samples()));
  TRY(in_parts(context, wires.samples(), [&](size_t i) {
    if (wires.number[i] != k_none) order.push_reserved(static_cast<uint32_t>(i));
  }));
  const Span<const uint32_t> number = wires.number.span();
  TRY(sort_in_parts(context, order.span(), [number](uint32_t a, uint32_t b) {
    return number[a] != number[b] ? number[a] < number[b] : a < b;
  }));
  return in_parts(context, order.size(), [&](size_t k) {
    if (k > 0 && number[order[k]] == number[order[k - 1]]) sets->unite(order[k], order[k - 1]);
  });
}

// Unites samples at the same place.
static Status unite_places(const Wires& wires, DisjointSets* sets) {
  Context& context = wires.position.context();
  Array<uint32_t> order(context);
  TRY(order.resize(wires.samples()));
  TRY(count_up_in_parts(&order));
  const Span<const Vec3> position = wires.position.span();
  TRY(sort_in_parts(context, order.span(), [position](uint32_t a, uint32_t b) {
    if (position[a] != position[b]) return lies_before(position[a], position[b]);
    return a < b;
  }));
  return in_parts(context, order.size(), [&](size_t k) {
    if (k > 0 && position[order[k]] == position[order[k - 1]]) sets->unite(order[k], order[k - 1]);
  });
}

Status number_points(DisjointSets* sets, Wires* wires) {
  Context& context = wires->position.context();
  Array<uint32_t> name(context);
  TRY(assign_in_parts(wires->samples(), k_none, &name));
  TRY(wires->point.resize(wires->samples()));
  wires->points = 0;
  return in_parts(context, wires->samples(), [&](size_t i) {
    const uint32_t root = sets->find(static_cast<uint32_t>(i));  // the least: it has its name
    if (name[root] == k_none) name[root] = wires->points++;
    wires->point[i] = name[root];
  });
}

Status weld(Wires* wires) {
  DisjointSets sets(wires->position.context());
  TRY(sets.reset(wires->samples()));
  TRY(unite_numbers(*wires, &sets));
  TRY(unite_places(*wires, &sets));
  return number_points(&sets, wires);
}

Status list_members(const Wires& wires, PointMembers* members) {
  TRY(assign_in_parts(wires.points + size_t{1}, 0, &members->first));
  TRY(members->member.resize(wires.samples()));
  Context& context = wires.position.context();
  TRY(in_parts(context, wires.samples(), [&](size_t i) { ++members->first[wires.point[i]]; }));
  starts_from_counts(members->first.span());
  TRY(in_parts(context, wires.samples(), [&](size_t i) {
    members->member[members->first[wires.point[i]]++] = static_cast<uint32_t>(i);
  }));
  shift_starts_back(members->first.span());
  return {};
}

Status count_wires(const Wires& wires, Array<uint32_t>* component, WireCounts* counts) {
  Context& context = wires.position.context();
  PointMembers members(context);
  Array<uint32_t> curve(context);
  DisjointSets sets(context);
  TRY(list_members(wires, &members));
  TRY(curve_of_samples(wires, &curve));
  TRY(sets.reset(wires.curves()));
  TRY(component->assign(wires.curves(), k_none));
  *counts = {wires.curves(), wires.samples(), 0, 0, 0};
  Pace pace(context);
  for (uint32_t p = 0; p < wires.points; ++p) {
    const Span<const uint32_t> own = members[p];
    TRY(pace.after(own.size()));
    if (own.size() > 1) ++counts->nodes;
    if (own.size() == 1 && wires.is_end(curve[own[0]], own[0])) ++counts->dangling;
    for (uint32_t i : own) sets.unite(curve[own[0]], curve[i]);
  }
  for (uint32_t c = 0; c < wires.curves(); ++c) {
    const uint32_t root = sets.find(c);
    if ((*component)[root] == k_none) (*component)[root] = counts->components++;
    (*component)[c] = (*component)[root];
  }
  return {};
}

Status automatic_tolerance(const Wires& wires, double diagonal, double* tolerance) {
  Context& context = wires.position.context();
  Array<double> lengths(context);
  TRY(lengths.reserve(wires.samples()));
  Pace pace(context);
  for (uint32_t c = 0; c < wires.curves(); ++c) {
    for (uint32_t i = wires.start[c]; i < wires.start[c + 1]; ++i) {
      TRY(pace.after());
      const uint32_t j = wires.next(c, i);
      if (j != k_none) lengths.push_reserved(length(wires.position[j] - wires.position[i]));
    }
  }
  TRY(sort_in_parts(context, lengths.span(), Ascending()));
  const double median = lengths.empty() ? 0.0 : lengths[lengths.size() / 2];
  *tolerance = median < 0.01 * diagonal ? median : 0.01 * diagonal;
  return {};
}

}  // namespace wireskin::network
