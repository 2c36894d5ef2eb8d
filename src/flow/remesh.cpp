#include "flow/remesh.h"

#include "base/in_parts.h"
#include "flow/crossings.h"
#include "mesh/loop_refine.h"

namespace wireskin::flow {

namespace {

constexpr size_t k_most_pairs = 1000;
constexpr uint8_t k_untouched = 0, k_full = 2;  // between them: refined, not relaxed

struct Slice {
  uint32_t point, points;  // in RefinedPatches::position; the first `held` of them are samples
  uint32_t held;
  uint32_t corner, corners;
};

// Meshes of patches one behind the other; a patch that is made again leaves its old one behind.
struct RefinedPatches {
  Array<uint8_t> effort;
  Array<Slice> slice;
  Array<Vec3> position;
  Array<uint32_t> sample;  // of each point, k_none for new ones
  Array<uint32_t> corner;  // vertex numbers local to the patch

  explicit RefinedPatches(Context& context)
      : effort(context), slice(context), position(context), sample(context), corner(context) {}
};

// Which triangles each patch comes first in.
struct OwnTriangles {
  Array<uint32_t> start, triangle, place;  // place: of each triangle of the complex in its patch

  explicit OwnTriangles(Context& context) : start(context), triangle(context), place(context) {}
  Span<const uint32_t> of(uint32_t p) const {
    return triangle.span().part(start[p], start[p + 1] - start[p]);
  }
};

// Flat ears that several sheets meet at, and tails that are no wider: between a stretch of a curve
// and the edge ab that passes over it. Instead of all ending at ab, each sheet goes on to the
// curve, and the ear is left out.
struct SharedEars {
  Array<uint32_t> first;  // of each edge of the complex: ab's place in `inner`, or k_none
  Array<uint32_t> inner;  // samples between a and b, from the edge's first end on, then k_none
  Array<uint32_t> left_out_for;  // of each triangle: the edge whose ear it is in, or k_none

  explicit SharedEars(Context& context) : first(context), inner(context), left_out_for(context) {}
};

constexpr uint32_t k_most_of_ear = 32;
constexpr double k_flat_ear = 0.25;  // height, of the length of ab

struct Ear {
  uint32_t triangle[k_most_of_ear], border[k_most_of_ear], inner[k_most_of_ear];
  uint32_t count = 0, borders = 0;
};

struct LocalMesh {
  Array<uint32_t> parent;  // corners that are one vertex, by union-find
  Array<uint32_t> number;
  Array<Vec3> position;
  Array<uint32_t> sample, triangle;

  explicit LocalMesh(Context& context)
      : parent(context), number(context), position(context), sample(context), triangle(context) {}
};

}  // namespace

// The triangles from t on that no curve or branch parts, up to k_most_of_ear; their other borders.
static bool flood_ear(const Flow& flow, const Sheet& walls, uint32_t chord, Ear* ear) {
  const Complex& complex = flow.complex;
  ear->borders = 0;
  for (uint32_t i = 0; i < ear->count; ++i) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{ear->triangle[i]} + k];
      if (e == chord) continue;
      if (flow.curves.on_curve(e)) {
        if (ear->borders == k_most_of_ear) return false;
        ear->border[ear->borders++] = e;
        continue;
      }
      if (walls.degree[e] != 2) return false;
      for (const uint32_t u : complex.triangles_of(e)) {
        bool known = walls.in[u] == 0;
        for (uint32_t j = 0; j < ear->count; ++j) known = known || ear->triangle[j] == u;
        if (known) continue;
        if (ear->count == k_most_of_ear) return false;
        ear->triangle[ear->count++] = u;
      }
    }
  }
  // A disc without a vertex inside.
  return ear->borders == ear->count + 1;
}

// Orders the border from one end of the chord to the other; false if it is no path close to it.
static bool walk_ear(const Flow& flow, uint32_t chord, Ear* ear) {
  const Complex& complex = flow.complex;
  const uint32_t from = complex.edge[2 * size_t{chord}], to = complex.edge[2 * size_t{chord} + 1];
  const Vec3 &a = complex.point[from], along = complex.point[to] - a;
  uint32_t at = from;
  for (uint32_t i = 0; i < ear->borders; ++i) {
    uint32_t next = k_none;
    for (uint32_t j = i; j < ear->borders && next == k_none; ++j) {
      const uint32_t* const end = &complex.edge[2 * size_t{ear->border[j]}];
      if (end[0] != at && end[1] != at) continue;
      next = end[0] == at ? end[1] : end[0];
      ear->border[j] = ear->border[i];
    }
    if (next == k_none || (next == to) != (i + 1 == ear->borders)) return false;
    const double off = length(cross(complex.point[next] - a, along));
    if (off > k_flat_ear * dot(along, along)) return false;
    ear->inner[i] = at = next;
  }
  return true;
}

