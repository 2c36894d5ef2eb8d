#include "mesh/loop_mesh.h"

#include "base/search.h"
#include "base/sort.h"
#include "mesh/loop_refine.h"
#include "mesh/mesh.h"
#include "num/minmax.h"

namespace wireskin::mesh {

static constexpr uint32_t k_most_kept = 150;
// Loops in a plane have the same area however they are cut: short edges decide there, so that
// rounding does not.
static constexpr double k_weight_of_edges = 1e-4;
// How much triangles count that face away from their normals. Two discs in the ends of a tube have
// less area than the tube, so with several loops it must be more.
static constexpr double k_weight_of_normals = 2.0;
static constexpr double k_weight_of_normals_of_tubes = 8.0;
// Areas below this share of the squared perimeter, and angles of about this size, are none.
static constexpr double k_no_area = 1e-10;
// More than any triangles with area can cost together, the extent being about one.
static constexpr double k_weight_of_needle = 1e6;

namespace {

// The polygon of the dynamic programme: the vertices of the loops that take part, one loop after
// the other along the bridges; at the ends of a bridge a vertex occurs twice.
struct Kept {
  const Loops& loops;
  Array<uint32_t> vertex;

  Kept(Context& context, const Loops& of) : loops(of), vertex(context) {}
};

// The best triangulation between each two kept vertices i < j, at i * n + j.
struct Best {
  Array<double> weight;
  Array<uint32_t> apex;

