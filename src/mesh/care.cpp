#include "mesh/care.h"

#include "mesh/curvature.h"

namespace wireskin::mesh {

static constexpr int k_relax_sweeps = 5;
static constexpr int k_flip_sweeps = 6;

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

static void relax_once(const Movable& mesh, Span<Vec3> normal, Span<Pull> pull) {
  vertex_normals(mesh.position, mesh.triangle, normal);
  for (Pull& p : pull) p = {Vec3{}, 0.0};
  for (size_t t = 0; t < mesh.triangle.size(); t += 3) {
    const uint32_t* v = &mesh.triangle[t];
    const Vec3 &a = mesh.position[v[0]], &b = mesh.position[v[1]], &c = mesh.position[v[2]];
    const double area = length(cross(b - a, c - a));
    const Vec3 weighted = area * ((1.0 / 3.0) * (a + b + c));
    for (int k = 0; k < 3; ++k) {
      pull[v[k]].sum += weighted;
      pull[v[k]].area += area;
    }
  }
  for (size_t v = 0; v < pull.size(); ++v) {
    if (mesh.held[v] || !(pull[v].area > 0.0)) continue;
    const Vec3 step = (1.0 / pull[v].area) * pull[v].sum - mesh.position[v];
    mesh.position[v] += 0.5 * reject(step, normal[v]);
  }
}

static Status relax(Context& context, const Movable& mesh) {
  Array<Vec3> normal(context);
  Array<Pull> pull(context);
  TRY(normal.resize(mesh.position.size()));
  TRY(pull.resize(mesh.position.size()));
  for (int sweep = 0; sweep < k_relax_sweeps; ++sweep) {
    relax_once(mesh, normal.span(), pull.span());
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

Status care(Context& context, const Movable& mesh, uint32_t* flips) {
  Array<uint32_t> twins(context);
  *flips = 0;
  TRY(relax(context, mesh));
  TRY(find_twins(static_cast<uint32_t>(mesh.position.size()), mesh.triangle, &twins));
  for (int sweep = 0; sweep < k_flip_sweeps; ++sweep) {
    const uint32_t before = *flips;
    for (uint32_t h = 0; h < twins.size(); ++h) {
      if (!wants_flip(mesh, twins.span(), h)) continue;
      flip(mesh.triangle, twins.span(), h);
      ++*flips;
    }
    TRY(context.checkpoint());
    if (*flips == before) break;
  }
  return relax(context, mesh);
}

}  // namespace wireskin::mesh
