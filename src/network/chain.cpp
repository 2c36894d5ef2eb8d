#include "network/chain.h"

#include "base/in_parts.h"
#include "num/trig.h"

namespace wireskin::network {

// The ends of curve c are 2c (its first sample) and 2c + 1 (its last).
static uint32_t sample_of_end(const Wires& wires, uint32_t end) {
  return end % 2 == 0 ? wires.start[end / 2] : wires.start[end / 2 + 1] - 1;
}

// The k-th sample inward from an end, through a joint if the piece is too short; k_none if there
// is none.
static uint32_t inward(const Wires& wires, Span<const uint32_t> partner, uint32_t end, uint32_t k) {
  for (uint32_t joints = 0; joints < 2; ++joints) {
    const uint32_t count = wires.size(end / 2);
    if (k < count) {
      return end % 2 == 0 ? wires.start[end / 2] + k : wires.start[end / 2 + 1] - 1 - k;
    }
    k -= count - 1;
    end = partner[end ^ 1];
    if (end == k_none) return k_none;
  }
  return k_none;
}

static double turn_between(const Vec3& a, const Vec3& b, const Vec3& c) {
  return angle_between(b - a, c - b);
}

// The turn at the sample next to the joint; zero where the curve ends there.
static double turn_beside(const Wires& wires, Span<const uint32_t> partner, uint32_t end) {
  const uint32_t a = inward(wires, partner, end, 0), b = inward(wires, partner, end, 1);
  const uint32_t c = inward(wires, partner, end, 2);
  if (b == k_none || c == k_none) return 0.0;
  return turn_between(wires.position[a], wires.position[b], wires.position[c]);
}

static bool is_corner(const Wires& wires, Span<const uint32_t> partner, uint32_t end,
                      double corner) {
  constexpr double k_always = k_pi / 3.0, k_relative = k_pi * 35.0 / 180.0;
  const uint32_t other = partner[end];
  const Vec3 joint = wires.position[sample_of_end(wires, end)];
  const double turn = turn_between(wires.position[inward(wires, partner, end, 1)], joint,
                                   wires.position[inward(wires, partner, other, 1)]);
  if (corner > 0.0) return turn > corner;
  if (turn > k_always || turn <= k_relative) return turn > k_always;
  const double before = turn_beside(wires, partner, end);
  const double after = turn_beside(wires, partner, other);
  return turn > 2.0 * (before > after ? before : after);
}

static bool may_join(const Wires& wires, Chaining chaining, uint32_t a, uint32_t b) {
  const uint32_t c = a / 2, d = b / 2;
  if (wires.boundary[c] != wires.boundary[d] || wires.sharp[c] != wires.sharp[d]) return false;
  if (wires.soft[c] != wires.soft[d]) return false;
  // A curve that would close must enclose something.
  if (c == d && wires.size(c) < 4) return false;
  if (wires.size(c) < 2 || wires.size(d) < 2) return false;
  if (chaining == Chaining::all) return true;
  const uint32_t number = wires.number[sample_of_end(wires, a)];
  const bool by_caller = number != k_none && number == wires.number[sample_of_end(wires, b)];
  return !by_caller || wires.size(c) == 2 || wires.size(d) == 2;
}

// Which end each end goes on to, k_none if to none.
static Status link_ends(const Wires& wires, Chaining chaining, double corner,
                        Array<uint32_t>* partner) {
  Context& context = wires.position.context();
  PointMembers members(context);
  Array<uint32_t> curve(context);
  Array<uint8_t> cut(context);
  TRY(list_members(wires, &members));
  TRY(curve_of_samples(wires, &curve));
  TRY(assign_in_parts(size_t{2} * wires.curves(), k_none, partner));
  TRY(assign_in_parts(size_t{2} * wires.curves(), 0, &cut));
  Pace pace(context);
  for (uint32_t p = 0; p < wires.points; ++p) {
    TRY(pace.after());
    const Span<const uint32_t> own = members[p];
    if (own.size() != 2) continue;
    const uint32_t c = curve[own[0]], d = curve[own[1]];
    if (!wires.is_end(c, own[0]) || !wires.is_end(d, own[1])) continue;
    const uint32_t a = 2 * c + (own[0] != wires.start[c]), b = 2 * d + (own[1] != wires.start[d]);
    if (!may_join(wires, chaining, a, b)) continue;
    (*partner)[a] = b;
    (*partner)[b] = a;
  }
  // Corners are judged while all joints still stand, so that the order does not matter.
  TRY(in_parts(context, partner->size(), [&](size_t end) {
    const uint32_t e = static_cast<uint32_t>(end);
    cut[e] = (*partner)[e] != k_none && is_corner(wires, partner->span(), e, corner);
  }));
  return in_parts(context, partner->size(), [&](size_t e) {
    if (!cut[e] || (*partner)[e] == k_none) return;
    (*partner)[(*partner)[e]] = k_none;
    (*partner)[e] = k_none;
  });
}

static void append_sample(const Wires& from, uint32_t i, bool backwards, bool sharp, Wires* to) {
  to->position.push_reserved(from.position[i]);
  const bool swap = backwards && sharp && !from.right.empty();
  to->normal.push_reserved(swap ? from.right[i] : from.normal[i]);
  if (!from.right.empty()) to->right.push_reserved(swap ? from.normal[i] : from.right[i]);
  to->point.push_reserved(from.point[i]);
  to->number.push_reserved(from.number[i]);
  to->origin.push_reserved(from.origin[i]);
}

// Appends one piece, entered at `end`; the first sample is left out where it was the last one of
// the piece before. A joint takes the normal of the piece that has one.
static Status append_piece(const Wires& from, uint32_t end, bool joined, Pace* pace, Wires* to) {
  const uint32_t c = end / 2, count = from.size(c);
  const bool backwards = end % 2 != 0;
  for (uint32_t k = 0; k < count; ++k) {
    TRY(pace->after());
    const uint32_t i = backwards ? from.start[c + 1] - 1 - k : from.start[c] + k;
    if (k == 0 && joined) {
      if (to->normal.back() == Vec3{}) to->normal.back() = from.normal[i];
    } else {
      append_sample(from, i, backwards, from.sharp[c] != 0, to);
    }
    if (from.along.empty() || (k + 1 == count && !from.closed[c])) continue;
    EdgeOrigin along = from.along[backwards ? i - 1 : i];
    along.backwards ^= backwards ? 1u : 0u;
    to->along.push_reserved(along);
  }
  return {};
}

static void finish_curve(const Wires& from, uint32_t c, bool closed, bool chained, Wires* to) {
  if (!closed && !from.along.empty()) to->along.push_reserved(EdgeOrigin{});
  if (closed && chained) {  // the last end is the first sample again
    to->position.pop(), to->normal.pop(), to->point.pop(), to->number.pop(), to->origin.pop();
    if (!from.right.empty()) to->right.pop();
  }
  to->closed.push_reserved(closed);
  to->boundary.push_reserved(from.boundary[c]);
  to->sharp.push_reserved(from.sharp[c]);
  to->soft.push_reserved(from.soft[c]);
  to->start.push_reserved(to->samples());
}

Status chain_wires(Chaining chaining, double corner, Wires* wires) {
  if (chaining == Chaining::none) return {};
  Context& context = wires->position.context();
  Array<uint32_t> partner(context);
  Array<uint8_t> used(context);
  Wires result(context);
  TRY(link_ends(*wires, chaining, corner, &partner));
  TRY(assign_in_parts(wires->curves(), 0, &used));
  TRY(reserve_wires(wires->curves(), wires->samples(), !wires->right.empty(), &result));
  result.start.push_reserved(0);
  Pace pace(context);
  for (uint32_t c = 0; c < wires->curves(); ++c) {
    if (used[c]) continue;
    // Back to where the chain begins, or once round.
    uint32_t enter = 2 * c;
    bool closed = false;
    while (partner[enter] != k_none && !closed) {
      TRY(pace.after());
      enter = partner[enter] ^ 1;
      closed = enter == 2 * c;
    }
    bool joined = false;
    for (uint32_t end = enter; end != k_none; end = partner[end ^ 1]) {
      if (used[end / 2]) break;
      used[end / 2] = 1;
      TRY(append_piece(*wires, end, joined, &pace, &result));
      joined = true;
    }
    finish_curve(*wires, c, closed || wires->closed[c], closed, &result);
  }
  result.points = wires->points;
  *wires = static_cast<Wires&&>(result);
  return {};
}

}  // namespace wireskin::network