static Status find_shared_ears(const Flow& flow, const Reconstruction& r, SharedEars* ears) {
  const Complex& complex = flow.complex;
  const Sheet& walls = r.topology.walls;
  TRY(ears->first.assign(complex.edge_count(), k_none));
  TRY(ears->left_out_for.assign(complex.triangle_count(), k_none));
  Pace pace(ears->first.context());
  for (uint32_t e = 0; e < complex.edge_count(); ++e) {
    TRY(pace.after());
    if (walls.degree[e] < 3 || flow.curves.on_curve(e)) continue;
    Ear found, ear;
    uint32_t flat = 0;
    for (const uint32_t t : complex.triangles_of(e)) {
      if (walls.in[t] == 0) continue;
      ear.count = 1;
      ear.triangle[0] = t;
      if (!flood_ear(flow, walls, e, &ear) || !walk_ear(flow, e, &ear)) continue;
      found = ear;
      ++flat;
    }
    if (flat != 1) continue;
    ears->first[e] = static_cast<uint32_t>(ears->inner.size());
    for (uint32_t i = 0; i + 1 < found.borders; ++i) TRY(ears->inner.push(found.inner[i]));
    TRY(ears->inner.push(k_none));
    for (uint32_t i = 0; i < found.count; ++i) ears->left_out_for[found.triangle[i]] = e;
  }
  return {};
}

static Status gather_own(const Reconstruction& r, const SharedEars& ears, OwnTriangles* own) {
  const Array<uint32_t>& owner = r.patches.owner;
  TRY(own->start.assign(size_t{r.patches.size()} + 1, 0));
  TRY(own->triangle.resize(owner.size()));
  TRY(own->place.assign(owner.size(), k_none));
  const auto is_own = [&](uint32_t t) {
    return owner[t] != k_none && ears.left_out_for[t] == k_none;
  };
  TRY(in_parts(own->start.context(), owner.size(), [&](size_t i) {
    const uint32_t t = static_cast<uint32_t>(i);
    if (is_own(t)) ++own->start[owner[t]];
  }));
  own->triangle.shrink(starts_from_counts(own->start.span()));
  TRY(in_parts(own->start.context(), owner.size(), [&](size_t i) {
    const uint32_t t = static_cast<uint32_t>(i);
    if (is_own(t)) own->triangle[own->start[owner[t]]++] = t;
  }));
  shift_starts_back(own->start.span());
  for (uint32_t p = 0; p < r.patches.size(); ++p) {
    const Span<const uint32_t> part = own->of(p);
    for (uint32_t i = 0; i < part.size(); ++i) own->place[part[i]] = i;
  }
  return {};
}

// Corner k of a triangle as it is turned.
static uint32_t turned_corner(const Reconstruction& r, uint32_t t, uint32_t k) {
  return r.patches.turned[t] != 0 ? (3 - k) % 3 : k;
}

static uint32_t corner_root(Span<uint32_t> parent, uint32_t c) {
  while (parent[c] != c) c = parent[c] = parent[parent[c]];
  return c;
}

// Where vertex v stands among the stored corners of triangle t.
static uint32_t corner_of(const Complex& complex, uint32_t t, uint32_t v) {
  const uint32_t* const corner = &complex.triangle[3 * size_t{t}];
  return corner[0] == v ? 0 : corner[1] == v ? 1 : 2;
}

// The triangle across an edge that the patch may be refined over; k_none where it is cut.
static uint32_t across(const Flow& flow, const Reconstruction& r, uint32_t t, uint32_t k) {
  const uint32_t e = flow.complex.triangle_edge[3 * size_t{t} + k];
  if (r.topology.walls.degree[e] != 2 || flow.curves.on_curve(e)) return k_none;
  for (const uint32_t u : flow.complex.triangles_of(e)) {
    if (u == t || r.topology.walls.in[u] == 0 || r.patches.owner[u] != r.patches.owner[t]) continue;
    // Neighbours that are turned alike pass the edge in opposite directions.
    const uint32_t a = corner_of(flow.complex, t, flow.complex.edge[2 * size_t{e}]);
    const uint32_t b = corner_of(flow.complex, t, flow.complex.edge[2 * size_t{e} + 1]);
    const uint32_t c = corner_of(flow.complex, u, flow.complex.edge[2 * size_t{e}]);
    const uint32_t d = corner_of(flow.complex, u, flow.complex.edge[2 * size_t{e} + 1]);
    const bool up_t = ((a + 1) % 3 == b) != (r.patches.turned[t] != 0);
    const bool up_u = ((c + 1) % 3 == d) != (r.patches.turned[u] != 0);
    return up_t != up_u ? u : k_none;
  }
  return k_none;
}

