#include "flow/remesh.h"

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

struct LocalMesh {
  Array<uint32_t> parent;  // corners that are one vertex, by union-find
  Array<uint32_t> number;
  Array<Vec3> position;
  Array<uint32_t> sample, triangle;

  explicit LocalMesh(Context& context)
      : parent(context), number(context), position(context), sample(context), triangle(context) {}
};

}  // namespace

static Status gather_own(const Reconstruction& r, OwnTriangles* own) {
  const Array<uint32_t>& owner = r.patches.owner;
  TRY(own->start.assign(size_t{r.patches.size()} + 1, 0));
  TRY(own->triangle.resize(owner.size()));
  TRY(own->place.assign(owner.size(), k_none));
  for (const uint32_t p : owner) {
    if (p != k_none) ++own->start[p];
  }
  own->triangle.shrink(starts_from_counts(own->start.span()));
  for (uint32_t t = 0; t < owner.size(); ++t) {
    if (owner[t] != k_none) own->triangle[own->start[owner[t]]++] = t;
  }
  for (size_t p = r.patches.size(); p > 0; --p) own->start[p] = own->start[p - 1];
  own->start[0] = 0;
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
  for (uint32_t i = 0; i < part.size(); ++i) {
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

static Status refine_one(Context& context, const Flow& flow, const Reconstruction& r,
                         const OwnTriangles& own, uint32_t p, double spacing, LocalMesh* local,
                         RefinedPatches* refined) {
  TRY(cut_out(flow, r, own.of(p), own.place.span(), local));
  const size_t held = local->position.size();
  if (refined->effort[p] != k_untouched) {
    const Status status =
        mesh::refine_patch(context, spacing, refined->effort[p] == k_full, local->sample.span(),
                           &local->position, &local->triangle);
    // A patch that is no surface (it touches itself along an edge) stays as it is.
    if (status.code == Code::bad_mesh) {
      refined->effort[p] = k_untouched;
      return refine_one(context, flow, r, own, p, spacing, local, refined);
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
  for (size_t v = 0; v < local->position.size(); ++v) {
    TRY(refined->position.push(local->position[v]));
    TRY(refined->sample.push(v < held ? local->sample[v] : k_none));
  }
  for (const uint32_t v : local->triangle) TRY(refined->corner.push(v));
  return {};
}

static Status assemble(const Flow& flow, const RefinedPatches& refined, FlowMesh* mesh) {
  const Array<Vec3>& samples = flow.samples.position;
  size_t points = samples.size(), corners = 0;
  for (const Slice& s : refined.slice) {
    points += s.points - s.held;
    corners += s.corners;
  }
  TRY(mesh->position.reserve(points));
  TRY(mesh->sample.reserve(points));
  TRY(mesh->triangle.resize(corners));
  TRY(mesh->patch.resize(corners / 3));
  mesh->position.clear();
  mesh->sample.clear();
  for (uint32_t v = 0; v < samples.size(); ++v) {
    mesh->position.push_reserved(samples[v]);
    mesh->sample.push_reserved(v);
  }
  size_t at = 0;
  for (uint32_t p = 0; p < refined.slice.size(); ++p) {
    const Slice& s = refined.slice[p];
    const uint32_t first = static_cast<uint32_t>(mesh->position.size()) - s.held;
    for (uint32_t i = s.held; i < s.points; ++i) {
      mesh->position.push_reserved(refined.position[s.point + i]);
      mesh->sample.push_reserved(k_none);
    }
    for (uint32_t i = 0; i < s.corners; ++i, ++at) {
      const uint32_t v = refined.corner[s.corner + i];
      mesh->triangle[at] = v < s.held ? refined.sample[s.point + v] : first + v;
      mesh->patch[at / 3] = p;
    }
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

Status mesh_patches(Context& context, const Flow& flow, const Reconstruction& reconstruction,
                    double spacing, FlowMesh* mesh) {
  const bool refine = spacing > 0.0;
  const uint32_t patches = reconstruction.patches.size();
  OwnTriangles own(context);
  LocalMesh local(context);
  RefinedPatches refined(context);
  Array<uint8_t> again(context);
  Array<uint32_t> pairs(context);
  TRY(gather_own(reconstruction, &own));
  TRY(refined.effort.assign(patches, refine ? k_full : k_untouched));
  TRY(refined.slice.assign(patches, Slice{}));
  TRY(again.assign(patches, 1));
  while (true) {
    for (uint32_t p = 0; p < patches; ++p) {
      if (again[p] == 0) continue;
      TRY(refine_one(context, flow, reconstruction, own, p, spacing, &local, &refined));
      TRY(context.checkpoint());
    }
    TRY(assemble(flow, refined, mesh));
    TRY(find_crossings(context, mesh->position.span(), mesh->triangle.span(), k_most_pairs,
                       &pairs));
    if (!hold_back(*mesh, pairs.span(), refined.effort.span(), again.span())) break;
  }
  TRY(move_to_complex(context, flow, &pairs, mesh));
  mesh->crossings = static_cast<uint32_t>(pairs.size() / 2);
  mesh->held_back = 0;
  for (const uint8_t effort : refined.effort) mesh->held_back += refine && effort != k_full;
  return {};
}

}  // namespace wireskin::flow
