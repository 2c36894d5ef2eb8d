#include "network/connect.h"

#include "base/in_parts.h"

namespace wireskin::network {

// Samples that the caller gave one number lie at one place, or near enough to be snapped.
static Status check_numbers(const Wires& wires, double tolerance) {
  constexpr double k_same_place = 1e-9;
  Context& context = wires.position.context();
  PointMembers members(context);
  TRY(list_members(wires, &members));
  const double limit = tolerance > k_same_place ? tolerance : k_same_place;
  Pace pace(context);
  for (uint32_t p = 0; p < wires.points; ++p) {
    TRY(pace.after(members[p].size()));
    for (uint32_t i : members[p]) {
      if (length(wires.position[i] - wires.position[members[p][0]]) <= limit) continue;
      Place place;
      place.curve = wires.origin[i].curve;
      place.sample = wires.origin[i].sample;
      place.node = wires.number[i];
      return fail(Code::node_mismatch, "samples of the same node lie at different points", place);
    }
  }
  return {};
}

// Points whose samples were not all one node of the caller's.
static Status find_new_points(const Wires& wires, Array<uint8_t>* joined) {
  Array<uint32_t> number(wires.position.context());
  TRY(assign_in_parts(wires.points, k_none, &number));
  TRY(assign_in_parts(wires.points, 0, joined));
  Array<uint8_t> seen(wires.position.context());
  TRY(assign_in_parts(wires.points, 0, &seen));
  return in_parts(wires.position.context(), wires.samples(), [&](size_t i) {
    const uint32_t p = wires.point[i];
    if (seen[p] && (number[p] != wires.number[i] || number[p] == k_none)) (*joined)[p] = 1;
    number[p] = wires.number[i];
    seen[p] = 1;
  });
}

static Status complete_normals(const ConnectOptions& options, Wires* wires, ConnectResult* result) {
  Context& context = wires->position.context();
  Array<uint8_t> turned(context), joined(context);
  if (options.orient) TRY(orient_along(wires, &turned, &result->contradictions));
  TRY(fill_along(wires, &result->normals));
  if (options.orient) {
    TRY(orient_across(wires, turned.span(), &result->contradictions));
    TRY(in_parts(context, turned.size(), [&](size_t i) { result->turned += turned[i]; }));
  }
  TRY(fill_from_nodes(wires, &result->normals));
  TRY(find_new_points(*wires, &joined));
  return reconcile_normals(joined.span(), wires, &result->contradictions);
}

Status connect_wires(Context& context, const ConnectOptions& options, double diagonal, Wires* wires,
                     ConnectResult* result) {
  Array<uint32_t> component(context);
  TRY(context.enter(Stage::network));
  TRY(weld(wires));
  TRY(count_wires(*wires, &component, &result->before));
  result->tolerance = options.tolerance;
  if (options.snap && options.tolerance == 0.0) {
    TRY(automatic_tolerance(*wires, diagonal, &result->tolerance));
  }
  TRY(check_numbers(*wires, options.snap ? result->tolerance : 0.0));
  TRY(chain_wires(options.chaining, options.corner, wires));
  TRY(context.progress(0.3));
  if (options.snap) {
    TRY(snap_wires(result->tolerance, wires, &result->snapping));
    TRY(context.progress(0.8));
    TRY(chain_wires(options.chaining, options.corner, wires));
  }
  TRY(complete_normals(options, wires, result));
  TRY(count_wires(*wires, &component, &result->after));
  return context.progress(1.0);
}

}  // namespace wireskin::network
