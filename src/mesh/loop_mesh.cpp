#include "mesh/loop_mesh.h"

#include "mesh/loop_refine.h"

namespace wireskin::mesh {

static constexpr uint32_t k_most_kept = 150;
// Loops in a plane have the same area however they are cut: short edges decide there, so that
// rounding does not.
static constexpr double k_weight_of_edges = 1e-4;
// Areas below this share of the squared perimeter, and angles of about this size, are none.
static constexpr double k_no_area = 1e-10;

namespace {

// The vertices that take part in the dynamic programme, as indices into the loop.
struct Kept {
  Span<const Vec3> position, normal;
  Array<uint32_t> vertex;

  explicit Kept(Context& context) : vertex(context) {}
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

static double perimeter_of(Span<const Vec3> loop) {
  double sum = 0.0;
  for (size_t i = 0; i < loop.size(); ++i) {
    sum += length(loop[i + 1 < loop.size() ? i + 1 : 0] - loop[i]);
  }
  return sum;
}

static Status check_loop(Span<const Vec3> loop, double spacing) {
  if (!(spacing > 0.0) || spacing > DBL_MAX) {
    return fail(Code::bad_argument, "the spacing is not a positive number");
  }
  if (loop.size() < 3) return fail(Code::patch_folded, "the border has fewer than three points");
  for (size_t i = 0; i < loop.size(); ++i) {
    // False for coordinates that are not numbers, too.
    if (!(length(loop[i + 1 < loop.size() ? i + 1 : 0] - loop[i]) > 0.0)) {
      return fail(Code::patch_folded, "two neighbours on the border coincide");
    }
  }
  return {};
}

// How far the tangent turns at vertex i, 0 to 2.
static double turn_at(Span<const Vec3> loop, size_t i) {
  const Vec3 out = loop[i + 1 < loop.size() ? i + 1 : 0] - loop[i];
  const Vec3 in = loop[i] - loop[i > 0 ? i - 1 : loop.size() - 1];
  return length(unit(out) - unit(in));
}

// All vertices, or of a long loop those that share its shape evenly: a vertex stands for its edge,
// its turn and itself, each measured against their sum over the loop, and one is kept wherever the
// running total passes a multiple of its k_most_kept-th part.
static Status keep_vertices(Kept* kept) {
  const Span<const Vec3> loop = kept->position;
  const uint32_t n = static_cast<uint32_t>(loop.size());
  TRY(kept->vertex.reserve(n < k_most_kept ? n : k_most_kept));
  if (n <= k_most_kept) {
    for (uint32_t i = 0; i < n; ++i) kept->vertex.push_reserved(i);
    return {};
  }
  const double perimeter = perimeter_of(loop);
  double turning = DBL_MIN, sum = 0.0;
  for (uint32_t i = 0; i < n; ++i) turning += turn_at(loop, i);
  uint32_t passed = 0;
  for (uint32_t i = 0; i < n && passed < k_most_kept; ++i) {
    sum += length(loop[i + 1 < n ? i + 1 : 0] - loop[i]) / perimeter + turn_at(loop, i) / turning +
           1.0 / static_cast<double>(n);
    const uint32_t now = static_cast<uint32_t>(k_most_kept * (sum / 3.0));
    if (now > passed) kept->vertex.push_reserved(i);
    passed = now;
  }
  // One edge or turn may swallow many parts, but the vertices' own third remains.
  WIRESKIN_ASSERT(kept->vertex.size() >= 3);
  return {};
}

static double triangle_weight(const Kept& kept, uint32_t i, uint32_t j, uint32_t k) {
  const uint32_t u = kept.vertex[i], v = kept.vertex[j], w = kept.vertex[k];
  const Vec3 a = kept.position[v] - kept.position[u], b = kept.position[w] - kept.position[u];
  const Vec3 across = cross(a, b), c = b - a;
  const Vec3 facing = unit(kept.normal[u] + kept.normal[v] + kept.normal[w]);
  // |across| / 2 is the area, so this is area * (1 + 2 (1 - cos)) without a division.
  return 1.5 * length(across) - dot(across, facing) +
         k_weight_of_edges * (dot(a, a) + dot(b, b) + dot(c, c));
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

// Follows the apexes down from the chord between the first and the last kept vertex.
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
    TRY(triangle->push(kept.vertex[chord.from]));
    TRY(triangle->push(kept.vertex[apex]));
    TRY(triangle->push(kept.vertex[chord.to]));
    TRY(open.push({apex, chord.to}));
    TRY(open.push({chord.from, apex}));
  }
  return {};
}

// Puts the left-out vertices back: the rim edge of a triangle is split at the vertex in the middle
// of those that it spans, until it spans none.
static Status put_back(Context& context, const Kept& kept, Array<uint32_t>* triangle) {
  const uint32_t n = static_cast<uint32_t>(kept.position.size());
  Array<uint32_t> after(context);  // of each vertex, the next one that has a triangle
  TRY(after.assign(n, k_none));
  TRY(triangle->reserve(3 * (size_t{n} - 2)));
  for (size_t i = 0; i < kept.vertex.size(); ++i) {
    after[kept.vertex[i]] = kept.vertex[i + 1 < kept.vertex.size() ? i + 1 : 0];
  }
  for (size_t h = 0; h < triangle->size();) {
    const size_t next = h % 3 == 2 ? h - 2 : h + 1, previous = h % 3 == 0 ? h + 2 : h - 1;
    const uint32_t a = (*triangle)[h], b = (*triangle)[next];
    const uint32_t between = (b + n - a) % n - 1;
    if (after[a] != b || between == 0) {
      ++h;
      continue;
    }
    const uint32_t middle = (a + 1 + between / 2) % n;
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

static Status triangulate_loop(Context& context, Span<const Vec3> position, Span<const Vec3> normal,
                               Array<uint32_t>* triangle) {
  Kept kept(context);
  kept.position = position;
  kept.normal = normal;
  TRY(keep_vertices(&kept));
  TRY(list_best(context, kept, triangle));
  return put_back(context, kept, triangle);
}

Status mesh_loop(Context& context, Span<const Vec3> position, Span<const Vec3> normal,
                 double spacing, LoopMesh* mesh) {
  TRY(check_loop(position, spacing));
  Array<Vec3> point(context);
  Array<uint32_t> triangle(context);
  TRY(point.copy(position));
  TRY(triangulate_loop(context, position, normal, &triangle));
  TRY(refine_loop(context, spacing, static_cast<uint32_t>(position.size()), &point, &triangle));
  const double perimeter = perimeter_of(position);
  if (!(sound_area(point.span(), triangle.span()) > k_no_area * perimeter * perimeter)) {
    return fail(Code::patch_folded, "the border of the patch encloses no area");
  }
  const size_t n = position.size();
  TRY(mesh->inner.copy(point.span().part(n, point.size() - n)));
  mesh->triangle = static_cast<Array<uint32_t>&&>(triangle);
  return {};
}

}  // namespace wireskin::mesh
