#include "flow/delaunay.h"

#include "base/in_parts.h"
#include "base/sort.h"
#include "flow/delaunay_order.h"
#include "num/predicates3.h"

namespace wireskin::flow {

// While points are added the hull is closed by ghosts: tetrahedra of a hull face and the vertex at
// infinity. Vertices are numbered in the order of insertion.
static constexpr uint32_t k_infinite = k_none;
static constexpr uint32_t k_most_tets = 1u << 28;

enum Mark : uint8_t { k_unseen = 0, k_conflict = 1, k_clear = 2 };

struct CavityFace {
  uint32_t inner;  // 4 * tetrahedron of the cavity + face
  uint32_t fresh;  // the tetrahedron that is to stand on it
};

struct DelaunayBuilder {
  explicit DelaunayBuilder(Context& context)
      : point(context),
        tets(context),
        mark(context),
        vacant(context),
        cavity(context),
        outline(context) {}

  Array<Vec3> point;
  Array<Tetrahedron> tets;
  Array<uint8_t> mark;  // of each tetrahedron; all k_unseen between insertions
  Array<uint32_t> vacant;
  Array<uint32_t> cavity;  // also the queue of its search
  Array<CavityFace> outline;
  uint32_t most_tets = 0;
  uint32_t hint = 0;  // a tetrahedron near the last point
};

// Infinity is the only vertex number with the top bit.
static bool is_ghost(const Tetrahedron& t) {
  return ((t.vertex[0] | t.vertex[1] | t.vertex[2] | t.vertex[3]) >> 31) != 0;
}

// Without branches, for no processor could predict them.
static uint32_t tet_corner(const Tetrahedron& t, uint32_t vertex) {
  const uint32_t second = t.vertex[1] == vertex ? 1 : 0;
  const uint32_t third = t.vertex[2] == vertex ? 2 : 0;
  const uint32_t fourth = t.vertex[3] == vertex ? 3 : 0;
  return second | third | fourth;
}

// orient3d of a tetrahedron after p has replaced corner i: positive on the inner side of face i.
static double side_of_face(const DelaunayBuilder& b, const Tetrahedron& t, uint32_t i,
                           const Vec3& p) {
  const Vec3* v[4];
  for (uint32_t k = 0; k < 4; ++k) v[k] = k == i ? &p : b.point.data() + t.vertex[k];
  return orient3d(*v[0], *v[1], *v[2], *v[3]);
}

static bool ball_holds(const DelaunayBuilder& b, const Tetrahedron& t, const Vec3& p) {
  const Vec3* points = b.point.data();
  return insphere(points[t.vertex[0]], points[t.vertex[1]], points[t.vertex[2]],
                  points[t.vertex[3]], p) > 0.0;
}

// The ball of a ghost is the half-space beyond its hull face, and of the face's plane what the ball
// behind it cuts out.
static bool in_conflict(const DelaunayBuilder& b, uint32_t slot, const Vec3& p) {
  const Tetrahedron& t = b.tets[slot];
  if (!is_ghost(t)) return ball_holds(b, t, p);
  const uint32_t corner = tet_corner(t, k_infinite);
  const double side = side_of_face(b, t, corner, p);
  if (side != 0.0) return side > 0.0;
  return ball_holds(b, b.tets[t.across[corner] >> 2], p);
}

// A tetrahedron in conflict with p: the one that p lies in, or a ghost whose hull face sees p. The
// walk crosses faces that have p behind them; in a Delaunay triangulation it never runs in a
// circle.
static uint32_t walk_to(const DelaunayBuilder& b, const Vec3& p) {
  uint32_t slot = b.hint;
  if (is_ghost(b.tets[slot])) {
    slot = b.tets[slot].across[tet_corner(b.tets[slot], k_infinite)] >> 2;
  }
  uint32_t entry = k_none;
  while (true) {
    const Tetrahedron& t = b.tets[slot];
    uint32_t exit = 0;
    while (exit < 4 && (exit == entry || side_of_face(b, t, exit, p) >= 0.0)) ++exit;
    if (exit == 4) return slot;
    const uint32_t next = t.across[exit];
    slot = next >> 2;
    entry = next & 3;
    if (is_ghost(b.tets[slot])) return slot;
  }
}

// The tetrahedra whose balls hold p, connected across faces, and the faces round them.
static Status find_cavity(DelaunayBuilder* b, uint32_t first, const Vec3& p) {
  b->cavity.clear();
  b->outline.clear();
  TRY(b->cavity.push(first));
  b->mark[first] = k_conflict;
  for (size_t i = 0; i < b->cavity.size(); ++i) {
    const uint32_t slot = b->cavity[i];
    for (uint32_t face = 0; face < 4; ++face) {
      const uint32_t beyond = b->tets[slot].across[face] >> 2;
      if (b->mark[beyond] == k_unseen) {
        const bool conflict = in_conflict(*b, beyond, p);
        b->mark[beyond] = conflict ? k_conflict : k_clear;
        if (conflict) TRY(b->cavity.push(beyond));
      }
      if (b->mark[beyond] == k_clear) TRY(b->outline.push({4 * slot + face, k_none}));
    }
  }
  return {};
}

// Makes room for one tetrahedron on each face of the outline, and for the cavity among the vacant.
static Status take_slots(DelaunayBuilder* b) {
  size_t missing = b->outline.size();
  missing -= missing < b->vacant.size() ? missing : b->vacant.size();
  const size_t used = b->tets.size();
  if (used + missing > b->most_tets) {
    return fail(Code::too_large, "the Delaunay triangulation has more tetrahedra than allowed");
  }
  TRY(make_room_in_parts(missing, &b->tets));
  TRY(make_room_in_parts(missing, &b->mark));
  for (size_t i = 0; i < missing; ++i) {
    b->tets.push_reserved({});
    b->mark.push_reserved(k_unseen);
  }
  for (size_t i = 0; i < b->outline.size(); ++i) {
    if (i < missing) {
      b->outline[i].fresh = static_cast<uint32_t>(used + i);
    } else {
      b->outline[i].fresh = b->vacant.back();
      b->vacant.pop();
    }
  }
  return b->vacant.reserve(b->vacant.size() + b->cavity.size());
}

// Each new tetrahedron is the one inside the outline with its corner moved to p.
static void raise_tets(DelaunayBuilder* b, uint32_t vertex) {
  for (const CavityFace& f : b->outline) {
    const uint32_t face = f.inner & 3;
    const Tetrahedron& inner = b->tets[f.inner >> 2];
    Tetrahedron& fresh = b->tets[f.fresh];
    const uint32_t outer = inner.across[face];
    fresh = {{inner.vertex[0], inner.vertex[1], inner.vertex[2], inner.vertex[3]},
             {k_none, k_none, k_none, k_none}};
    fresh.vertex[face] = vertex;
    fresh.across[face] = outer;
    b->tets[outer >> 2].across[outer & 3] = 4 * f.fresh + face;
    b->mark[outer >> 2] = k_unseen;
  }
}

// Turns round an edge of the outline, from `inner` out across face `exit`, until the cavity ends;
// there stands the new tetrahedron to link with. `pivot` is the corner that is neither on the edge
// nor on the face through which the next one is left.
static uint32_t turn_round_edge(const DelaunayBuilder& b, uint32_t inner, uint32_t entry,
                                uint32_t exit) {
  uint32_t slot = inner;
  while (true) {
    const uint32_t next = b.tets[slot].across[exit];
    if (b.mark[next >> 2] != k_conflict) {
      // `next` lies outside; its link already leads to the new tetrahedron, whose corners are those
      // of `slot` but for the one at `exit`.
      const uint32_t fresh = b.tets[next >> 2].across[next & 3] >> 2;
      return 4 * fresh + entry;
    }
    const uint32_t pivot = b.tets[slot].vertex[entry];
    slot = next >> 2;
    entry = next & 3;
    exit = tet_corner(b.tets[slot], pivot);
  }
}

static void link_tets(DelaunayBuilder* b) {
  for (const CavityFace& f : b->outline) {
    const uint32_t face = f.inner & 3;
    for (uint32_t k = 0; k < 4; ++k) {
      if (k == face || b->tets[f.fresh].across[k] != k_none) continue;
      const uint32_t other = turn_round_edge(*b, f.inner >> 2, face, k);
      b->tets[f.fresh].across[k] = other;
      b->tets[other >> 2].across[other & 3] = 4 * f.fresh + k;
    }
  }
}

static Status insert_point(DelaunayBuilder* b, uint32_t vertex) {
  const Vec3 p = b->point[vertex];
  TRY(find_cavity(b, walk_to(*b, p), p));
  TRY(take_slots(b));
  raise_tets(b, vertex);
  link_tets(b);
  for (const uint32_t slot : b->cavity) {
    b->mark[slot] = k_unseen;
    b->vacant.push_reserved(slot);
  }
  b->hint = b->outline.back().fresh;
  return {};
}

static bool on_one_line(const Vec3& a, const Vec3& b, const Vec3& c) {
  return orient2d({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) == 0.0 &&
         orient2d({a.y, a.z}, {b.y, b.z}, {c.y, c.z}) == 0.0 &&
         orient2d({a.z, a.x}, {b.z, b.x}, {c.z, c.x}) == 0.0;
}

// Brings points that span as much as the whole set to the front; returns what they span.
static int bring_simplex_to_front(Span<uint32_t> order, Span<const Vec3> points) {
  const size_t count = order.size();
  if (count < 3) return static_cast<int>(count) - 1;
  const Vec3& a = points[order[0]];
  const Vec3& b = points[order[1]];
  size_t i = 2;
  while (i < count && on_one_line(a, b, points[order[i]])) ++i;
  if (i == count) return 1;
  swap_values(order[2], order[i]);
  const Vec3& c = points[order[2]];
  for (i = 3; i < count && orient3d(a, b, c, points[order[i]]) == 0.0;) ++i;
  if (i == count) return 2;
  swap_values(order[3], order[i]);
  if (orient3d(a, b, c, points[order[3]]) < 0.0) swap_values(order[0], order[1]);
  return 3;
}

// The first tetrahedron in slot 0; the ghost across its face i in slot i + 1, with two corners
// exchanged so that it is positively oriented.
static Status begin_with_simplex(DelaunayBuilder* b) {
  TRY(b->tets.resize(5));
  TRY(b->mark.assign(5, k_unseen));
  for (uint32_t i = 0; i < 5; ++i) b->tets[i] = {{0, 1, 2, 3}, {4, 8, 12, 16}};
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t j = (i + 1) & 3;  // the corner that changes places with infinity
    Tetrahedron& ghost = b->tets[i + 1];
    b->tets[0].across[i] = 4 * (i + 1) + j;
    ghost.vertex[i] = j;
    ghost.vertex[j] = k_infinite;
    ghost.across[j] = i;
  }
  // Two ghosts meet in the face opposite to the corner that only one of them has.
  for (uint32_t i = 0; i < 4; ++i) {
    for (uint32_t k = 0; k < 4; ++k) {
      if (k == i) continue;
      const uint32_t back = tet_corner(b->tets[k + 1], i);
      b->tets[i + 1].across[tet_corner(b->tets[i + 1], k)] = 4 * (k + 1) + back;
    }
  }
  return {};
}

// Drops ghosts and vacant slots and gives the vertices their numbers back.
static Status finish(Context& context, DelaunayBuilder* b, Span<const uint32_t> order,
                     Delaunay* delaunay) {
  const uint32_t slots = static_cast<uint32_t>(b->tets.size());
  Array<uint32_t> place(context);
  TRY(place.assign(slots, 0));
  for (const uint32_t slot : b->vacant) place[slot] = k_none;
  uint32_t count = 0;
  TRY(in_parts(context, slots, [&](size_t slot) {
    const bool kept = place[slot] != k_none && !is_ghost(b->tets[slot]);
    place[slot] = kept ? count++ : k_none;
  }));
  TRY(context.checkpoint());
  TRY(in_parts(context, slots, [&](size_t slot) {
    if (place[slot] == k_none) return;
    Tetrahedron t = b->tets[slot];
    for (uint32_t i = 0; i < 4; ++i) {
      t.vertex[i] = order[t.vertex[i]];
      const uint32_t beyond = place[t.across[i] >> 2];
      t.across[i] = beyond == k_none ? k_none : 4 * beyond + (t.across[i] & 3);
    }
    b->tets[place[slot]] = t;
  }));
  b->tets.shrink(count);
  delaunay->tets = static_cast<Array<Tetrahedron>&&>(b->tets);
  return {};
}

static bool in_range(double x) {
  const double size = std::fabs(x);
  return x == 0.0 || (size >= k_least_coordinate3 && size <= k_greatest_coordinate3);
}

static Status check_coordinates(Span<const Vec3> points) {
  for (uint32_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points[i];
    if (in_range(p.x) && in_range(p.y) && in_range(p.z)) continue;
    return fail_at_sample(Code::bad_argument, "the coordinate is out of range", k_none, i);
  }
  return {};
}

Status triangulate(Context& context, Span<const Vec3> points, uint32_t most_tets,
                   Delaunay* delaunay) {
  TRY(check_coordinates(points));
  delaunay->tets.clear();
  Array<uint32_t> order(context);
  TRY(delaunay_order(context, points, &order, &delaunay->same_as));
  delaunay->places = static_cast<uint32_t>(order.size());
  delaunay->dimension = bring_simplex_to_front(order.span(), points);
  if (delaunay->dimension < 3) return {};
  DelaunayBuilder b(context);
  // Ghosts and vacant slots come on top of the tetrahedra of the result.
  b.most_tets = most_tets < k_most_tets ? most_tets : k_most_tets;
  TRY(b.point.resize(order.size()));
  for (size_t i = 0; i < order.size(); ++i) b.point[i] = points[order[i]];
  TRY(b.tets.reserve(8 * order.size()));
  TRY(b.mark.reserve(8 * order.size()));
  TRY(begin_with_simplex(&b));
  Pace pace(context);
  for (uint32_t vertex = 4; vertex < order.size(); ++vertex) {
    TRY(insert_point(&b, vertex));
    TRY(pace.after(b.cavity.size() + b.outline.size()));
  }
  return finish(context, &b, order.span(), delaunay);
}

}  // namespace wireskin::flow
