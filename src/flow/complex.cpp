#include "flow/complex.h"

#include "base/search.h"
#include "flow/delaunay.h"
#include "flow/gabriel.h"
#include "flow/jitter.h"
#include "num/minmax.h"

namespace wireskin::flow {

static constexpr double k_infinity = HUGE_VAL;

static constexpr uint32_t k_per_checkpoint = 1u << 15;
static constexpr uint32_t k_values_per_checkpoint = 1u << 12;  // each may take a microsecond

// The corners of the face opposite to each corner, counter-clockwise seen from outside.
static constexpr uint32_t k_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

double Complex::tet_value_of(uint32_t t) const {
  return t == k_none ? k_infinity : tet_value[t];
}

uint32_t find_edge(const Complex& complex, uint32_t u, uint32_t v) {
  if (v < u) {
    const uint32_t kept = u;
    u = v;
    v = kept;
  }
  const uint32_t end = complex.edge_first[u + 1];
  const uint32_t e = first_failing(complex.edge_first[u], end,
                                   [&](uint32_t i) { return complex.edge[2 * i + 1] < v; });
  return e < end && complex.edge[2 * e + 1] == v ? e : k_none;
}

Vec3 cross_of_triangle(const Complex& complex, uint32_t t) {
  const uint32_t* const v = &complex.triangle[3 * size_t{t}];
  const Vec3& a = complex.point[v[0]];
  return cross(complex.point[v[1]] - a, complex.point[v[2]] - a);
}

static Status take_tets(Context& context, const Delaunay& delaunay, Complex* complex) {
  const size_t count = delaunay.tets.size();
  TRY(complex->tet.resize(4 * count));
  TRY(complex->tet_neighbour.resize(4 * count));
  TRY(complex->tet_triangle.resize(4 * count));
  TRY(complex->tet_value.resize(count));
  for (size_t t = 0; t < count; ++t) {
    if (t % k_per_checkpoint == 0) TRY(context.checkpoint());
    const Tetrahedron& tet = delaunay.tets[t];
    for (size_t i = 0; i < 4; ++i) {
      complex->tet[4 * t + i] = tet.vertex[i];
      complex->tet_neighbour[4 * t + i] = tet.across[i] == k_none ? k_none : tet.across[i] >> 2;
    }
  }
  return {};
}

// Each face once, from the lesser of its tetrahedra.
static Status make_triangles(Context& context, const Delaunay& delaunay, Complex* complex) {
  const uint32_t tet_count = static_cast<uint32_t>(delaunay.tets.size());
  size_t count = 0;
  for (uint32_t t = 0; t < tet_count; ++t) {
    if (t % k_per_checkpoint == 0) TRY(context.checkpoint());
    for (const uint32_t across : delaunay.tets[t].across) count += across > 4 * t ? 1 : 0;
  }
  TRY(complex->triangle.resize(3 * count));
  TRY(complex->triangle_side.resize(2 * count));
  uint32_t next = 0;
  for (uint32_t t = 0; t < tet_count; ++t) {
    if (t % k_per_checkpoint == 0) TRY(context.checkpoint());
    const Tetrahedron& tet = delaunay.tets[t];
    for (uint32_t i = 0; i < 4; ++i) {
      const uint32_t across = tet.across[i];
      if (across < 4 * t) continue;
      for (uint32_t k = 0; k < 3; ++k) complex->triangle[3 * next + k] = tet.vertex[k_face[i][k]];
      complex->triangle_side[2 * next] = t;
      complex->triangle_side[2 * next + 1] = across == k_none ? k_none : across >> 2;
      complex->tet_triangle[4 * t + i] = next;
      if (across != k_none) complex->tet_triangle[across] = next;
      ++next;
    }
  }
  return {};
}

// One side of a triangle, on its way to becoming an edge.
struct EdgeUse {
  uint32_t low, high;
  uint32_t side;  // 3 * triangle + number of the opposite vertex
};

// A stable counting sort of `from` into `to`; afterwards first[v + 1] is the end of group v.
template <typename Key>
static Status sort_uses(Context& context, Span<const EdgeUse> from, const Key& key,
                        Span<uint32_t> first, Span<EdgeUse> to) {
  for (uint32_t& f : first) f = 0;
  for (size_t i = 0; i < from.size(); ++i) {
    if (i % k_per_checkpoint == 0) TRY(context.checkpoint());
    ++first[key(from[i])];
  }
  starts_from_counts(first);
  for (size_t i = 0; i < from.size(); ++i) {
    if (i % k_per_checkpoint == 0) TRY(context.checkpoint());
    to[first[key(from[i])]++] = from[i];
  }
  return {};
}

// All sides of triangles sorted by their ends: equal ones become an edge.
static Status make_edges(Context& context, Complex* complex) {
  const uint32_t side_count = static_cast<uint32_t>(complex->triangle.size());
  const uint32_t vertex_count = static_cast<uint32_t>(complex->point.size());
  Array<EdgeUse> uses(context), sorted(context);
  TRY(uses.resize(side_count));
  TRY(sorted.resize(side_count));
  TRY(complex->edge_first.resize(vertex_count + 1));
  TRY(complex->triangle_edge.resize(side_count));
  TRY(complex->edge_triangle.resize(side_count));
  for (uint32_t side = 0; side < side_count; ++side) {
    if (side % k_per_checkpoint == 0) TRY(context.checkpoint());
    const uint32_t* v = complex->triangle.data() + side / 3 * 3;
    const uint32_t a = v[(side + 1) % 3];
    const uint32_t b = v[(side + 2) % 3];
    uses[side] = {a < b ? a : b, a < b ? b : a, side};
  }
  const Span<uint32_t> first = complex->edge_first.span();
  const auto low_end = [](const EdgeUse& use) { return use.low; };
  const auto high_end = [](const EdgeUse& use) { return use.high; };
  TRY(sort_uses(context, uses.span(), high_end, first, sorted.span()));
  TRY(sort_uses(context, sorted.span(), low_end, first, uses.span()));
  TRY(context.checkpoint());
  uint32_t count = 0;
  const auto is_new = [&uses](uint32_t i) {
    return i == 0 || uses[i].low != uses[i - 1].low || uses[i].high != uses[i - 1].high;
  };
  for (uint32_t i = 0; i < side_count; ++i) {
    if (i % k_per_checkpoint == 0) TRY(context.checkpoint());
    count += is_new(i) ? 1 : 0;
  }
  TRY(complex->edge.resize(2 * static_cast<size_t>(count)));
  TRY(complex->edge_triangle_first.resize(count + 1));
  for (uint32_t& f : complex->edge_first) f = 0;
  uint32_t next = 0;
  for (uint32_t i = 0; i < side_count; ++i) {
    if (i % k_per_checkpoint == 0) TRY(context.checkpoint());
    if (is_new(i)) {
      complex->edge[2 * next] = uses[i].low;
      complex->edge[2 * next + 1] = uses[i].high;
      ++complex->edge_first[uses[i].low];
      complex->edge_triangle_first[next++] = i;
    }
    complex->triangle_edge[uses[i].side] = next - 1;
    complex->edge_triangle[i] = uses[i].side / 3;
  }
  complex->edge_triangle_first[count] = side_count;
  starts_from_counts(complex->edge_first.span());
  return {};
}

// Squared radius of the circumscribed ball; infinite where the tetrahedron is flat to rounding. No
// rounding error may make it less than what an edge allows.
static double squared_circumradius(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = d - a;
  const Vec3 vw = cross(v, w);
  const double uu = dot(u, u);
  const double vv = dot(v, v);
  const double ww = dot(w, w);
  const double det = dot(u, vw);
  const Vec3 sum = uu * vw + vv * cross(w, u) + ww * cross(u, v);
  const double squared = dot(sum, sum) / (4.0 * det * det);
  if (!(squared < k_infinity)) return k_infinity;
  return larger(squared, 0.25 * larger(uu, larger(vv, ww)));
}

// The centre of the smallest circumscribed ball of a triangle, from corner a.
static Vec3 centre_from_corner(const Vec3& u, const Vec3& v) {
  const Vec3 n = cross(u, v);
  const Vec3 sum = dot(v, v) * cross(n, u) + dot(u, u) * cross(v, n);
  return (0.5 / dot(n, n)) * sum;
}

static void value_triangle(Complex* complex, uint32_t t) {
  const uint32_t* v = complex->triangle.data() + 3 * static_cast<size_t>(t);
  const Vec3& a = complex->point[v[0]];
  const Vec3& b = complex->point[v[1]];
  const Vec3& c = complex->point[v[2]];
  const Vec3 u = b - a;
  const Vec3 w = c - a;
  const Vec3 centre = centre_from_corner(u, w);
  double value = dot(centre, centre);
  bool gabriel = value < k_infinity;  // false for a triangle that is a line to rounding
  double least = k_infinity;
  for (uint32_t k = 0; k < 2; ++k) {
    const uint32_t side = complex->triangle_side[2 * t + k];
    if (side == k_none) continue;
    least = smaller(least, complex->tet_value[side]);
    uint32_t i = 0;
    while (complex->tet_triangle[4 * side + i] != t) ++i;
    const Vec3& opposite = complex->point[complex->tet[4 * side + i]];
    if (inside_triangle_ball(a, b, c, opposite)) gabriel = false;
  }
  value = gabriel ? larger(value, 0.25 * larger(dot(u, u), dot(w, w))) : k_infinity;
  complex->triangle_gabriel[t] = gabriel ? 1 : 0;
  complex->triangle_value[t] = smaller(value, least);
}

static void value_edge(Complex* complex, uint32_t e) {
  const uint32_t u = complex->edge[2 * e];
  const uint32_t v = complex->edge[2 * e + 1];
  const Vec3& a = complex->point[u];
  const Vec3& b = complex->point[v];
  bool gabriel = true;
  double least = k_infinity;
  for (const uint32_t t : complex->triangles_of(e)) {
    least = smaller(least, complex->triangle_value[t]);
    const uint32_t* w = complex->triangle.data() + 3 * static_cast<size_t>(t);
    const uint32_t third = w[0] != u && w[0] != v ? w[0] : w[1] != u && w[1] != v ? w[1] : w[2];
    const Vec3& p = complex->point[third];
    if (inside_edge_ball(a, b, p)) gabriel = false;
  }
  const double own = gabriel ? 0.25 * dot(b - a, b - a) : k_infinity;
  complex->edge_gabriel[e] = gabriel ? 1 : 0;
  complex->edge_value[e] = smaller(own, least);
}

static Status set_values(Context& context, Complex* complex) {
  const uint32_t triangles = static_cast<uint32_t>(complex->triangle.size() / 3);
  const uint32_t edges = static_cast<uint32_t>(complex->edge.size() / 2);
  TRY(complex->triangle_value.resize(triangles));
  TRY(complex->triangle_gabriel.resize(triangles));
  TRY(complex->edge_value.resize(edges));
  TRY(complex->edge_gabriel.resize(edges));
  for (uint32_t t = 0; t < complex->tet_count(); ++t) {
    if (t % k_values_per_checkpoint == 0) TRY(context.checkpoint());
    const uint32_t* v = complex->tet.data() + 4 * static_cast<size_t>(t);
    complex->tet_value[t] = squared_circumradius(complex->point[v[0]], complex->point[v[1]],
                                                 complex->point[v[2]], complex->point[v[3]]);
  }
  for (uint32_t t = 0; t < triangles; ++t) {
    if (t % k_values_per_checkpoint == 0) TRY(context.checkpoint());
    value_triangle(complex, t);
  }
  for (uint32_t e = 0; e < edges; ++e) {
    if (e % k_values_per_checkpoint == 0) TRY(context.checkpoint());
    value_edge(complex, e);
  }
  return {};
}

// The complex of two or three places, which has no tetrahedra.
static Status make_few(Context& context, const Delaunay& delaunay, Complex* complex) {
  uint32_t place[3] = {k_none, k_none, k_none};
  uint32_t count = 0;
  for (uint32_t i = 0; i < delaunay.same_as.size(); ++i) {
    if (delaunay.same_as[i] == i) place[count++] = i;
  }
  if (count == 3) {
    TRY(complex->triangle.resize(3));
    TRY(complex->triangle_side.assign(2, k_none));
    for (uint32_t k = 0; k < 3; ++k) complex->triangle[k] = place[k];
  }
  TRY(make_edges(context, complex));
  if (count != 2) return {};
  TRY(complex->edge.push(place[0]));
  TRY(complex->edge.push(place[1]));
  TRY(complex->edge_triangle_first.push(0));
  for (uint32_t v = place[0] + 1; v < complex->edge_first.size(); ++v) complex->edge_first[v] = 1;
  return {};
}

Status build_complex(Context& context, Span<const Vec3> points, const ComplexOptions& options,
                     Complex* complex) {
  *complex = Complex(context);
  complex->diagonal = box_diagonal(points);
  TRY(complex->point.resize(points.size()));
  jitter_points(points, options.jitter, options.seed, complex->point.span());
  Delaunay delaunay(context);
  TRY(triangulate(context, complex->point.span(), options.most_tets, &delaunay));
  if (delaunay.dimension == 3) {
    TRY(take_tets(context, delaunay, complex));
    TRY(make_triangles(context, delaunay, complex));
    delaunay.tets.free();
    TRY(make_edges(context, complex));
  } else {
    if (delaunay.places > 3) return fail(Code::bad_argument, "the points span no volume");
    TRY(make_few(context, delaunay, complex));
  }
  complex->same_as = static_cast<Array<uint32_t>&&>(delaunay.same_as);
  return set_values(context, complex);
}

}  // namespace wireskin::flow
