#include "mesh/loop_refine.h"

#include "base/in_parts.h"
#include "base/search.h"
#include "base/sort.h"
#include "mesh/curvature.h"
#include "num/minmax.h"

namespace wireskin::mesh {

static constexpr double k_grading = 0.25;
static constexpr size_t k_steps_of_edge = 2;  // and of a star
// Edges above the first share of the wished size are split, unless the midpoint would come nearer
// than the second share to an opposite vertex.
static constexpr double k_long_edge = 1.35;
static constexpr double k_close = 0.6;
// Each level splits the edges above this share of the level before.
static constexpr double k_level = 0.7;
static constexpr int k_most_passes = 6;
static constexpr int k_relaxing_sweeps_of_level = 2;
static constexpr int k_last_relaxing_sweeps = 4;
static constexpr int k_umbrella_sweeps = 2;

namespace {

struct LoopRefinement {
  Span<const uint32_t> start;
  uint32_t rim;               // vertices that are held
  Span<const uint32_t> edge;  // held edges inside, see HeldCurves
  double spacing;
  size_t most_points = 0;
  Array<Vec3>* position;
  Array<uint32_t>* triangle;
  Array<double> size;  // wished, of each point
  Array<uint32_t> twins;
  Array<uint32_t> suspect;    // half-edges that may have to be flipped
  Span<const uint32_t> name;  // of the held points; empty: all are different
  Array<uint8_t> copied;      // of the held points: another has the same name
  bool may_relax = true;
  Pace pace;  // edges and stars that are looked at

  LoopRefinement(Context& context, Span<const uint32_t> loops, double wished, Array<Vec3>* points,
                 Array<uint32_t>* triangles)
      : start(loops),
        rim(loops[loops.size() - 1]),
        spacing(wished),
        position(points),
        triangle(triangles),
        size(context),
        twins(context),
        suspect(context),
        copied(context),
        pace(context) {}

  uint32_t origin(uint32_t h) const { return (*triangle)[h]; }
  uint32_t head(uint32_t h) const { return (*triangle)[next_half_edge(h)]; }
  uint32_t apex(uint32_t h) const { return (*triangle)[previous_half_edge(h)]; }
  const Vec3& at(uint32_t v) const { return (*position)[v]; }
  bool same(uint32_t u, uint32_t v) const {
    return u == v || (u < name.size() && v < name.size() && name[u] == name[v]);
  }
};

// The two triangles at a half-edge from a to b; c and d are opposite to it.
struct Diamond {
  uint32_t a, b, c, d;
};

// The triangles round each point, for relaxation.
struct Stars {
  Array<uint32_t> start, corner;
  Array<Vec3> normal;