  explicit Best(Context& context) : weight(context), apex(context) {}
};

struct ChordOfLoop {
  uint32_t from, to;
};

}  // namespace

static double perimeter_of(const Loops& loops) {
  double sum = 0.0;
  for (uint32_t l = 0; l < loops.count(); ++l) {
    for (uint32_t v = loops.start[l]; v < loops.start[l + 1]; ++v) {
      sum += length(loops.position[loops.next(l, v)] - loops.position[v]);
    }
  }
  return sum;
}

static Status check_loops(const Loops& loops, double spacing) {
  if (!(spacing > 0.0) || spacing > DBL_MAX) {
    return fail(Code::bad_argument, "the spacing is not a positive number");
  }
  for (uint32_t l = 0; l < loops.count(); ++l) {
    if (loops.start[l + 1] - loops.start[l] < 3) {
      return fail(Code::patch_folded, "the border has fewer than three points");
    }
    for (uint32_t v = loops.start[l]; v < loops.start[l + 1]; ++v) {
      // False for coordinates that are not numbers, too.
      if (!(length(loops.position[loops.next(l, v)] - loops.position[v]) > 0.0)) {
        return fail(Code::patch_folded, "two neighbours on the border coincide");
      }
    }
  }
  return {};
}

// How far the tangent turns at vertex v, 0 to 2.
static double turn_at(const Loops& loops, uint32_t loop, uint32_t v) {
  const Vec3 out = loops.position[loops.next(loop, v)] - loops.position[v];
  const Vec3 in = loops.position[v] - loops.position[loops.previous(loop, v)];
  return length(unit(out) - unit(in));
}

// All vertices, or of a long loop `most` that share its shape evenly: a vertex stands for its edge,
// its turn and itself, each measured against their sum over the loop, and one is kept wherever the
// running total passes a multiple of its most-th part.
static Status keep_vertices(const Loops& loops, uint32_t loop, uint32_t most,
                            Array<uint32_t>* kept) {
  const uint32_t first = loops.start[loop], end = loops.start[loop + 1], n = end - first;
  kept->clear();
  TRY(kept->reserve(n < most ? n : most));
  if (n <= most) {
    for (uint32_t v = first; v < end; ++v) kept->push_reserved(v);
    return {};
  }
  double turning = DBL_MIN, perimeter = 0.0, sum = 0.0;
  for (uint32_t v = first; v < end; ++v) {
    turning += turn_at(loops, loop, v);
    perimeter += length(loops.position[loops.next(loop, v)] - loops.position[v]);
  }
  uint32_t passed = 0;
  for (uint32_t v = first; v < end && passed < most; ++v) {
    sum += length(loops.position[loops.next(loop, v)] - loops.position[v]) / perimeter +
           turn_at(loops, loop, v) / turning + 1.0 / static_cast<double>(n);
    const uint32_t now = static_cast<uint32_t>(most * (sum / 3.0));
    if (now > passed) kept->push_reserved(v);
    passed = now;
  }
  // One edge or turn may swallow many parts, but the vertices' own third remains.
  WIRESKIN_ASSERT(kept->size() >= 3);
  return {};
}

// The share of the k_most_kept vertices that a loop gets.
static uint32_t most_kept(const Loops& loops, uint32_t loop) {
  constexpr double k_least = 12.0;
  const double n = loops.start[loop + 1] - loops.start[loop];
  const double all = loops.start[loops.count()];
  return loops.count() == 1 ? k_most_kept
                            : static_cast<uint32_t>(larger(k_least, k_most_kept * (n / all)));
}

// Into the patch, along the surface; zero where the normal is not known.
static Vec3 conormal_at(const Loops& loops, uint32_t loop, uint32_t v) {
  const Vec3 along = loops.position[loops.next(loop, v)] - loops.position[loops.previous(loop, v)];
  return unit(cross(loops.normal[v], along));
}

namespace {

// A bridge from place `from` of the polygon to place `to` of a list of kept vertices.
struct Bridge {
  uint32_t from = 0, to = 0;
  double cost = DBL_MAX;
};

}  // namespace

static uint32_t loop_of(const Loops& loops, uint32_t v) {
  return last_holding(uint32_t{0}, loops.count(), [&](uint32_t k) { return loops.start[k] <= v; });
}

static Bridge find_bridge(const Loops& loops, Span<const uint32_t> polygon,
                          Span<const uint32_t> list) {
  constexpr double k_astray = 2.0;  // how much longer ways count that the conormals oppose
  Bridge best;
  for (uint32_t i = 0; i < polygon.size(); ++i) {
    const uint32_t a = polygon[i];
    const Vec3 from = conormal_at(loops, loop_of(loops, a), a);
    for (uint32_t k = 0; k < list.size(); ++k) {
      const uint32_t b = list[k];
      const Vec3 way = loops.position[b] - loops.position[a];
      const Vec3 to = conormal_at(loops, loop_of(loops, b), b);
      const double cost = (1.0 + k_astray) * length(way) - 0.5 * k_astray * dot(way, from - to);
      if (cost < best.cost) best = {i, k, cost};
    }
  }
  return best;
}

// Joins all loops to one polygon: the way goes over a bridge, round the other loop and back.
static Status join_loops(Kept* kept) {
  const Loops& loops = kept->loops;
  Context& context = kept->vertex.context();
  Array<uint32_t> list(context), joined(context);
  Array<uint8_t> done(context);
  TRY(done.assign(loops.count(), 0));
  TRY(keep_vertices(loops, 0, most_kept(loops, 0), &kept->vertex));
  done[0] = 1;
  for (uint32_t round = 1; round < loops.count(); ++round) {
    Bridge best;
    uint32_t nearest = k_none;
    for (uint32_t l = 1; l < loops.count(); ++l) {
      if (done[l]) continue;
      TRY(keep_vertices(loops, l, most_kept(loops, l), &list));
      const Bridge bridge = find_bridge(loops, kept->vertex.span(), list.span());
      if (nearest != k_none && !(bridge.cost < best.cost)) continue;
      best = bridge;
      nearest = l;
    }
    done[nearest] = 1;
    TRY(keep_vertices(loops, nearest, most_kept(loops, nearest), &list));
    joined.clear();
    for (uint32_t i = 0; i <= best.from; ++i) TRY(joined.push(kept->vertex[i]));
    for (size_t k = 0; k <= list.size(); ++k) {
      TRY(joined.push(list[(best.to + k) % list.size()]));
    }
    for (size_t i = best.from; i < kept->vertex.size(); ++i) TRY(joined.push(kept->vertex[i]));
    TRY(kept->vertex.copy(joined.span()));
    TRY(context.checkpoint());
  }
  return {};
}

static double triangle_weight(const Kept& kept, uint32_t i, uint32_t j, uint32_t k) {
  const uint32_t u = kept.vertex[i], v = kept.vertex[j], w = kept.vertex[k];
  if (u == v || v == w || w == u) return 1e30;  // both copies of a bridge's end
  const Span<const Vec3> position = kept.loops.position, normal = kept.loops.normal;
  const Vec3 a = position[v] - position[u], b = position[w] - position[u];
  const Vec3 across = cross(a, b), c = b - a;
  // Three places of a straight side make a triangle of no area only where there is no other way.
  const double squares = dot(a, a) + dot(b, b) + dot(c, c);
  if (!(length(across) > k_no_area * squares)) return k_weight_of_needle;
  const Vec3 facing = unit(normal[u] + normal[v] + normal[w]);
  // |across| / 2 is the area, so this is area * (1 + k (1 - cos)) without a division.
  const double weight =
      kept.loops.count() == 1 ? k_weight_of_normals : k_weight_of_normals_of_tubes;
  return 0.5 * ((1.0 + weight) * length(across) - weight * dot(across, facing)) +
         k_weight_of_edges * squares;
}

static Status find_best(Context& context, const Kept& kept, Best* best) {
  const uint32_t n = static_cast<uint32_t>(kept.vertex.size());
  TRY(best->weight.assign(size_t{n} * n, 0.0));
  TRY(best->apex.assign(size_t{n} * n, 0));
  for (uint32_t span = 2; span < n; ++span) {
    for (uint32_t i = 0; i + span < n; ++i) {
      const uint32_t j = i + span;
      double least = DBL_MAX;
      uint32_t apex = i + 1;
      for (uint32_t k = i + 1; k < j; ++k) {
        const double weight = best->weight[size_t{i} * n + k] + best->weight[size_t{k} * n + j] +
                              triangle_weight(kept, i, k, j);
        if (!(weight < least)) continue;  // of equal ones the first
        least = weight;
        apex = k;
      }
      best->weight[size_t{i} * n + j] = least;
      best->apex[size_t{i} * n + j] = apex;
    }
    TRY(context.checkpoint());
  }
  return {};
}

// Follows the apexes down from the chord between the first and the last place of the polygon. The
// triangles are over places, not yet vertices.
static Status list_best(Context& context, const Kept& kept, Array<uint32_t>* triangle) {
  const uint32_t n = static_cast<uint32_t>(kept.vertex.size());
  Best best(context);
  Array<ChordOfLoop> open(context);
  TRY(find_best(context, kept, &best));
  TRY(open.push({0, n - 1}));
  while (!open.empty()) {
    const ChordOfLoop chord = open.back();
    open.pop();
    if (chord.to - chord.from < 2) continue;
    const uint32_t apex = best.apex[size_t{chord.from} * n + chord.to];
    TRY(triangle->push(chord.from));
    TRY(triangle->push(apex));
    TRY(triangle->push(chord.to));
    TRY(open.push({apex, chord.to}));
    TRY(open.push({chord.from, apex}));
  }
  return {};
}

namespace {

// An edge of the polygon's triangulation: the vertices, a < b, that its places stand for.
struct PlacedEdge {
  uint32_t a, b;
  uint32_t place_a, place_b;
  bool chord;  // not on a loop nor a bridge
};

}  // namespace

// Two chords may join the same vertices, going round a loop on either side, or stand beside a
// loop's edge. One is split at its middle, a new inner point whose place comes behind all others.
static Status split_chord_of_loop(const PlacedEdge& edge, const Kept& kept, Array<Vec3>* inner,
                                  Array<uint32_t>* triangle) {
  const uint32_t middle = static_cast<uint32_t>(kept.vertex.size() + inner->size());
  TRY(inner->push(0.5 * (kept.loops.position[edge.a] + kept.loops.position[edge.b])));
  const size_t end = triangle->size();
  for (uint32_t h = 0; h < end; ++h) {
    const uint32_t next = next_half_edge(h), previous = previous_half_edge(h);
    const uint32_t p = (*triangle)[h], q = (*triangle)[next];
    const bool here =
        (p == edge.place_a && q == edge.place_b) || (p == edge.place_b && q == edge.place_a);
    if (!here) continue;
    (*triangle)[next] = middle;
    const uint32_t apex = (*triangle)[previous];
    TRY(triangle->push(middle));
    TRY(triangle->push(q));
    TRY(triangle->push(apex));
  }
  return {};
}

// Lets no two edges join the same vertices, then turns places into vertices: those of the loops,
// then inner points.
static Status place_vertices(const Kept& kept, Array<Vec3>* inner, Array<uint32_t>* triangle) {
  Context& context = inner->context();
  const uint32_t places = static_cast<uint32_t>(kept.vertex.size());
  const uint32_t rim = kept.loops.start[kept.loops.count()];
  Array<PlacedEdge> edges(context);
  for (uint32_t h = 0; kept.loops.count() > 1 && h < triangle->size(); ++h) {
    const uint32_t p = (*triangle)[h], q = (*triangle)[next_half_edge(h)];
    const bool side = (p + 1) % places == q;  // of the polygon, met in this direction only
    if (!side && p > q) continue;
    const uint32_t u = kept.vertex[p], v = kept.vertex[q];
    // Bridges are sides twice; the one from the first place counts.
    const bool bridge = side && loop_of(kept.loops, u) != loop_of(kept.loops, v);
    if (bridge && u > v) continue;
    TRY(edges.push(u < v ? PlacedEdge{u, v, p, q, !side} : PlacedEdge{v, u, q, p, !side}));
  }
  sort(edges.span(), [](const PlacedEdge& x, const PlacedEdge& y) {
    if (x.a != y.a) return x.a < y.a;
    if (x.b != y.b) return x.b < y.b;
    return x.place_a != y.place_a ? x.place_a < y.place_a : x.place_b < y.place_b;
  });
  for (size_t i = 0; i < edges.size(); ++i) {
    const auto same = [&](size_t k) {
      return k < edges.size() && edges[k].a == edges[i].a && edges[k].b == edges[i].b;
    };
    if (!edges[i].chord || !(same(i + 1) || (i > 0 && same(i - 1)))) continue;
    TRY(split_chord_of_loop(edges[i], kept, inner, triangle));
  }
  for (uint32_t& v : *triangle) v = v < places ? kept.vertex[v] : rim + (v - places);
  return {};
}

// Puts the left-out vertices back: the rim edge of a triangle is split at the vertex in the middle
// of those that it spans, until it spans none.
static Status put_back(const Kept& kept, Array<uint32_t>* triangle) {
  const Loops& loops = kept.loops;
  const uint32_t n = loops.start[loops.count()];
  Array<uint32_t> after(triangle->context());  // of each vertex, the next one that has a triangle
  TRY(after.assign(n, k_none));
  TRY(triangle->reserve(triangle->size() + 3 * size_t{n}));
  const size_t kept_count = kept.vertex.size();
  for (size_t i = 0; i < kept_count; ++i) {
    const uint32_t u = kept.vertex[i], v = kept.vertex[i + 1 < kept_count ? i + 1 : 0];
    if (loop_of(loops, u) == loop_of(loops, v)) after[u] = v;
  }
  for (size_t h = 0; h < triangle->size();) {
    const size_t next = h % 3 == 2 ? h - 2 : h + 1, previous = h % 3 == 0 ? h + 2 : h - 1;
    const uint32_t a = (*triangle)[h], b = (*triangle)[next];
    if (a >= n || after[a] != b) {
      ++h;
      continue;
    }
    const uint32_t loop = loop_of(loops, a), first = loops.start[loop];
    const uint32_t size = loops.start[loop + 1] - first;
    const uint32_t between = (b + size - a) % size - 1;
    if (between == 0) {
      ++h;
      continue;
    }
    const uint32_t middle = first + (a - first + 1 + between / 2) % size;
    after[a] = middle;
    after[middle] = b;
    (*triangle)[next] = middle;
    triangle->push_reserved(middle);
    triangle->push_reserved(b);
    triangle->push_reserved((*triangle)[previous]);
  }
  return {};
}

// The area of all triangles; 0 where one of them is a needle without area.
static double sound_area(Span<const Vec3> position, Span<const uint32_t> triangle) {
  double sum = 0.0;
  for (size_t t = 0; t < triangle.size(); t += 3) {
    const Vec3 a = position[triangle[t + 1]] - position[triangle[t]];
    const Vec3 b = position[triangle[t + 2]] - position[triangle[t]], c = b - a;
    const double twice = length(cross(a, b));
    if (!(twice > k_no_area * (dot(a, a) + dot(b, b) + dot(c, c)))) return 0.0;
    sum += 0.5 * twice;
  }
  return sum;
}

static Status triangulate_loops(Context& context, const Loops& loops, Array<Vec3>* inner,
                                Array<uint32_t>* triangle) {
  Kept kept(context, loops);
  TRY(join_loops(&kept));
  TRY(list_best(context, kept, triangle));
  TRY(place_vertices(kept, inner, triangle));
  return put_back(kept, triangle);
}

static bool has_sound_area(const Loops& loops, Span<const Vec3> point,
                           Span<const uint32_t> triangle) {
  const double perimeter = perimeter_of(loops);
  return sound_area(point, triangle) > k_no_area * perimeter * perimeter;
}

static Status take_unrefined(const Loops& loops, const LoopMesh& coarse, Array<Vec3>* point,
                             Array<uint32_t>* triangle) {
  TRY(point->copy(loops.position));
  for (const Vec3& p : coarse.inner) TRY(point->push(p));
  return triangle->copy(coarse.triangle.span());
}

// Refines a copy of the triangulation; `*sound`: whether it has area, and no needle.
static Status refine_copy(const Loops& loops, double spacing, const LoopMesh& coarse,
                          Array<Vec3>* point, Array<uint32_t>* triangle, bool* sound) {
  TRY(take_unrefined(loops, coarse, point, triangle));
  TRY(refine_loops(point->context(), spacing, loops.start, point, triangle));
  *sound = has_sound_area(loops, point->span(), triangle->span());
  return {};
}

Status mesh_loops(Context& context, const Loops& loops, double spacing, LoopMesh* mesh) {
  constexpr int k_tries = 4;
  TRY(check_loops(loops, spacing));
  LoopMesh coarse(context);
  Array<Vec3> point(context);
  Array<uint32_t> triangle(context);
  TRY(triangulate_loops(context, loops, &coarse.inner, &coarse.triangle));
  // Where a border has edges far shorter than the rest the points added may line up with two others
  // in a triangle that no flip removes: fewer of them do not, and none at the last.
  bool sound = false;
  bool coarser = false;
  for (int k = 0; k < k_tries && !sound; ++k) {
    coarser = k > 0;
    TRY(refine_copy(loops, spacing * (1 << k), coarse, &point, &triangle, &sound));
  }
  coarser = coarser || !sound;
  if (!sound) {
    TRY(take_unrefined(loops, coarse, &point, &triangle));
    sound = has_sound_area(loops, point.span(), triangle.span());
  }
  if (!sound) return fail(Code::patch_folded, "the border of the patch encloses no area");
  const size_t n = loops.position.size();
  TRY(mesh->inner.copy(point.span().part(n, point.size() - n)));
  mesh->triangle = static_cast<Array<uint32_t>&&>(triangle);
  mesh->coarse = coarser;
  return {};
}

Status mesh_loop(Context& context, Span<const Vec3> position, Span<const Vec3> normal,
                 double spacing, LoopMesh* mesh) {
  const uint32_t start[] = {0, static_cast<uint32_t>(position.size())};
  return mesh_loops(context, {{start, 2}, position, normal}, spacing, mesh);
}

}  // namespace wireskin::mesh
