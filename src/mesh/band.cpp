#include "mesh/band.h"

#include "base/search.h"
#include "num/minmax.h"

namespace wireskin::mesh {

static constexpr uint32_t k_probes = 48;

namespace {

// One loop by its share of arc length; the second loop of a band is walked against its direction,
// so that both walks go the same way round.
struct Walk {
  Array<uint32_t> vertex;
  Array<double> share;  // of each vertex, from 0, below 1
  Array<Vec3> position, conormal;
  double length = 0.0;

  explicit Walk(Context& context)
      : vertex(context), share(context), position(context), conormal(context) {}
};

// A place of both loops that belong together; shares go on beyond 1 on the second time round.
struct Match {
  double a, b;
};

struct WalkPlace {
  Vec3 position, conormal;
};

}  // namespace

static Status take_walk(const Loops& loops, uint32_t loop, bool backward, Walk* walk) {
  const uint32_t first = loops.start[loop], n = loops.start[loop + 1] - first;
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t v = first + (backward ? (n - i) % n : i);
    const Vec3 along =
        loops.position[loops.next(loop, v)] - loops.position[loops.previous(loop, v)];
    const uint32_t next = backward ? loops.previous(loop, v) : loops.next(loop, v);
    TRY(walk->vertex.push(v));
    TRY(walk->share.push(walk->length));
    TRY(walk->position.push(loops.position[v]));
    TRY(walk->conormal.push(unit(cross(loops.normal[v], along))));
    walk->length += length(loops.position[next] - loops.position[v]);
  }
  for (double& share : walk->share) share /= walk->length;
  return {};
}

static double fraction(double share) {
  const double rest = share - static_cast<double>(static_cast<int64_t>(share));
  return rest < 0.0 ? rest + 1.0 : rest;
}

static WalkPlace place_at(const Walk& walk, double share) {
  const double at = fraction(share);
  const size_t low =
      last_holding(size_t{0}, walk.share.size(), [&](size_t i) { return walk.share[i] <= at; });
  const size_t next = low + 1 < walk.share.size() ? low + 1 : 0;
  const double end = next == 0 ? 1.0 : walk.share[next];
  const double t = end > walk.share[low] ? (at - walk.share[low]) / (end - walk.share[low]) : 0.0;
  return {(1.0 - t) * walk.position[low] + t * walk.position[next],
          unit((1.0 - t) * walk.conormal[low] + t * walk.conormal[next])};
}

namespace {

// The walk's table: from places (0, offset) to (k_probes, offset + k_probes).
struct WalkTable {
  Array<double> distance;  // squared, of places i and j at i * k_probes + j
  Array<double> cost;      // at i * (k_probes + 1) + j
  Array<uint8_t> step;     // 0 both, 1 the first, 2 the second
  Array<uint8_t> best_step;

  explicit WalkTable(Context& context)
      : distance(context), cost(context), step(context), best_step(context) {}
};

}  // namespace

static double fill_table(uint32_t offset, WalkTable* table) {
  constexpr uint32_t n = k_probes, width = n + 1;
  for (uint32_t i = 0; i <= n; ++i) {
    for (uint32_t j = 0; j <= n; ++j) {
      const double own = table->distance[i % n * n + (j + offset) % n];
      double least = i + j == 0 ? 0.0 : DBL_MAX;
      uint8_t step = 0;
      if (i > 0 && j > 0) least = table->cost[(i - 1) * width + j - 1];
      if (i > 0 && table->cost[(i - 1) * width + j] < least) {
        least = table->cost[(i - 1) * width + j];
        step = 1;
      }
      if (j > 0 && table->cost[i * width + j - 1] < least) {
        least = table->cost[i * width + j - 1];
        step = 2;
      }
      table->cost[i * width + j] = least + own;
      table->step[i * width + j] = step;
    }
  }
  return table->cost[n * width + n];
}

