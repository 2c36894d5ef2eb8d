#include "network/enclosure.h"

#include "base/search.h"
#include "base/sort.h"

namespace wireskin::network {

namespace {

// The border of a patch seen in its plane.
struct Outline {
  const Border& border;
  Plane plane;
  Array<Vec2> point;
  double highest = 0.0, widest = 0.0;
  double size = 0.0;  // the square root of the area

  explicit Outline(const Border& of) : border(of), point(of.vertex.context()) {}
};

}  // namespace

static uint32_t root_of_component(Span<uint32_t> parent, uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

static void join_along(const Network& network, const CurveVertices& vertices, uint32_t s,
                       Span<uint32_t> parent) {
  for (uint32_t k = 0; k < vertices.edges[s]; ++k) {
    const uint32_t a = root_of_component(parent, segment_vertex(network, vertices, s, k));
    const uint32_t b = root_of_component(parent, segment_vertex(network, vertices, s, k + 1));
    (a < b ? parent[b] : parent[a]) = a < b ? a : b;
  }
}

Status find_components(const Network& network, const CurveVertices& vertices,
                       Components* components) {
  const uint32_t n = static_cast<uint32_t>(vertices.position.size());
  Array<uint32_t>& of = components->of_vertex;
  TRY(of.resize(n));
  for (uint32_t v = 0; v < n; ++v) of[v] = v;
  for (uint32_t s = 0; s < network.segment.size(); ++s) {
    join_along(network, vertices, s, of.span());
  }
  uint32_t count = 0;  // roots are the least of their members, so they are numbered before these
  for (uint32_t v = 0; v < n; ++v) of[v] = of[v] == v ? count++ : of[of[v]];
  Array<uint32_t>& start = components->members.start;
  TRY(start.assign(size_t{count} + 1, 0));
  TRY(components->members.item.resize(n));
  for (uint32_t v = 0; v < n; ++v) ++start[of[v]];
  starts_from_counts(start.span());
  for (uint32_t v = 0; v < n; ++v) components->members.item[start[of[v]]++] = v;
  shift_starts_back(start.span());
  TRY(components->bounds.assign(count, 0));
  for (uint32_t h : network.loop.item) {
    components->bounds[of[segment_vertex(network, vertices, h / 2, 0)]] = 1;
  }
  return {};
}

// Whether a ray from p to the right crosses the outline an odd number of times.
static bool inside(const Outline& outline, const Vec2& p) {
  bool odd = false;
  for (uint32_t l = 0; l < outline.border.loops(); ++l) {
    for (uint32_t i = outline.border.start[l]; i < outline.border.start[l + 1]; ++i) {
      const Vec2 &a = outline.point[i], &b = outline.point[next_on_border(outline.border, l, i)];
      if ((a.y > p.y) == (b.y > p.y)) continue;
      if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
    }
  }
  return odd;
}

static Status draw_outline(Outline* outline) {
  const Border& border = outline->border;
  TRY(outline->point.resize(border.size()));
  for (uint32_t i = 0; i < border.size(); ++i) {
    const double height = std::fabs(outline->plane.height(border.position[i]));
    outline->point[i] = outline->plane.project(border.position[i]);
    if (height > outline->highest) outline->highest = height;
    if (length(outline->point[i]) > outline->widest) outline->widest = length(outline->point[i]);
  }
  outline->size = std::sqrt(0.5 * std::fabs(dot(vector_area(border), outline->plane.normal)));
  return {};
}

static void enclose(const CurveVertices& vertices, const Components& components, uint32_t c,
                    const Outline& outline, uint32_t patch, Enclosing* best) {
  constexpr double k_share_of_width = 0.1, k_share_for_pieces = 0.5, k_weight_of_height = 4.0;
  const double share = components.bounds[c] ? k_share_of_width : k_share_for_pieces;
  const double reach = outline.highest + share * outline.widest;
  double excess = 0.0, known = 0.0;
  Vec3 normal;
  for (uint32_t v : components.members[c]) {
    const Vec3& p = vertices.position[v];
    const Vec2 q = outline.plane.project(p);
    const double height = std::fabs(outline.plane.height(p));
    if (!(length(q) <= outline.widest && height <= reach && inside(outline, q))) return;
    if (height - outline.highest > excess) excess = height - outline.highest;
    normal += vertices.normal[v];
    known += vertices.normal[v] != Vec3{} ? 1.0 : 0.0;
  }
  if (!components.bounds[c] && dot(normal, outline.plane.normal) < 0.0) return;
  const double score = outline.size + k_weight_of_height * excess;
  if (best->patch != k_none && !(score < best->score)) return;
  const double facing = known > 0.0 ? dot(normal, outline.plane.normal) / known : 1.0;
  *best = {patch, score, outline.plane.normal, facing};
}

Status find_enclosing(const Network& network, const CurveVertices& vertices,
                      const Components& components, Array<Enclosing>* enclosing) {
  Context& context = enclosing->context();
  const uint32_t count = components.members.count();
  TRY(enclosing->assign(count, Enclosing{}));
  Array<uint32_t> order(context);
  Border border(context);
  TRY(order.resize(count));
  for (uint32_t c = 0; c < count; ++c) order[c] = c;
  const auto place = [&](uint32_t c) { return vertices.position[components.members[c][0]].x; };
  sort(order.span(),
       [&](uint32_t a, uint32_t b) { return place(a) != place(b) ? place(a) < place(b) : a < b; });
  for (uint32_t p = 0; count > 1 && p < network.patches(); ++p) {
    TRY(border_of_patch(network, vertices, p, &border));
    Outline outline(border);
    if (!fit_plane(border, &outline.plane).ok()) continue;
    // What runs clockwise is the outside of its loop.
    const bool clockwise = dot(vector_area(border), outline.plane.normal) < 0.0;
    if (clockwise && !network.ring[p]) continue;
    TRY(draw_outline(&outline));
    const double reach = 2.0 * outline.widest + outline.highest;
    const double middle = outline.plane.origin.x;
    size_t i = first_failing(size_t{0}, size_t{count},
                             [&](size_t k) { return place(order[k]) < middle - reach; });
    const uint32_t own = components.of_vertex[border.vertex[0]];
    for (; i < count && place(order[i]) <= middle + reach; ++i) {
      const uint32_t c = order[i];
      if (c != own) enclose(vertices, components, c, outline, p, &(*enclosing)[c]);
    }
    TRY(context.checkpoint());
  }
  return {};
}

}  // namespace wireskin::network
