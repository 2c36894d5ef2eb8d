#include "mesh/care.h"

#include "base/in_parts.h"
#include "mesh/curvature.h"

namespace wireskin::mesh {

static constexpr int k_relax_sweeps = 5;
static constexpr int k_flip_sweeps = 6;
static constexpr uint32_t k_unfold_sweeps = 40, k_sweeps_a_ring = 5;

namespace {

// Where each vertex is drawn to.
struct Pull {
  Vec3 sum;
  double area;
};

// The two triangles at an edge: a -> b is the edge, c and d the vertices opposite to it.
struct Quad {
  uint32_t a, b, c, d;
};

}  // namespace

static Status relax_once(Context& context, const Movable& mesh, Span<Vec3> normal,
                         Span<Pull> pull) {
  TRY(vertex_normals(context, mesh.position, mesh.triangle, normal));
  TRY(in_parts(context, pull.size(), [&](size_t v) { pull[v] = {Vec3{}, 0.0}; }));
  TRY(in_parts(context, mesh.triangle.size() / 3, [&](size_t t) {
    const uint32_t* v = &mesh.triangle[3 * t];
    const Vec3 &a = mesh.position[v[0]], &b = mesh.position[v[1]], &c = mesh.position[v[2]];
    const double area = length(cross(b - a, c - a));
    const Vec3 weighted = area * ((1.0 / 3.0) * (a + b + c));
    for (int k = 0; k < 3; ++k) {
      pull[v[k]].sum += weighted;
      pull[v[k]].area += area;
    }
  }));
  return in_parts(context, pull.size(), [&](size_t v) {
    if (mesh.held[v] || !(pull[v].area > 0.0)) return;
    const Vec3 step = (1.0 / pull[v].area) * pull[v].sum - mesh.position[v];
    mesh.position[v] += 0.5 * reject(step, normal[v]);
  });
}

static Status relax(Context& context, const Movable& mesh) {
  Array<Vec3> normal(context);
  Array<Pull> pull(context);
  TRY(normal.resize(mesh.position.size()));
  TRY(pull.resize(mesh.position.size()));
  for (int sweep = 0; sweep < k_relax_sweeps; ++sweep) {
    TRY(relax_once(context, mesh, normal.span(), pull.span()));
    TRY(context.checkpoint());
  }
  return {};
}

static Quad quad_at(Span<const uint32_t> triangle, uint32_t h, uint32_t g) {
  return {triangle[h], triangle[g], triangle[previous_half_edge(h)],
          triangle[previous_half_edge(g)]};
}

// The cotangent of the angle at p in the triangle p, q, r.
static double cotangent_at(const Vec3& p, const Vec3& q, const Vec3& r) {
  return dot(q - p, r - p) / length(cross(q - p, r - p));
}

static bool has_edge(Span<const uint32_t> triangle, Span<const uint32_t> twins,
                     uint32_t from_half_edge, uint32_t to) {
  // Round the origin of the half-edge in both directions, because a border may end the walk.
  uint32_t h = from_half_edge;
  do {
    if (triangle[next_half_edge(h)] == to || triangle[previous_half_edge(h)] == to) return true;
    h = twins[previous_half_edge(h)];
  } while (h != k_none && h != from_half_edge);
  for (h = twins[from_half_edge]; h != k_none;) {
    h = next_half_edge(h);
    if (h == from_half_edge) break;
    if (triangle[next_half_edge(h)] == to || triangle[previous_half_edge(h)] == to) return true;
    h = twins[h];
  }
  return false;
}

static bool wants_flip(const Movable& mesh, Span<const uint32_t> twins, uint32_t h) {
  const uint32_t g = twins[h];
  if (g == k_none || g < h || mesh.patch[h / 3] != mesh.patch[g / 3]) return false;
  const Quad q = quad_at(mesh.triangle, h, g);
  if ((mesh.held[q.a] && mesh.held[q.b]) || (mesh.held[q.c] && mesh.held[q.d])) return false;
  const Vec3 &a = mesh.position[q.a], &b = mesh.position[q.b];
  const Vec3 &c = mesh.position[q.c], &d = mesh.position[q.d];
  constexpr double k_rounding = 1e-9;
  if (!(cotangent_at(c, a, b) + cotangent_at(d, a, b) < -k_rounding)) return false;
  const Vec3 facing = unit(cross(b - a, c - a)) + unit(cross(a - b, d - b));
  if (!(dot(cross(d - a, c - a), facing) > 0.0) || !(dot(cross(b - d, c - d), facing) > 0.0)) {
    return false;
  }
  return !has_edge(mesh.triangle, twins, previous_half_edge(h), q.d);
}

// Turns the edge of half-edge h: triangles a b c and b a d become a d c and d b c.
static void flip(Span<uint32_t> triangle, Span<uint32_t> twins, uint32_t h) {
  const uint32_t g = twins[h];
  const Quad q = quad_at(triangle, h, g);
  const uint32_t t = h / 3 * 3, s = g / 3 * 3;
  const uint32_t outer[4] = {twins[next_half_edge(g)], twins[previous_half_edge(g)],
                             twins[next_half_edge(h)], twins[previous_half_edge(h)]};
  const uint32_t slot[4] = {t, s, s + 1, t + 2};  // a d, d b, b c, c a
  triangle[t] = q.a, triangle[t + 1] = q.d, triangle[t + 2] = q.c;
  triangle[s] = q.d, triangle[s + 1] = q.b, triangle[s + 2] = q.c;
  for (int k = 0; k < 4; ++k) {
    twins[slot[k]] = outer[k];
    if (outer[k] != k_none) twins[outer[k]] = slot[k];
  }
  twins[t + 1] = s + 2;
  twins[s + 2] = t + 1;
}

static Vec3 facing_of(const Movable& mesh, uint32_t t) {
  const uint32_t* v = &mesh.triangle[size_t{3} * t];
  const Vec3& a = mesh.position[v[0]];
  return cross(mesh.position[v[1]] - a, mesh.position[v[2]] - a);
}

// Whether the two triangles at half-edge h face against each other, in one patch, at an edge that
// is not between held vertices.
static bool is_fold(const Movable& mesh, Span<const uint32_t> twins, uint32_t h) {
  const uint32_t g = twins[h];
  if (g == k_none || mesh.patch[h / 3] != mesh.patch[g / 3]) return false;
  if (mesh.held[mesh.triangle[h]] && mesh.held[mesh.triangle[g]]) return false;
  return dot(facing_of(mesh, h / 3), facing_of(mesh, g / 3)) < 0.0;
}

// How much the surface turns between two facings, so that a turn shared by two edges costs less.
static double turn_between(const Vec3& a, const Vec3& b) {
  const double turn = 1.0 - dot(unit(a), unit(b));
  return turn * turn;
}

// The turn between a facing at half-edge h and the triangle beyond, none at the rim of the patch.
static double turn_beyond(const Movable& mesh, Span<const uint32_t> twins, uint32_t h,
                          const Vec3& facing) {
  const uint32_t g = twins[h];
  if (g == k_none || mesh.patch[h / 3] != mesh.patch[g / 3]) return 0.0;
  if (mesh.held[mesh.triangle[h]] && mesh.held[mesh.triangle[g]]) return 0.0;
  return turn_between(facing, facing_of(mesh, g / 3));
}

// Flips an edge if the surface then turns less at it and at the four round it.
static bool flip_to_turn_less(const Movable& mesh, Span<uint32_t> twins, uint32_t h) {
  const uint32_t g = twins[h];
  if (g == k_none || mesh.patch[h / 3] != mesh.patch[g / 3]) return false;
  const Quad q = quad_at(mesh.triangle, h, g);
  if ((mesh.held[q.a] && mesh.held[q.b]) || (mesh.held[q.c] && mesh.held[q.d])) return false;
  if (has_edge(mesh.triangle, twins, previous_half_edge(h), q.d)) return false;
  const Vec3 &a = mesh.position[q.a], &b = mesh.position[q.b];
  const Vec3 &c = mesh.position[q.c], &d = mesh.position[q.d];
  const Vec3 abc = cross(b - a, c - a), bad = cross(a - b, d - b);
  const Vec3 adc = cross(d - a, c - a), dbc = cross(b - d, c - d);
  const uint32_t ad = next_half_edge(g), db = previous_half_edge(g), bc = next_half_edge(h),
                 ca = previous_half_edge(h);
  const auto beyond = [&](uint32_t edge, const Vec3& facing) {
    return turn_beyond(mesh, twins, edge, facing);
  };
  const double before = turn_between(abc, bad) + beyond(ad, bad) + beyond(db, bad) +
                        beyond(bc, abc) + beyond(ca, abc);
  const double after = turn_between(adc, dbc) + beyond(ad, adc) + beyond(ca, adc) +
                       beyond(db, dbc) + beyond(bc, dbc);
  if (!(after < 0.99 * before)) return false;
  flip(mesh.triangle, twins, h);
  return true;
}

// Flips the edge of a fold or one of the four round it: where a curve makes a hairpin the surface
// has to turn round its tip, and does so in steps if more edges end there.
static void flip_at_fold(const Movable& mesh, Span<uint32_t> twins, uint32_t h) {
  if (flip_to_turn_less(mesh, twins, h)) return;
  const uint32_t g = twins[h];
  const uint32_t round[4] = {next_half_edge(h), previous_half_edge(h), next_half_edge(g),
                             previous_half_edge(g)};
  for (uint32_t edge : round) {
    if (flip_to_turn_less(mesh, twins, edge)) return;
  }
}

// Marks the free vertices round the folds, and those `rings` further out in the same patch.
static Status mark_folds(Context& context, const Movable& mesh, Span<const uint32_t> twins,
                         Span<uint32_t> folds, uint32_t rings, Span<uint8_t> marked) {
  for (uint8_t& m : marked) m = 0;
  TRY(in_parts(context, twins.size(), [&](size_t h) {
    if (!is_fold(mesh, twins, static_cast<uint32_t>(h))) return;
    for (size_t k = 0; k < 3; ++k) marked[mesh.triangle[h / 3 * 3 + k]] = 1;
  }));
  for (uint32_t ring = 1; ring <= rings; ++ring) {
    TRY(in_parts(context, mesh.triangle.size(), [&](size_t h) {
      if (folds[mesh.patch[h / 3]] == 0 || marked[mesh.triangle[h]] != ring) return;
      for (size_t k = 0; k < 3; ++k) {
        uint8_t& m = marked[mesh.triangle[h / 3 * 3 + k]];
        if (m == 0) m = static_cast<uint8_t>(ring + 1);
      }
    }));
  }
  return {};
}

static Status smooth_marked(Context& context, const Movable& mesh, Span<const uint8_t> marked,
                            Span<Pull> pull) {
  TRY(in_parts(context, pull.size(), [&](size_t v) { pull[v] = {Vec3{}, 0.0}; }));
  TRY(in_parts(context, mesh.triangle.size(), [&](size_t h) {
    // A free vertex has a triangle on each side of its edges, so this meets each neighbour once.
    const uint32_t a = mesh.triangle[h];
    const uint32_t b = mesh.triangle[next_half_edge(static_cast<uint32_t>(h))];
    pull[a].sum += mesh.position[b];
    pull[a].area += 1.0;
  }));
  return in_parts(context, pull.size(), [&](size_t v) {
    if (!marked[v] || mesh.held[v]) return;
    const Vec3 mean = (1.0 / pull[v].area) * pull[v].sum;
    mesh.position[v] += 0.5 * (mean - mesh.position[v]);
  });
}

// The folds of each patch, and `all` of them.
static Status count_folds(Context& context, const Movable& mesh, Span<const uint32_t> twins,
                          Span<uint32_t> folds, uint32_t* all) {
  *all = 0;
  for (uint32_t& f : folds) f = 0;
  return in_parts(context, twins.size(), [&](size_t i) {
    const uint32_t h = static_cast<uint32_t>(i);
    if (twins[h] < h || !is_fold(mesh, twins, h)) return;
    ++folds[mesh.patch[h / 3]];
    ++*all;
  });
}

Status unfold(Context& context, const Movable& mesh, Span<uint32_t> folds) {
  Array<uint32_t> twins(context);
  Array<uint8_t> marked(context);
  Array<Pull> pull(context);
  TRY(find_twins(static_cast<uint32_t>(mesh.position.size()), mesh.triangle, &twins));
  uint32_t left = 0;
  TRY(count_folds(context, mesh, twins.span(), folds, &left));
  if (left == 0) return {};
  TRY(marked.resize(mesh.position.size()));
  TRY(pull.resize(mesh.position.size()));
  for (uint32_t sweep = 0; sweep < k_unfold_sweeps; ++sweep) {
    TRY(in_parts(context, twins.size(), [&](size_t i) {
      const uint32_t h = static_cast<uint32_t>(i);
      if (twins[h] > h && is_fold(mesh, twins.span(), h)) flip_at_fold(mesh, twins.span(), h);
    }));
    TRY(count_folds(context, mesh, twins.span(), folds, &left));
    if (left == 0) break;
    TRY(mark_folds(context, mesh, twins.span(), folds, sweep / k_sweeps_a_ring, marked.span()));
    TRY(smooth_marked(context, mesh, marked.span(), pull.span()));
    TRY(context.checkpoint());
  }
  return count_folds(context, mesh, twins.span(), folds, &left);
}

Status care(Context& context, const Movable& mesh, uint32_t* flips) {
  Array<uint32_t> twins(context);
  *flips = 0;
  TRY(relax(context, mesh));
  TRY(find_twins(static_cast<uint32_t>(mesh.position.size()), mesh.triangle, &twins));
  for (int sweep = 0; sweep < k_flip_sweeps; ++sweep) {
    const uint32_t before = *flips;
    TRY(in_parts(context, twins.size(), [&](size_t i) {
      const uint32_t h = static_cast<uint32_t>(i);
      if (!wants_flip(mesh, twins.span(), h)) return;
      flip(mesh.triangle, twins.span(), h);
      ++*flips;
    }));
    TRY(context.checkpoint());
    if (*flips == before) break;
  }
  return relax(context, mesh);
}

}  // namespace wireskin::mesh