// The matches in order, the first one again at the end, once round later.
static Status match_walks(const Walk& a, const Walk& b, Array<Match>* matches) {
  constexpr uint32_t n = k_probes, width = n + 1;
  WalkTable table(matches->context());
  TRY(table.distance.resize(size_t{n} * n));
  TRY(table.cost.resize(size_t{width} * width));
  TRY(table.step.resize(size_t{width} * width));
  TRY(table.best_step.resize(size_t{width} * width));
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = 0; j < n; ++j) {
      const Vec3 way = place_at(b, static_cast<double>(j) / n).position -
                       place_at(a, static_cast<double>(i) / n).position;
      table.distance[i * n + j] = dot(way, way);
    }
  }
  double least = DBL_MAX;
  uint32_t offset = 0;
  for (uint32_t o = 0; o < n; ++o) {
    const double cost = fill_table(o, &table);
    if (!(cost < least)) continue;
    least = cost;
    offset = o;
    TRY(table.best_step.copy(table.step.span()));
  }
  TRY(matches->context().checkpoint());
  // Backwards from the end; the middle of every step is a match, so that corners are cut.
  uint32_t i = n, j = n;
  while (i + j > 0) {
    const uint8_t step = table.best_step[i * width + j];
    const double back_a = step == 2 ? 0.0 : 0.5, back_b = step == 1 ? 0.0 : 0.5;
    TRY(matches->push({(i - back_a) / n, (j + offset - back_b) / n}));
    i -= step == 2 ? 0 : 1;
    j -= step == 1 ? 0 : 1;
  }
  for (size_t k = 0, l = matches->size() - 1; k < l; ++k, --l) {
    const Match kept = (*matches)[k];
    (*matches)[k] = (*matches)[l];
    (*matches)[l] = kept;
  }
  const Match first = (*matches)[0];
  return matches->push({first.a + 1.0, first.b + 1.0});
}

// From a share of one loop to that of the other.
static double matched(Span<const Match> matches, double share, bool from_b) {
  const double first = from_b ? matches[0].b : matches[0].a;
  double at = share;
  while (at < first) at += 1.0;
  while (at >= first + 1.0) at -= 1.0;
  const size_t low = last_holding(size_t{0}, matches.size() - 1, [&](size_t i) {
    return (from_b ? matches[i].b : matches[i].a) <= at;
  });
  const Match &m = matches[low], &n = matches[low + 1];
  const double begin = from_b ? m.b : m.a, end = from_b ? n.b : n.a;
  const double t = end > begin ? (at - begin) / (end - begin) : 0.0;
  return from_b ? m.a + t * (n.a - m.a) : m.b + t * (n.b - m.b);
}

// The end tangent's length of a cubic that comes near a circular arc over this chord.
static Vec3 arc_tangent_of(const Vec3& conormal, const Vec3& chord) {
  if (conormal == Vec3{}) return chord;
  const double cosine = dot(conormal, unit(chord));
  return (2.0 * length(chord) / (1.0 + larger(cosine, 0.0))) * conormal;
}

static Vec3 band_point(const WalkPlace& a, const WalkPlace& b, double t) {
  const Vec3 chord = b.position - a.position;
  const Vec3 from = arc_tangent_of(a.conormal, chord), to = arc_tangent_of(-b.conormal, chord);
  const double s = 1.0 - t;
  return s * s * (1.0 + 2.0 * t) * a.position + t * t * (1.0 + 2.0 * s) * b.position +
         t * s * s * from - t * t * s * to;
}

namespace {

// Points in their order round the band, by the share of the first loop where each belongs.
struct Row {
  Array<uint32_t> vertex;
  Array<double> share;  // ascending, over less than one round

  explicit Row(Context& context) : vertex(context), share(context) {}
};

}  // namespace

// Triangles between neighbouring rows: whichever row's next point comes first goes on.
static Status zip_rows(const Row& lower, const Row& upper, Array<uint32_t>* triangle) {
  const size_t n = lower.vertex.size(), m = upper.vertex.size();
  const auto share = [](const Row& row, size_t i) {
    return row.share[i % row.share.size()] + (i < row.share.size() ? 0.0 : 1.0);
  };
  for (size_t i = 0, j = 0; i < n || j < m;) {
    const bool low = j == m || (i < n && share(lower, i + 1) <= share(upper, j + 1));
    const uint32_t l = lower.vertex[i % n], u = upper.vertex[j % m];
    TRY(triangle->push(l));
    TRY(triangle->push(low ? lower.vertex[(i + 1) % n] : upper.vertex[(j + 1) % m]));
    TRY(triangle->push(u));
    ++(low ? i : j);
  }
  return {};
}