// The patch as a mesh of its own in which every edge that must stay is on the border.
static Status cut_out(const Flow& flow, const Reconstruction& r, Span<const uint32_t> part,
                      Span<const uint32_t> place, LocalMesh* local) {
  const Complex& complex = flow.complex;
  const uint32_t corners = static_cast<uint32_t>(3 * part.size());
  TRY(local->parent.resize(corners));
  TRY(local->number.assign(corners, k_none));
  TRY(local->triangle.resize(corners));
  TRY(local->position.reserve(corners));
  TRY(local->sample.reserve(corners));
  local->position.clear();
  local->sample.clear();
  for (uint32_t c = 0; c < corners; ++c) local->parent[c] = c;
  Pace pace(local->parent.context());
  for (uint32_t i = 0; i < part.size(); ++i) {
    TRY(pace.after());
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t t = part[i], u = across(flow, r, t, k);
      if (u == k_none) continue;
      for (uint32_t end = 1; end < 3; ++end) {
        const uint32_t at = (k + end) % 3;
        const uint32_t v = complex.triangle[3 * size_t{t} + at];
        const uint32_t a = corner_root(local->parent.span(), 3 * i + at);
        const uint32_t b =
            corner_root(local->parent.span(), 3 * place[u] + corner_of(complex, u, v));
        if (a < b) local->parent[b] = a;
        if (b < a) local->parent[a] = b;
      }
    }
  }
  for (uint32_t i = 0; i < part.size(); ++i) {
    TRY(pace.after());
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t stored = turned_corner(r, part[i], k);
      const uint32_t root = corner_root(local->parent.span(), 3 * i + stored);
      if (local->number[root] == k_none) {
        const uint32_t v = complex.triangle[3 * size_t{part[i]} + stored];
        local->number[root] = static_cast<uint32_t>(local->position.size());
        local->position.push_reserved(flow.samples.position[v]);
        local->sample.push_reserved(v);
      }
      local->triangle[3 * i + k] = local->number[root];
    }
  }
  return {};
}

// Splits the triangle with the side uv, among i and those from `begin` on, into a fan over the
// samples that an ear has between u and v.
static Status fan_out(const Flow& flow, Span<const uint32_t> inner, bool backward, uint32_t u,
                      uint32_t v, uint32_t i, uint32_t begin, LocalMesh* local) {
  Array<uint32_t>& triangle = local->triangle;
  uint32_t at = i, k = 0;
  const auto has_side = [&] {
    return triangle[3 * size_t{at} + k] == u && triangle[3 * size_t{at} + (k + 1) % 3] == v;
  };
  for (uint32_t next = begin; !has_side();) {
    if (++k < 3) continue;
    k = 0;
    at = next++;
  }
  const uint32_t apex = triangle[3 * size_t{at} + (k + 2) % 3];
  for (size_t j = 0; j < inner.size(); ++j) {
    const uint32_t m = inner[backward ? inner.size() - 1 - j : j];
    const uint32_t number = static_cast<uint32_t>(local->position.size());
    TRY(local->position.push(flow.samples.position[m]));
    TRY(local->sample.push(m));
    TRY(triangle.push(u));
    TRY(triangle.push(number));
    TRY(triangle.push(apex));
    u = number;
  }
  const uint32_t last[3] = {u, v, apex};
  for (uint32_t c = 0; c < 3; ++c) triangle[3 * size_t{at} + c] = last[c];
  return {};
}

// Lets the triangles at shared ears go on to the curves.
static Status reach_curves(const Flow& flow, const Reconstruction& r, const SharedEars& ears,
                           Span<const uint32_t> part, LocalMesh* local) {
  for (uint32_t i = 0; !ears.inner.empty() && i < part.size(); ++i) {
    const uint32_t begin = static_cast<uint32_t>(local->triangle.size() / 3);
    uint32_t corner[3];
    const size_t half_edge = 3 * size_t{i};
    for (uint32_t k = 0; k < 3; ++k) corner[k] = local->triangle[half_edge + k];
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t opposite = turned_corner(r, part[i], (k + 2) % 3);
      const uint32_t e = flow.complex.triangle_edge[3 * size_t{part[i]} + opposite];
      const uint32_t first = ears.first[e];
      if (first == k_none) continue;
      uint32_t count = 0;
      while (ears.inner[first + count] != k_none) ++count;
      const bool backward = local->sample[corner[k]] != flow.complex.edge[2 * size_t{e}];
      TRY(fan_out(flow, ears.inner.span().part(first, count), backward, corner[k],
                  corner[(k + 1) % 3], i, begin, local));
    }
  }
  return {};
}

