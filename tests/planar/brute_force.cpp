// Regions by the hundred thousand, each against a check that looks at everything:
//   brute_force RANDOM ADVERSARIAL [SEED]
// The check knows nothing of how the mesh was made: the points given come back bit for bit; every
// edge of the region is an edge of the mesh, or where points lie on it, a chain of them; triangles
// turn left and every edge has two sides or divides; each triangle's middle lies inside by counting
// crossings; the area is that of the region; Euler's formula holds; across every edge that is no
// constraint the circle is empty. Signs are taken from
// the exact predicates, which have tests of their own.
// Regions that cannot be meshed must be refused, and those only.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "num/predicates.h"
#include "planar/polygon_mesh.h"

using namespace wireskin;
using namespace wireskin::planar;

namespace {

using Edge = std::pair<uint32_t, uint32_t>;

struct Scene {
  std::vector<Vec2> points;
  std::vector<uint32_t> border, lines;
  double spacing = 1.0;
  bool join = true;

  bool on_grid() const {
    return std::all_of(points.begin(), points.end(), [](const Vec2& p) {
      return p.x == std::floor(p.x) && p.y == std::floor(p.y);
    });
  }
};

std::mt19937 engine;

uint32_t below(uint32_t n) {
  return static_cast<uint32_t>(engine() % n);
}
double uniform() {
  return static_cast<double>(engine()) * 0x1p-32;
}

void* allocate(size_t bytes, void*) {
  return std::malloc(bytes);
}
void release(void* memory, size_t, void*) {
  std::free(memory);
}

bool same(const Vec2& a, const Vec2& b) {
  return a.x == b.x && a.y == b.y;
}

int sign(double x) {
  return x > 0.0 ? 1 : x < 0.0 ? -1 : 0;
}

// Is p on the closed segment a-b?
bool on_segment(const Vec2& a, const Vec2& b, const Vec2& p) {
  if (orient2d(a, b, p) != 0.0) return false;
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool cross_properly(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return sign(orient2d(a, b, c)) * sign(orient2d(a, b, d)) < 0 &&
         sign(orient2d(c, d, a)) * sign(orient2d(c, d, b)) < 0;
}

struct Truth {
  const Scene& scene;
  std::vector<Edge> edges;      // ends of all edges of the region
  std::vector<uint32_t> least;  // of each point, the first that equals it

  explicit Truth(const Scene& s) : scene(s) {
    for (const auto* list : {&s.border, &s.lines}) {
      for (size_t i = 0; i + 1 < list->size(); i += 2)
        edges.push_back({(*list)[i], (*list)[i + 1]});
    }
    for (uint32_t i = 0; i < s.points.size(); ++i) {
      uint32_t k = 0;
      while (!same(s.points[k], s.points[i])) ++k;
      least.push_back(k);
    }
  }
  size_t border_edges() const { return scene.border.size() / 2; }
  const Vec2& at(uint32_t i) const { return scene.points[i]; }

  bool closed() const {
    std::vector<int> degree(scene.points.size(), 0);
    for (const uint32_t v : scene.border) ++degree[least[v]];
    return std::all_of(degree.begin(), degree.end(), [](int d) { return d % 2 == 0; });
  }
  bool any_crossing() const {
    for (size_t i = 0; i < edges.size(); ++i) {
      for (size_t k = 0; k < i; ++k) {
        const Vec2 a = at(edges[i].first), b = at(edges[i].second);
        const Vec2 c = at(edges[k].first), d = at(edges[k].second);
        if (!cross_properly(a, b, c, d)) continue;
        // Where a point was given, edges may meet.
        if (std::none_of(scene.points.begin(), scene.points.end(), [&](const Vec2& p) {
              return on_segment(a, b, p) && on_segment(c, d, p);
            })) {
          return true;
        }
      }
    }
    return false;
  }
  // Equal points, points on edges, edges without length.
  bool any_touching() const {
    for (uint32_t i = 0; i < least.size(); ++i) {
      if (least[i] != i) return true;
      for (const Edge& e : edges) {
        if (e.first != i && e.second != i && on_segment(at(e.first), at(e.second), at(i))) {
          return true;
        }
      }
    }
    return std::any_of(edges.begin(), edges.end(),
                       [](const Edge& e) { return e.first == e.second; });
  }
  // Points and ends of edges cut each edge into pieces; how often the border runs over each.
  std::map<Edge, int> pieces(size_t* count) const {
    std::map<Edge, int> result;
    for (size_t e = 0; e < edges.size(); ++e) {
      const Vec2 a = at(edges[e].first), b = at(edges[e].second);
      std::vector<uint32_t> on;
      for (uint32_t i = 0; i < least.size(); ++i) {
        if (least[i] == i && on_segment(a, b, at(i))) on.push_back(i);
      }
      std::sort(on.begin(), on.end(), [&](uint32_t p, uint32_t q) {
        return std::make_pair(at(p).x, at(p).y) < std::make_pair(at(q).x, at(q).y);
      });
      for (size_t i = 1; i < on.size(); ++i) {
        result[{std::min(on[i - 1], on[i]), std::max(on[i - 1], on[i])}] +=
            e < border_edges() ? 1 : 0;
      }
    }
    *count = result.size();
    return result;
  }
  // By a ray to the right from a point that is on no edge.
  bool inside(const Vec2& p) const {
    bool in = false;
    for (size_t e = 0; e < border_edges(); ++e) {
      Vec2 a = at(edges[e].first), b = at(edges[e].second);
      if ((a.y <= p.y) == (b.y <= p.y)) continue;
      if (a.y > b.y) std::swap(a, b);
      if (orient2d(a, b, p) > 0.0) in = !in;
    }
    return in;
  }
  // For grid points, whose halves are exact.
  bool any_line_outside() const {
    size_t count = 0;
    for (const auto& [piece, times] : pieces(&count)) {
      if (times % 2 == 0 && !inside(0.5 * (at(piece.first) + at(piece.second)))) return true;
    }
    return false;
  }
};

[[noreturn]] void report(const Scene& s, const char* what, unsigned long number) {
  std::printf("scene %lu: %s (spacing %.17g, join %d)\n", number, what, s.spacing, s.join);
  for (const Vec2& p : s.points) std::printf("  {%.17g, %.17g},\n", p.x, p.y);
  for (const auto* list : {&s.border, &s.lines}) {
    std::printf("  %s:", list == &s.border ? "border" : "lines");
    for (const uint32_t v : *list) std::printf(" %u", v);
    std::printf("\n");
  }
  std::exit(1);
}

// The half-edges of a mesh, those that leave each vertex together.
struct HalfEdges {
  std::vector<uint32_t> start, from, to, apex, triangle;

  HalfEdges(size_t points, const Array<uint32_t>& corners)
      : start(points + 1, 0),
        from(corners.size()),
        to(corners.size()),
        apex(corners.size()),
        triangle(corners.size()) {
    for (const uint32_t v : corners) ++start[v + 1];
    for (size_t v = 0; v < points; ++v) start[v + 1] += start[v];
    std::vector<uint32_t> next(start.begin(), start.end() - 1);
    for (uint32_t i = 0; i < corners.size(); ++i) {
      const uint32_t t = i / 3, h = next[corners[i]]++;
      from[h] = corners[i];
      to[h] = corners[3 * t + (i + 1) % 3];
      apex[h] = corners[3 * t + (i + 2) % 3];
      triangle[h] = t;
    }
  }
  uint32_t size() const { return static_cast<uint32_t>(to.size()); }
  bool leaves(uint32_t v) const { return start[v] != start[v + 1]; }
  uint32_t find(uint32_t a, uint32_t b) const {
    for (uint32_t h = start[a]; h < start[a + 1]; ++h) {
      if (to[h] == b) return h;
    }
    return k_none;
  }
  uint32_t twin(uint32_t h) const { return find(to[h], from[h]); }
};

// V - E + F of the closed triangles, corner by corner: the triangles round a vertex form fans, and
// each fan beyond the first at a vertex that the border touches twice would be a vertex more. Each
// component of the inside with b border circles has 2 - b in this count.
const char* check_euler(const HalfEdges& half, const std::vector<uint32_t>& twin, size_t edges) {
  const size_t triangles = half.size() / 3, points = half.start.size() - 1;
  std::vector<size_t> rim_edges(points, 0);
  for (uint32_t h = 0; h < half.size(); ++h) rim_edges[half.from[h]] += twin[h] == k_none ? 1 : 0;
  size_t fans = 0;
  for (uint32_t v = 0; v < points; ++v) {
    if (half.leaves(v)) fans += rim_edges[v] != 0 ? rim_edges[v] : 1;
  }
  std::vector<size_t> parent(triangles);
  for (size_t i = 0; i < parent.size(); ++i) parent[i] = i;
  const auto root = [&](size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::vector<uint32_t> next_rim(half.size(), k_none);
  for (uint32_t h = 0; h < half.size(); ++h) {
    if (twin[h] != k_none) {
      parent[root(half.triangle[h])] = root(half.triangle[twin[h]]);
      continue;
    }
    // Turn round the end within its fan to the next rim edge.
    uint32_t out = half.find(half.to[h], half.apex[h]);
    while (twin[out] != k_none) {
      const uint32_t beyond = twin[out];
      out = half.find(half.to[beyond], half.apex[beyond]);
    }
    next_rim[h] = out;
  }
  size_t components = 0, circles = 0;
  for (size_t i = 0; i < parent.size(); ++i) components += root(i) == i ? 1u : 0u;
  std::vector<char> seen(half.size(), 0);
  for (uint32_t h = 0; h < half.size(); ++h) {
    if (next_rim[h] == k_none || seen[h] != 0) continue;
    ++circles;
    for (uint32_t e = h; seen[e] == 0; e = next_rim[e]) seen[e] = 1;
  }
  const long euler =
      static_cast<long>(fans) - static_cast<long>(edges) + static_cast<long>(triangles);
  return euler == 2 * static_cast<long>(components) - static_cast<long>(circles) ? nullptr
                                                                                 : "Euler";
}

const char* check_mesh(const Truth& truth, const PolygonMesh& mesh) {
  const Scene& s = truth.scene;
  if (mesh.points.size() < s.points.size() ||
      std::memcmp(mesh.points.data(), s.points.data(), s.points.size() * sizeof(Vec2)) != 0) {
    return "the points given do not come back";
  }
  for (uint32_t i = 0; i < s.points.size(); ++i) {
    if (mesh.joined[i] != truth.least[i]) return "joined points";
  }
  size_t piece_count = 0;
  const std::map<Edge, int> pieces = truth.pieces(&piece_count);
  double area = 0.0, wished = 0.0;
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const uint32_t* v = &mesh.triangles[i];
    const Vec2 a = mesh.points[v[0]], b = mesh.points[v[1]], c = mesh.points[v[2]];
    if (!(orient2d(a, b, c) > 0.0)) return "a triangle does not turn left";
    area += cross(b - a, c - a);
    const Vec2 middle = (1.0 / 3.0) * (a + b + c);
    const bool clear = orient2d(a, b, middle) > 0.0 && orient2d(b, c, middle) > 0.0 &&
                       orient2d(c, a, middle) > 0.0;
    if (clear && !truth.inside(middle)) return "a triangle lies outside";
  }
  const HalfEdges half(mesh.points.size(), mesh.triangles);
  std::vector<uint32_t> twin(half.size());
  for (uint32_t h = 0; h < half.size(); ++h) {
    if (half.find(half.from[h], half.to[h]) != h) return "an edge twice";
    twin[h] = half.twin(h);
  }
  // The area under each border edge; even-odd areas have no such formula, so inside is asked on the
  // piece's left.
  size_t rim = 0, edges = 0;
  for (uint32_t h = 0; h < half.size(); ++h) {
    const uint32_t a = half.from[h], b = half.to[h];
    const bool given = a < s.points.size() && b < s.points.size();
    const auto piece = given ? pieces.find({std::min(a, b), std::max(a, b)}) : pieces.end();
    const bool divides = piece != pieces.end() && piece->second % 2 != 0;
    if ((twin[h] == k_none) != divides) return "the rim is not the border";
    if (twin[h] == k_none) {
      ++rim;
      wished += cross(mesh.points[a] - s.points[0], mesh.points[b] - s.points[0]);
    }
    if (twin[h] == k_none || a < b) ++edges;
    if (piece != pieces.end() || twin[h] == k_none) continue;
    if (incircle(mesh.points[a], mesh.points[b], mesh.points[half.apex[h]],
                 mesh.points[half.apex[twin[h]]]) > 0.0) {
      return "not Delaunay";
    }
  }
  size_t odd = 0;
  for (const auto& [key, count] : pieces) {
    odd += count % 2 != 0 ? 1u : 0u;
    if (half.find(key.first, key.second) == k_none && half.find(key.second, key.first) == k_none) {
      return "an edge is missing";
    }
  }
  if (rim != odd) return "a border edge is missing";
  double scale = 0.0;
  for (const Vec2& p : s.points) {
    scale = std::max({scale, std::fabs(p.x - s.points[0].x), std::fabs(p.y - s.points[0].y)});
  }
  if (!(std::fabs(area - wished) <= 1e-10 * scale * scale)) return "the area is wrong";
  for (uint32_t i = 0; i < s.points.size(); ++i) {
    if ((truth.least[i] == i) != half.leaves(i)) return "a point is not in the mesh";
  }
  return check_euler(half, twin, edges);
}

struct Counts {
  unsigned long meshed = 0, refused = 0, triangles = 0;
};

void run(const Scene& scene, unsigned long number, Counts* counts) {
  const Truth truth(scene);
  Context context({allocate, release, nullptr}, 0, {});
  PolygonMesh mesh(context);
  const Region region = {{scene.points.data(), scene.points.size()},
                         {scene.border.data(), scene.border.size()},
                         {scene.lines.data(), scene.lines.size()},
                         scene.join};
  const Status status = mesh_region(context, region, scene.spacing, &mesh);
  const bool crossing = truth.any_crossing();
  const bool touching = !scene.join && truth.any_touching();
  if (status.ok()) {
    if (crossing) report(scene, "edges that cross were meshed", number);
    if (touching) report(scene, "points that touch were meshed", number);
    const char* wrong = check_mesh(truth, mesh);
    if (wrong != nullptr) report(scene, wrong, number);
    ++counts->meshed;
    counts->triangles += mesh.triangles.size() / 3;
    return;
  }
  ++counts->refused;
  const Conflict& c = mesh.conflict;
  if (!mesh.points.empty()) report(scene, "a result in spite of the refusal", number);
  const auto& at = scene.points;
  switch (status.code) {
    case Code::patch_folded: {
      if (!crossing && !touching) report(scene, "refused as folded", number);
      bool named = false;
      if (c.edge[0] != k_none && c.edge[1] != k_none) {
        const Edge e = truth.edges[c.edge[0]], f = truth.edges[c.edge[1]];
        named = cross_properly(at[e.first], at[e.second], at[f.first], at[f.second]);
      } else if (c.edge[0] != k_none && c.point[0] != k_none) {
        const Edge e = truth.edges[c.edge[0]];
        named = on_segment(at[e.first], at[e.second], at[c.point[0]]);
      } else if (c.point[0] != k_none && c.point[1] != k_none) {
        named = c.point[0] != c.point[1] && same(at[c.point[0]], at[c.point[1]]);
      }
      if (!named) report(scene, "what is in the way is not named", number);
      return;
    }
    case Code::open_network:
      if (truth.closed()) report(scene, "a closed border was refused", number);
      return;
    case Code::patch_without_plane:
      // Nothing inside: all on a line, or every piece of the border an even number of times.
      {
        bool line = true;
        for (const Vec2& p : at) {
          for (const Vec2& q : at) line = line && orient2d(at[0], p, q) == 0.0;
        }
        size_t count = 0;
        bool even = true;
        for (const auto& [piece, times] : truth.pieces(&count)) even = even && times % 2 == 0;
        if (!line && !even) report(scene, "refused as without area", number);
      }
      return;
    case Code::bad_argument: {
      // A point outside: it must neither be inside nor on the border. Or an edge outside.
      if (c.point[0] == k_none) report(scene, "no point is named", number);
      if (c.edge[0] != k_none) {
        if (scene.on_grid() && !truth.any_line_outside()) {
          report(scene, "an edge inside was refused", number);
        }
        return;
      }
      bool bounds = truth.inside(at[c.point[0]]);
      size_t count = 0;
      for (const auto& [piece, times] : truth.pieces(&count)) {
        bounds = bounds || (times % 2 != 0 && (piece.first == truth.least[c.point[0]] ||
                                               piece.second == truth.least[c.point[0]]));
      }
      if (bounds) report(scene, "a point inside was refused", number);
      return;
    }
    default:
      report(scene, status.sentence, number);
  }
}

void add_loop(Scene* s, const std::vector<Vec2>& loop) {
  const uint32_t first = static_cast<uint32_t>(s->points.size());
  const uint32_t count = static_cast<uint32_t>(loop.size());
  for (uint32_t i = 0; i < count; ++i) {
    s->points.push_back(loop[i]);
    s->border.push_back(first + i);
    s->border.push_back(first + (i + 1) % count);
  }
}

std::vector<Vec2> ring(Vec2 centre, double least, double greatest, uint32_t count) {
  std::vector<Vec2> loop;
  const double start = uniform();
  for (uint32_t i = 0; i < count; ++i) {
    const double t = 6.283185307179586 * (i + start) / count;
    const double r = least + (greatest - least) * uniform();
    loop.push_back(centre + r * Vec2{std::cos(t), std::sin(t)});
  }
  if (below(2) == 0) std::reverse(loop.begin(), loop.end());
  return loop;
}

// A ragged star with holes, lines and points in it; some of it may cross.
Scene random_scene() {
  Scene s;
  add_loop(&s, ring({0, 0}, 0.5, 1.0, 3 + below(9)));
  for (uint32_t k = below(3); k > 0; --k) {
    add_loop(&s, ring({0.6 * uniform() - 0.3, 0.6 * uniform() - 0.3}, 0.02, 0.15, 3 + below(4)));
  }
  for (uint32_t k = below(4); k > 0; --k) {
    s.points.push_back({uniform() - 0.5, uniform() - 0.5});
    if (below(2) == 0) continue;
    const uint32_t n = static_cast<uint32_t>(s.points.size());
    s.lines.push_back(n - 1);
    s.lines.push_back(below(n - 1));
  }
  s.spacing = below(3) == 0 ? 0.25 + uniform() : 4.0;
  s.join = below(2) == 0;
  return s;
}

Vec2 grid_point(uint32_t size) {
  return {static_cast<double>(below(size)), static_cast<double>(below(size))};
}

void drop_loose_points(Scene* s) {
  std::vector<uint32_t> number(s->points.size(), k_none);
  std::vector<Vec2> kept;
  for (auto* list : {&s->border, &s->lines}) {
    for (uint32_t& v : *list) {
      if (number[v] == k_none) {
        number[v] = static_cast<uint32_t>(kept.size());
        kept.push_back(s->points[v]);
      }
      v = number[v];
    }
  }
  s->points = kept;
}

// Random closed walks and lines over few points of a small grid: nearly everything touches.
Scene grid_scene() {
  Scene s;
  const uint32_t size = 3 + below(4), count = 3 + below(8);
  for (uint32_t i = 0; i < count; ++i) s.points.push_back(grid_point(size));
  for (uint32_t loops = 1 + below(2); loops > 0; --loops) {
    const uint32_t first = below(count);
    uint32_t last = first;
    for (uint32_t k = 2 + below(4); k > 0; --k) {
      const uint32_t to = below(count);
      s.border.push_back(last);
      s.border.push_back(to);
      last = to;
    }
    s.border.push_back(last);
    s.border.push_back(first);
  }
  if (below(4) == 0) {
    s.lines.push_back(below(count));
    s.lines.push_back(below(count));
  }
  if (below(8) != 0) drop_loose_points(&s);
  return s;
}

// A square of grid points with collinear runs, squares in it that touch at corners or along parts
// of their sides, nested several deep; lines along grid lines.
Scene nested_scene() {
  Scene s;
  double low = 0.0, high = 12.0;
  for (uint32_t depth = 1 + below(4); depth > 0 && high - low >= 2.0; --depth) {
    std::vector<Vec2> loop;
    for (double x = low; x < high; x += 1.0) loop.push_back({x, low});
    for (double y = low; y < high; y += 1.0 + below(2)) loop.push_back({high, y});
    loop.push_back({high, high});
    loop.push_back({low, high});
    add_loop(&s, loop);
    low += below(3);
    high -= 1.0 + below(2);
  }
  for (uint32_t k = below(4); k > 0; --k) {
    const uint32_t n = static_cast<uint32_t>(s.points.size());
    s.lines.push_back(below(n));
    s.lines.push_back(below(n));
  }
  s.spacing = 1.0 + 3.0 * below(3);
  return s;
}

// All points on one circle: of integers, or of rounded cosines.
Scene cocircular_scene() {
  static const Vec2 quarter[] = {{25, 0}, {24, 7}, {20, 15}, {15, 20}, {7, 24}};
  Scene s;
  std::vector<Vec2> loop;
  if (below(2) == 0) {
    for (const Vec2& p : quarter) loop.push_back(p);
    for (int turn = 0; turn < 3; ++turn) {
      for (int i = 0; i < 5; ++i) {
        const Vec2 p = loop[loop.size() - 5];
        loop.push_back({-p.y, p.x});
      }
    }
  } else {
    loop = ring({0, 0}, 1.0, 1.0, 6 + below(20));
  }
  std::vector<Vec2> kept;
  for (const Vec2& p : loop) {
    if (below(4) != 0) kept.push_back(p);
  }
  if (kept.size() < 3) kept = loop;
  add_loop(&s, kept);
  for (uint32_t k = below(3); k > 0; --k) {
    s.lines.push_back(below(static_cast<uint32_t>(kept.size())));
    s.lines.push_back(below(static_cast<uint32_t>(kept.size())));
  }
  if (below(2) == 0) s.points.push_back({0.0, 0.0});
  s.spacing = kept[0].x * kept[0].x + kept[0].y * kept[0].y > 100.0 ? 5.0 + 100.0 * below(2) : 0.5;
  return s;
}

double nudge(double x) {
  uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  bits += below(5);
  bits -= 2;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

// A grid scene or a thin strip along a slanted line, with coordinates a few ulps off.
Scene ulp_scene() {
  Scene s;
  if (below(2) == 0) {
    s = grid_scene();
    for (Vec2& p : s.points) {
      p = {nudge(0.1 * p.x + 1.0), nudge(0.1 * p.y + 1.0)};
    }
    s.spacing = 0.3;
    return s;
  }
  std::vector<Vec2> loop;
  const uint32_t count = 3 + below(8);
  const Vec2 along = {1.0 / 3.0, 1.0 / 7.0};
  for (uint32_t i = 0; i < count; ++i) {
    const double t = 1.0 + i;
    loop.push_back({nudge(t * along.x), nudge(t * along.y)});
  }
  for (uint32_t i = count; i-- > 0;) {
    const double t = 1.0 + i;
    const double width = below(2) == 0 ? 1e-15 : 1e-9;
    loop.push_back({nudge(t * along.x - width), nudge(t * along.y + width)});
  }
  add_loop(&s, loop);
  s.spacing = 0.5;
  return s;
}

}  // namespace

int main(int argc, char** argv) {
  const unsigned long random = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 20000;
  const unsigned long adversarial = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 10000;
  engine.seed(argc > 3 ? static_cast<uint32_t>(std::strtoul(argv[3], nullptr, 10)) : 1);
  const struct {
    const char* name;
    Scene (*make)();
    unsigned long count;
  } kinds[] = {{"random", random_scene, random},
               {"grid", grid_scene, adversarial / 4},
               {"nested and touching", nested_scene, adversarial / 4},
               {"cocircular", cocircular_scene, adversarial / 4},
               {"ulps apart", ulp_scene, adversarial - 3 * (adversarial / 4)}};
  for (const auto& kind : kinds) {
    Counts counts;
    for (unsigned long i = 0; i < kind.count; ++i) run(kind.make(), i, &counts);
    std::printf("%-20s %8lu meshed, %8lu refused, %lu triangles\n", kind.name, counts.meshed,
                counts.refused, counts.triangles);
    if (kind.count >= 1000 && (counts.meshed < kind.count / 20 || counts.refused == 0)) {
      std::printf("  too few of one sort: the scenes prove nothing\n");
      if (counts.meshed < kind.count / 20) return 1;
    }
  }
  return 0;
}