// The loop's vertices by the share of the first loop, from the least share on.
static Status row_of_loop(const Walk& walk, Span<const Match> matches, bool second, Row* row) {
  const size_t n = walk.vertex.size();
  Array<double> own(row->share.context());
  size_t first = 0;
  for (size_t i = 0; i < n; ++i) {
    TRY(own.push(fraction(second ? matched(matches, walk.share[i], true) : walk.share[i])));
    if (own[i] < own[first]) first = i;
  }
  // Of vertices matched to one place the one that follows another place is first, if any does.
  for (size_t i = 1; second && i < n && own[first] == own[(first + n - 1) % n]; ++i) {
    first = (first + n - 1) % n;
  }
  for (size_t i = 0; i < n; ++i) {
    const size_t k = (first + i) % n;
    double share = own[k];
    if (i > 0 && share < row->share[i - 1]) share = row->share[i - 1];  // rounding
    TRY(row->vertex.push(walk.vertex[k]));
    TRY(row->share.push(share));
  }
  return {};
}

static double mean_way_across(const Walk& a, const Walk& b, Span<const Match> matches) {
  double sum = 0.0;
  for (const Match& m : matches.part(0, matches.size() - 1)) {
    const WalkPlace from = place_at(a, m.a), to = place_at(b, m.b);
    const Vec3 middle = band_point(from, to, 0.5);
    sum += length(middle - from.position) + length(to.position - middle);
  }
  return sum / static_cast<double>(matches.size() - 1);
}

static Status fill_row(const Walk& a, const Walk& b, Span<const Match> matches, uint32_t points,
                       double t, double offset, Row* row, LoopMesh* mesh) {
  const uint32_t rim = static_cast<uint32_t>(a.vertex.size() + b.vertex.size());
  row->vertex.clear();
  row->share.clear();
  for (uint32_t i = 0; i < points; ++i) {
    const double share = (i + offset) / points;
    TRY(row->vertex.push(rim + static_cast<uint32_t>(mesh->inner.size())));
    TRY(row->share.push(share));
    TRY(mesh->inner.push(
        band_point(place_at(a, share), place_at(b, matched(matches, share, false)), t)));
  }
  return mesh->inner.context().checkpoint();
}

static Status check_band(const Walk& a, const Walk& b, double spacing) {
  if (!(spacing > 0.0) || spacing > DBL_MAX) {
    return fail(Code::bad_argument, "the spacing is not a positive number");
  }
  if (a.vertex.size() < 3 || b.vertex.size() < 3) {
    return fail(Code::patch_folded, "the border has fewer than three points");
  }
  if (!(a.length > 0.0) || !(b.length > 0.0)) {
    return fail(Code::patch_folded, "the border of the patch encloses no area");
  }
  return {};
}

Status mesh_band(Context& context, const Loops& loops, double spacing, LoopMesh* mesh) {
  constexpr double k_most_points = 5e7, k_least_round = 8.0, k_least_rows = 2.0;
  constexpr double k_row_height = 0.866;  // of rows of equilateral triangles
  Walk a(context), b(context);
  Array<Match> matches(context);
  Row lower(context), upper(context), last(context);
  WIRESKIN_ASSERT(loops.count() == 2);
  TRY(take_walk(loops, 0, false, &a));
  TRY(take_walk(loops, 1, true, &b));
  TRY(check_band(a, b, spacing));
  TRY(match_walks(a, b, &matches));
  const double round = larger(k_least_round, larger(a.length, b.length) / spacing + 0.5);
  const double rows =
      larger(k_least_rows, mean_way_across(a, b, matches.span()) / (k_row_height * spacing) + 0.5);
  if (!(round * rows < k_most_points)) {
    return fail(Code::too_large, "the spacing is too small for the size of the patch");
  }
  const uint32_t row_count = static_cast<uint32_t>(rows), points = static_cast<uint32_t>(round);
  mesh->inner.clear();
  mesh->triangle.clear();
  TRY(row_of_loop(a, matches.span(), false, &lower));
  for (uint32_t k = 1; k < row_count; ++k) {
    TRY(fill_row(a, b, matches.span(), points, static_cast<double>(k) / row_count,
                 k % 2 == 0 ? 0.0 : 0.5, &upper, mesh));
    TRY(zip_rows(lower, upper, &mesh->triangle));
    TRY(lower.vertex.copy(upper.vertex.span()));
    TRY(lower.share.copy(upper.share.span()));
  }
  TRY(row_of_loop(b, matches.span(), true, &last));
  return zip_rows(lower, last, &mesh->triangle);
}

}  // namespace wireskin::mesh