  explicit Stars(Context& context) : start(context), corner(context), normal(context) {}
};

}  // namespace

static bool is_held(const LoopRefinement& r, uint32_t u, uint32_t v) {
  if (u >= r.rim || v >= r.rim || r.edge.empty()) return false;
  const uint32_t a = u < v ? u : v, b = u < v ? v : u;
  const size_t i = first_failing(size_t{0}, r.edge.size() / 2, [&](size_t k) {
    const uint32_t* e = &r.edge[2 * k];
    return e[0] < a || (e[0] == a && e[1] < b);
  });
  return 2 * i < r.edge.size() && r.edge[2 * i] == a && r.edge[2 * i + 1] == b;
}

static Diamond diamond_at(const LoopRefinement& r, uint32_t h) {
  const uint32_t g = r.twins[h];
  return {r.origin(h), r.origin(g), r.apex(h), r.apex(g)};
}

// The cotangent of a triangle's least angle; beyond all others without area. The same bits
// whichever corner comes first, or rounding could make two needles take turns for ever.
static double greatest_cotangent(const LoopRefinement& r, uint32_t i, uint32_t j, uint32_t k) {
  while (i > j || i > k) {
    const uint32_t first = i;
    i = j;
    j = k;
    k = first;
  }
  const Vec3 &a = r.at(i), &b = r.at(j), &c = r.at(k);
  const double at_a = dot(b - a, c - a), at_b = dot(c - b, a - b), at_c = dot(a - c, b - c);
  const double twice_area = length(cross(b - a, c - a));
  return twice_area > 0.0 ? larger(at_a, larger(at_b, at_c)) / twice_area : DBL_MAX;
}

// Walks round the origin of a half-edge, both ways because the rim may end the walk.
struct StarWalk {
  uint32_t first, at;
  bool backward, done;
};

// Whether the triangle that the walk is at has a corner of the same name; then goes to the next.
static bool meets_and_steps(const LoopRefinement& r, uint32_t name, StarWalk* walk) {
  if (r.same(r.head(walk->at), name) || r.same(r.apex(walk->at), name)) return true;
  if (!walk->backward) {
    walk->at = r.twins[previous_half_edge(walk->at)];
    walk->done = walk->at == walk->first;
    if (walk->at != k_none || walk->done) return false;
    walk->backward = true;
    walk->at = walk->first;
  }
  const uint32_t across = r.twins[walk->at];
  walk->done = across == k_none;
  if (!walk->done) walk->at = next_half_edge(across);
  return false;
}

static bool is_copied(const LoopRefinement& r, uint32_t v) {
  return v < r.copied.size() && r.copied[v] != 0;
}

// Whether an edge joins the origins of two half-edges, or places of the same names. The stars are
// walked round by turns, for one of them may have thousands of triangles.
static bool joined(const LoopRefinement& r, uint32_t from, uint32_t to) {
  const uint32_t a = r.origin(from), b = r.origin(to);
  StarWalk near = {from, from, false, false}, far = {to, to, false, false};
  // Seen from a copy the other one may be joined to another copy.
  const bool both = !is_copied(r, a) && !is_copied(r, b);
  while (!near.done && !(both && far.done)) {
    if (meets_and_steps(r, b, &near)) return true;
    if (both && meets_and_steps(r, a, &far)) return true;
  }
  return false;
}

static bool improves_by_flip(const LoopRefinement& r, uint32_t h) {
  constexpr double k_gain = 1e-9, k_least_facing = 0.5;
  if (r.twins[h] == k_none) return false;
  const Diamond q = diamond_at(r, h);
  if (is_held(r, q.a, q.b)) return false;
  const double before =
      larger(greatest_cotangent(r, q.a, q.b, q.c), greatest_cotangent(r, q.b, q.a, q.d));
  const double after =
      larger(greatest_cotangent(r, q.a, q.d, q.c), greatest_cotangent(r, q.d, q.b, q.c));
  if (!(after < before - k_gain * (1.0 + std::fabs(after)))) return false;
  const Vec3 &a = r.at(q.a), &b = r.at(q.b), &c = r.at(q.c), &d = r.at(q.d);
  // Across a sharp edge a flip would change the surface, or turn a triangle over. Needles have no
  // say in what the direction is.
  const Vec3 facing = unit(cross(b - a, c - a) + cross(a - b, d - b));
  if (!(dot(unit(cross(d - a, c - a)), facing) > k_least_facing)) return false;
  if (!(dot(unit(cross(b - d, c - d)), facing) > k_least_facing)) return false;
  return !joined(r, previous_half_edge(h), previous_half_edge(r.twins[h]));
}

static void set_twins(LoopRefinement* r, uint32_t h, uint32_t g) {
  r->twins[h] = g;
  if (g != k_none) r->twins[g] = h;
}

// Triangles a b c and b a d become d c a and c d b.
static Status flip_diamond(LoopRefinement* r, uint32_t h) {
  const uint32_t g = r->twins[h];
  const Diamond q = diamond_at(*r, h);
  const uint32_t t = h / 3 * 3, s = g / 3 * 3;
  const uint32_t bc = r->twins[next_half_edge(h)], ca = r->twins[previous_half_edge(h)];
  const uint32_t ad = r->twins[next_half_edge(g)], db = r->twins[previous_half_edge(g)];
  const uint32_t corner[2][3] = {{q.d, q.c, q.a}, {q.c, q.d, q.b}};
  for (uint32_t k = 0; k < 3; ++k) {
    (*r->triangle)[t + k] = corner[0][k];
    (*r->triangle)[s + k] = corner[1][k];
  }
  set_twins(r, t, s);
  set_twins(r, t + 1, ca);
  set_twins(r, t + 2, ad);
  set_twins(r, s + 1, db);
  set_twins(r, s + 2, bc);
  TRY(r->suspect.push(t + 1));
  TRY(r->suspect.push(t + 2));
  TRY(r->suspect.push(s + 1));
  return r->suspect.push(s + 2);
}

// Cut short where more edges than there are would flip: no sound mesh comes near that.
static Status flip_suspects(LoopRefinement* r) {
  size_t flips_left = r->twins.size();
  while (!r->suspect.empty()) {
    const uint32_t h = r->suspect.back();
    r->suspect.pop();
    TRY(r->pace.after(k_steps_of_edge));
    if (flips_left == 0 || !improves_by_flip(*r, h)) continue;
    TRY(flip_diamond(r, h));
    --flips_left;
  }
  return {};
}

static Status flip_everywhere(LoopRefinement* r) {
  for (uint32_t h = 0; h < r->twins.size(); ++h) {
    if (r->twins[h] == k_none || r->twins[h] < h) continue;
    TRY(r->suspect.push(h));
    TRY(flip_suspects(r));
  }
  return {};
}

// The spacing, as far as the grading from both ends of an edge to its midpoint allows.
static double size_between(const LoopRefinement& r, uint32_t a, uint32_t b) {
  const double reach = k_grading * 0.5 * length(r.at(b) - r.at(a));
  const double least = larger(r.size[a], r.size[b]) - reach;
  const double most = smaller(r.size[a], r.size[b]) + reach;
  if (least > most) return 0.5 * (r.size[a] + r.size[b]);
  return smaller(larger(r.spacing, least), most);
}

// The length over the wished size of an edge that may be split, 0 of others.
static double excess(const LoopRefinement& r, uint32_t h) {
  if (r.twins[h] == k_none) return 0.0;
  const Diamond q = diamond_at(r, h);
  if (r.same(q.c, q.d) || is_held(r, q.a, q.b)) return 0.0;
  const Vec3 middle = 0.5 * (r.at(q.a) + r.at(q.b));
  const double size = size_between(r, q.a, q.b);
  if (length(r.at(q.c) - middle) < k_close * size) return 0.0;
  if (length(r.at(q.d) - middle) < k_close * size) return 0.0;
  return length(r.at(q.b) - r.at(q.a)) / size;
}

// Triangles a b c and b a d become a m c, m b c, b m d and m a d.
static Status split_diamond(LoopRefinement* r, uint32_t h) {
  const uint32_t g = r->twins[h];
  const Diamond q = diamond_at(*r, h);
  const uint32_t m = static_cast<uint32_t>(r->position->size());
  const uint32_t t = static_cast<uint32_t>(r->triangle->size()), s = t + 3;
  const uint32_t bc = next_half_edge(h), ad = next_half_edge(g);
  const uint32_t outer_bc = r->twins[bc], outer_ad = r->twins[ad];
  const uint32_t corner[6] = {m, q.b, q.c, m, q.a, q.d};
  const double size = size_between(*r, q.a, q.b);
  const Vec3 middle = 0.5 * (r->at(q.a) + r->at(q.b));
  TRY(r->size.push(size));
  TRY(r->position->push(middle));
  for (uint32_t v : corner) {
    TRY(r->triangle->push(v));
    TRY(r->twins.push(k_none));
  }
  (*r->triangle)[bc] = m;
  (*r->triangle)[ad] = m;
  set_twins(r, h, s);
  set_twins(r, g, t);
  set_twins(r, bc, t + 2);
  set_twins(r, ad, s + 2);
  set_twins(r, t + 1, outer_bc);
  set_twins(r, s + 1, outer_ad);
  TRY(r->suspect.push(previous_half_edge(h)));
  TRY(r->suspect.push(t + 1));
  TRY(r->suspect.push(previous_half_edge(g)));
  return r->suspect.push(s + 1);
}

static Status split_longer(LoopRefinement* r, double level, size_t* splits) {
  *splits = 0;
  for (uint32_t h = 0; h < r->twins.size(); ++h) {
    if (r->position->size() >= r->most_points) break;
    TRY(r->pace.after(k_steps_of_edge));
    if (!(excess(*r, h) > level)) continue;
    TRY(split_diamond(r, h));
    TRY(flip_suspects(r));
    ++*splits;
  }
  return {};
}

// No triangle round v may turn over when v moves to `target`.
static bool may_move(const LoopRefinement& r, Span<const uint32_t> star, const Vec3& target) {
  for (uint32_t h : star) {
    const Vec3 &v = r.at(r.origin(h)), &p = r.at(r.head(h)), &q = r.at(r.apex(h));
    if (!(dot(cross(p - v, q - v), cross(p - target, q - target)) > 0.0)) return false;
  }
  return true;
}

// The area-weighted mean of the centroids of a star.
static Vec3 centre_of(const LoopRefinement& r, Span<const uint32_t> star) {
  Vec3 sum;
  double areas = 0.0;
  for (uint32_t h : star) {
    const Vec3 &v = r.at(r.origin(h)), &p = r.at(r.head(h)), &q = r.at(r.apex(h));
    const double area = length(cross(p - v, q - v));
    sum += area * ((1.0 / 3.0) * (v + p + q));
    areas += area;
  }
  return areas > 0.0 ? (1.0 / areas) * sum : r.at(r.origin(star[0]));
}

// One sweep over the inner points in their order; within the tangent planes, or freely.
static Status relax_inner(LoopRefinement* r, bool within_plane, Stars* stars) {
  const uint32_t n = static_cast<uint32_t>(r->position->size());
  TRY(find_corners(n, r->triangle->span(), &stars->start, &stars->corner));
  TRY(stars->normal.resize(n));
  TRY(vertex_normals(r->suspect.context(), r->position->span(), r->triangle->span(),
                     stars->normal.span()));
  for (uint32_t v = r->rim; v < n; ++v) {
    const uint32_t first = stars->start[v];
    const Span<const uint32_t> star = stars->corner.span().part(first, stars->start[v + 1] - first);
    const Vec3 step = centre_of(*r, star) - r->at(v);
    const Vec3 target = r->at(v) + (within_plane ? reject(step, stars->normal[v]) : step);
    if (may_move(*r, star, target)) (*r->position)[v] = target;
    TRY(r->pace.after(k_steps_of_edge));
  }
  return {};
}

// Sizes were made from the two ends of an edge only; here every neighbour has its say.
static Status grade_sizes(LoopRefinement* r, const Stars& stars) {
  for (uint32_t v = r->rim; v < r->size.size(); ++v) {
    double least = 0.0, most = DBL_MAX;
    for (uint32_t k = stars.start[v]; k < stars.start[v + 1]; ++k) {
      const uint32_t u = r->head(stars.corner[k]);
      const double reach = k_grading * length(r->at(u) - r->at(v));
      least = larger(least, r->size[u] - reach);
      most = smaller(most, r->size[u] + reach);
    }
    r->size[v] = least > most ? 0.5 * (least + most) : smaller(larger(r->spacing, least), most);
    TRY(r->pace.after(k_steps_of_edge));
  }
  return {};
}

static Status relax_and_flip(LoopRefinement* r, int tangential, int free, Stars* stars) {
  if (!r->may_relax) tangential = free = 0;
  for (int sweep = 0; sweep < tangential; ++sweep) TRY(relax_inner(r, true, stars));
  for (int sweep = 0; sweep < free; ++sweep) TRY(relax_inner(r, false, stars));
  if (r->may_relax) TRY(grade_sizes(r, *stars));
  return flip_everywhere(r);
}

// Along the rim, twice round in each direction so that the start does not show.
static void grade_rim(LoopRefinement* r, uint32_t first, uint32_t n) {
  for (uint32_t i = 0; i < 4 * n; ++i) {
    const uint32_t v = first + (i < 2 * n ? i % n : n - 1 - i % n);
    const uint32_t before = first + (i < 2 * n ? (v - first + n - 1) % n : (v - first + 1) % n);
    const double reach = k_grading * length(r->at(v) - r->at(before));
    r->size[v] = smaller(r->size[v], r->size[before] + reach);
  }
}

static Status limit_points(LoopRefinement* r) {
  double area = 0.0;
  for (uint32_t h = 0; h < r->triangle->size(); h += 3) {
    area += 0.5 * length(cross(r->at(r->head(h)) - r->at(r->origin(h)),
                               r->at(r->apex(h)) - r->at(r->origin(h))));
  }
  // Regular triangles have 0.87 square sizes a point; a fine rim adds layers of its own.
  const double points = area / (r->spacing * r->spacing);
  if (!(points + r->rim < 5e7)) {
    return fail(Code::too_large, "the spacing is too small for the size of the patch");
  }
  // Without relaxation the needles at a rim of very unequal edges are split on and on.
  const double layers = r->may_relax ? 24.0 : 2.0;
  r->most_points = static_cast<size_t>(4.0 * points + layers * r->rim + 1024.0);
  return {};
}

// Held points inside wish the mean of their curves' edges, those without any the spacing.
static Status wish_sizes_of_curves(LoopRefinement* r) {
  const uint32_t first = r->start[r->start.size() - 1];
  Array<uint32_t> edges(r->suspect.context());
  TRY(edges.assign(r->rim, 0));
  for (size_t i = 0; i < r->edge.size(); ++i) {
    const uint32_t v = r->edge[i], other = r->edge[i ^ 1];
    if (v < first) continue;
    r->size[v] += length(r->at(other) - r->at(v));
    ++edges[v];
  }
  for (uint32_t v = first; v < r->rim; ++v) {
    r->size[v] = edges[v] > 0 ? r->size[v] / edges[v] : r->spacing;
  }
  return limit_points(r);
}

static Status wish_sizes(LoopRefinement* r) {
  TRY(r->size.assign(r->position->size(), r->spacing));
  for (uint32_t v = 0; v < r->rim; ++v) r->size[v] = 0.0;
  for (size_t l = 0; l + 1 < r->start.size(); ++l) {
    for (uint32_t v = r->start[l]; v < r->start[l + 1]; ++v) {
      const uint32_t next = v + 1 < r->start[l + 1] ? v + 1 : r->start[l];
      const double edge = length(r->at(next) - r->at(v));
      r->size[v] += 0.5 * edge;
      r->size[next] += 0.5 * edge;
    }
    grade_rim(r, r->start[l], r->start[l + 1] - r->start[l]);
  }
  return wish_sizes_of_curves(r);
}

// Held points on the border wish the mean of the border's edges there, others the spacing.
static Status wish_sizes_of_patch(LoopRefinement* r) {
  TRY(r->size.assign(r->rim, 0.0));
  for (uint32_t h = 0; h < r->twins.size(); ++h) {
    if (r->twins[h] != k_none) continue;
    const double edge = length(r->at(r->head(h)) - r->at(r->origin(h)));
    r->size[r->origin(h)] += 0.5 * edge;
    r->size[r->head(h)] += 0.5 * edge;
  }
  for (double& size : r->size) {
    if (size == 0.0) size = r->spacing;
  }
  return limit_points(r);
}

static Status refine_all(LoopRefinement* r) {
  Stars stars(r->suspect.context());
  TRY(flip_everywhere(r));
  double level = 0.0;
  for (uint32_t h = 0; h < r->twins.size(); ++h) {
    TRY(r->pace.after(k_steps_of_edge));
    level = larger(level, excess(*r, h));
  }
  size_t splits = 0;
  while (level * k_level > k_long_edge) {
    level *= k_level;
    TRY(split_longer(r, level, &splits));
    TRY(relax_and_flip(r, k_relaxing_sweeps_of_level, 0, &stars));
  }
  for (int pass = 0; pass < k_most_passes; ++pass) {
    TRY(split_longer(r, k_long_edge, &splits));
    if (splits == 0) break;
    TRY(relax_and_flip(r, k_relaxing_sweeps_of_level, 0, &stars));
  }
  TRY(relax_and_flip(r, k_last_relaxing_sweeps, 0, &stars));
  TRY(relax_and_flip(r, 0, k_umbrella_sweeps, &stars));
  return relax_and_flip(r, k_last_relaxing_sweeps, 0, &stars);
}

Status refine_loops(Context& context, double spacing, Span<const uint32_t> start,
                    const HeldCurves& held, Array<Vec3>* position, Array<uint32_t>* triangle) {
  LoopRefinement r(context, start, spacing, position, triangle);
  WIRESKIN_ASSERT(held.vertices >= r.rim);
  r.rim = held.vertices;
  r.edge = held.edge;
  TRY(find_twins(static_cast<uint32_t>(position->size()), triangle->span(), &r.twins));
  TRY(wish_sizes(&r));
  return refine_all(&r);
}

Status refine_loops(Context& context, double spacing, Span<const uint32_t> start,
                    Array<Vec3>* position, Array<uint32_t>* triangle) {
  return refine_loops(context, spacing, start, {start[start.size() - 1], {}}, position, triangle);
}

static Status find_copies(Span<const uint32_t> name, Array<uint8_t>* copied) {
  Array<uint32_t> order(copied->context());
  TRY(order.resize(name.size()));
  TRY(copied->assign(name.size(), 0));
  for (uint32_t v = 0; v < order.size(); ++v) order[v] = v;
  sort(order.span(),
       [&](uint32_t u, uint32_t v) { return name[u] != name[v] ? name[u] < name[v] : u < v; });
  for (size_t i = 1; i < order.size(); ++i) {
    if (name[order[i]] == name[order[i - 1]]) {
      (*copied)[order[i]] = (*copied)[order[i - 1]] = 1;
    }
  }
  return {};
}

Status refine_patch(Context& context, double spacing, bool relax, Span<const uint32_t> name,
                    Array<Vec3>* position, Array<uint32_t>* triangle) {
  const uint32_t held = static_cast<uint32_t>(position->size());
  const uint32_t all_held[2] = {0, held};
  LoopRefinement r(context, {all_held, 2}, spacing, position, triangle);
  r.name = name;
  r.may_relax = relax;
  TRY(find_copies(name, &r.copied));
  TRY(find_twins(held, triangle->span(), &r.twins));
  TRY(wish_sizes_of_patch(&r));
  return refine_all(&r);
}

}  // namespace wireskin::mesh