static Status refine_one(Context& context, const Flow& flow, const Reconstruction& r,
                         const SharedEars& ears, const OwnTriangles& own, uint32_t p,
                         double spacing, LocalMesh* local, RefinedPatches* refined) {
  TRY(cut_out(flow, r, own.of(p), own.place.span(), local));
  TRY(reach_curves(flow, r, ears, own.of(p), local));
  const size_t held = local->position.size();
  if (refined->effort[p] != k_untouched) {
    const Status status =
        mesh::refine_patch(context, spacing, refined->effort[p] == k_full, local->sample.span(),
                           &local->position, &local->triangle);
    // A patch that is no surface (it touches itself along an edge) stays as it is.
    if (status.code == Code::bad_mesh) {
      refined->effort[p] = k_untouched;
      return refine_one(context, flow, r, ears, own, p, spacing, local, refined);
    }
    TRY(status);
  }
  if (refined->position.size() + local->position.size() >= k_none / 8) {
    return fail(Code::too_large, "the spacing is too small for 32-bit indices");
  }
  refined->slice[p] = {static_cast<uint32_t>(refined->position.size()),
                       static_cast<uint32_t>(local->position.size()), static_cast<uint32_t>(held),
                       static_cast<uint32_t>(refined->corner.size()),
                       static_cast<uint32_t>(local->triangle.size())};
  TRY(make_room_in_parts(local->position.size(), &refined->position));
  TRY(make_room_in_parts(local->position.size(), &refined->sample));
  TRY(make_room_in_parts(local->triangle.size(), &refined->corner));
  TRY(in_parts(context, local->position.size(), [&](size_t v) {
    refined->position.push_reserved(local->position[v]);
    refined->sample.push_reserved(v < held ? local->sample[v] : k_none);
  }));
  return in_parts(context, local->triangle.size(),
                  [&](size_t i) { refined->corner.push_reserved(local->triangle[i]); });
}

static Status assemble(const Flow& flow, const RefinedPatches& refined, FlowMesh* mesh) {
  const Array<Vec3>& samples = flow.samples.position;
  size_t points = samples.size(), corners = 0;
  for (const Slice& s : refined.slice) {
    points += s.points - s.held;
    corners += s.corners;
  }
  // What an earlier round has left is not worth moving.
  mesh->position.clear();
  mesh->sample.clear();
  mesh->triangle.clear();
  mesh->patch.clear();
  TRY(mesh->position.reserve(points));
  TRY(mesh->sample.reserve(points));
  TRY(mesh->triangle.resize(corners));
  TRY(mesh->patch.resize(corners / 3));
  Context& context = mesh->position.context();
  TRY(context.checkpoint());
  for (uint32_t v = 0; v < samples.size(); ++v) {
    mesh->position.push_reserved(samples[v]);
    mesh->sample.push_reserved(v);
  }
  size_t at = 0;
  for (uint32_t p = 0; p < refined.slice.size(); ++p) {
    const Slice& s = refined.slice[p];
    const uint32_t first = static_cast<uint32_t>(mesh->position.size()) - s.held;
    TRY(in_parts(context, s.points - s.held, [&](size_t i) {
      mesh->position.push_reserved(refined.position[s.point + s.held + i]);
      mesh->sample.push_reserved(k_none);
    }));
    TRY(in_parts(context, s.corners, [&](size_t i) {
      const uint32_t v = refined.corner[s.corner + i];
      mesh->triangle[at] = v < s.held ? refined.sample[s.point + v] : first + v;
      mesh->patch[at++ / 3] = p;
    }));
  }
  return {};
}

// Patches in crossings try less, and where there are more than were listed nothing at all; true if
// one could.
static bool hold_back(const FlowMesh& mesh, Span<const uint32_t> pairs, Span<uint8_t> effort,
                      Span<uint8_t> again) {
  const bool many = pairs.size() >= 2 * k_most_pairs;
  bool any = false;
  for (uint8_t& flag : again) flag = 0;
  for (const uint32_t t : pairs) {
    const uint32_t p = mesh.patch[t];
    if (again[p] != 0 || effort[p] == k_untouched) continue;
    again[p] = 1;
    effort[p] = many ? k_untouched : static_cast<uint8_t>(effort[p] - 1);
    any = true;
  }
  return any;
}

