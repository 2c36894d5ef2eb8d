#include "network/snap_order.h"

#include "base/in_parts.h"

namespace wireskin::network {

// Whether an end of a curve clearly meets the other curve.
static bool ends_on(const Wires& wires, Span<const uint32_t> curve, double near,
                    const Approach& approach) {
  const auto near_end = [&](const WirePlace& place, const Vec3& at) {
    const uint32_t c = curve[place.edge];
    if (wires.closed[c]) return false;
    const Vec3 &first = wires.position[wires.start[c]],
               &last = wires.position[wires.start[c + 1] - 1];
    return length(first - at) <= near || length(last - at) <= near;
  };
  return approach.distance <= near &&
         (near_end(approach.a, approach.at_a) || near_end(approach.b, approach.at_b));
}

// Whether the curves pass each other side by side there instead of crossing: they run along each
// other, or the gap between them lies in the surface.
static bool is_beside(const Beads& beads, const Approach& approach) {
  const Vec3 gap = unit(approach.at_b - approach.at_a);
  const Vec3 along_a = unit(beads.direction_at(approach.a)),
             along_b = unit(beads.direction_at(approach.b));
  const auto square = [](double x) { return x * x; };
  // One goes on where the other one ends.
  if (square(dot(gap, along_a)) + square(dot(gap, along_b)) > 0.5) return false;
  const Vec3 a = beads.normal_at(approach.a), b = beads.normal_at(approach.b);
  if (a != Vec3{} && b != Vec3{}) {
    return square(dot(gap, unit(a))) + square(dot(gap, unit(b))) < 0.5;
  }
  return run_along(along_a, along_b);
}

Status plan_snaps(const Beads& beads, double tolerance, bool complete,
                  Span<const Approach> approaches, Span<const uint32_t> walk, SnapPlan* plan) {
  constexpr size_t k_steps_of_contact = 4;
  Array<Branch> branches(beads.context());
  TRY(plan->pass.resize(approaches.size()));
  TRY(assign_in_parts(approaches.size(), 0, &plan->beside));
  size_t others = 0, exact = 0;
  Pace pace(beads.context());
  for (size_t k = 0; k < approaches.size(); ++k) {
    const Approach& approach = approaches[k];
    const bool touches = approach.distance <= k_exact * tolerance;
    const bool beside = !touches && is_beside(beads, approach);
    const bool ends = ends_on(beads.wires, beads.curve.span(), k_crossing * tolerance, approach);
    plan->pass[k] = beside ? SnapPass::beside : ends ? SnapPass::settled : SnapPass::crosses;
    Contact contact = touches ? Contact::meets : Contact::beside;
    if (!touches) TRY(judge_contact(beads, approach, &branches, &contact));
    const bool points = contact == Contact::points && approach.distance <= k_crossing * tolerance;
    plan->beside[k] = (contact != Contact::meets || beside) && !points;
    others += !beside;
    exact += touches;
    TRY(pace.after(k_steps_of_contact + walk[approach.a.edge] + walk[approach.b.edge]));
  }
  plan->exact = !complete && 4 * exact >= 3 * others;
  if (plan->exact) return {};
  return assign_in_parts(approaches.size(), SnapPass::crosses, &plan->pass);
}

}  // namespace wireskin::network