// What still crosses then are triangles of the complex itself: curves that all but touch, so that
// the jitter counts. At its moved points the complex is embedded, and so those take their places.
static Status move_to_complex(Context& context, const Flow& flow, Array<uint32_t>* pairs,
                              FlowMesh* mesh) {
  constexpr int k_most_rounds = 4;
  for (int round = 0; round < k_most_rounds && !pairs->empty(); ++round) {
    for (const uint32_t t : *pairs) {
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t v = mesh->triangle[3 * size_t{t} + k];
        if (mesh->sample[v] != k_none) mesh->position[v] = flow.complex.point[mesh->sample[v]];
      }
    }
    TRY(find_crossings(context, mesh->position.span(), mesh->triangle.span(), k_most_pairs, pairs));
  }
  return {};
}

// Refines all patches with as much effort as leaves them free of crossings.
static Status refine_all(Context& context, const Flow& flow, const Reconstruction& reconstruction,
                         const SharedEars& ears, double spacing, Array<uint32_t>* pairs,
                         FlowMesh* mesh) {
  const bool refine = spacing > 0.0;
  const uint32_t patches = reconstruction.patches.size();
  OwnTriangles own(context);
  LocalMesh local(context);
  RefinedPatches refined(context);
  Array<uint8_t> again(context);
  TRY(gather_own(reconstruction, ears, &own));
  TRY(refined.effort.assign(patches, refine ? k_full : k_untouched));
  TRY(refined.slice.assign(patches, Slice{}));
  TRY(again.assign(patches, 1));
  while (true) {
    for (uint32_t p = 0; p < patches; ++p) {
      if (again[p] == 0) continue;
      TRY(refine_one(context, flow, reconstruction, ears, own, p, spacing, &local, &refined));
      TRY(context.checkpoint());
    }
    TRY(assemble(flow, refined, mesh));
    TRY(find_crossings(context, mesh->position.span(), mesh->triangle.span(), k_most_pairs, pairs));
    if (!hold_back(*mesh, pairs->span(), refined.effort.span(), again.span())) break;
  }
  mesh->held_back = 0;
  for (const uint8_t effort : refined.effort) mesh->held_back += refine && effort != k_full;
  return {};
}

// Gives up the ears that patches in crossings have, for only the complex itself is sure to be
// embedded; true if there were any.
static bool give_up_ears(const Flow& flow, const Reconstruction& r, Span<const uint8_t> crossing,
                         SharedEars* ears) {
  bool any = false;
  for (uint32_t e = 0; e < flow.complex.edge_count(); ++e) {
    if (ears->first[e] == k_none) continue;
    for (const uint32_t t : flow.complex.triangles_of(e)) {
      const uint32_t owner = r.patches.owner[t];
      if (owner != k_none && crossing[owner] != 0) ears->first[e] = k_none;
    }
    any = any || ears->first[e] == k_none;
  }
  for (uint32_t& e : ears->left_out_for) {
    if (e != k_none && ears->first[e] == k_none) e = k_none;
  }
  return any;
}

Status mesh_patches(Context& context, const Flow& flow, const Reconstruction& reconstruction,
                    double spacing, FlowMesh* mesh) {
  SharedEars ears(context);
  Array<uint32_t> pairs(context);
  Array<uint8_t> crossing(context);
  TRY(find_shared_ears(flow, reconstruction, &ears));
  TRY(refine_all(context, flow, reconstruction, ears, spacing, &pairs, mesh));
  TRY(crossing.assign(reconstruction.patches.size(), 0));
  for (int round = 0; !ears.inner.empty() && !pairs.empty(); ++round) {
    constexpr int k_most_rounds = 3;
    const bool all = round + 1 >= k_most_rounds || pairs.size() >= 2 * k_most_pairs;
    for (const uint32_t t : pairs) crossing[mesh->patch[t]] = 1;
    for (uint8_t& flag : crossing) flag = all ? 1 : flag;
    if (!give_up_ears(flow, reconstruction, crossing.span(), &ears)) break;
    TRY(refine_all(context, flow, reconstruction, ears, spacing, &pairs, mesh));
  }
  TRY(move_to_complex(context, flow, &pairs, mesh));
  mesh->crossings = static_cast<uint32_t>(pairs.size() / 2);
  return {};
}

}  // namespace wireskin::flow
