#include "network/patch_mesh.h"

#include "base/in_parts.h"
#include "base/search.h"
#include "base/sort.h"
#include "mesh/check.h"
#include "mesh/inlay.h"
#include "network/border_check.h"
#include "network/patch_in_space.h"
#include "network/plane.h"
#include "network/size_limit.h"
#include "num/minmax.h"
#include "num/predicates.h"
#include "planar/polygon_mesh.h"

namespace wireskin::network {

static constexpr size_t k_triangles_per_checkpoint = 8192;

namespace {

// An edge inside a patch between two curve vertices, a < b; or with patch k_none an edge of a
// curve.
struct Chord {
  uint32_t a, b;
  uint32_t patch;
};

// The corners of a triangle, in space or in its patch's plane (z = 0; the same vertex then has
// another place in each patch).
struct TriangleCorners {
  uint32_t triangle;
  Vec3 at[3];
};

// What is gathered over all patches; `cornered`: the triangles that have chords, ascending.
struct Builder {
  PatchMesh* mesh;
  Array<TriangleCorners> cornered;
  Array<Chord> chord;
  Array<uint32_t> patch_start;  // first triangle of each patch, before chords are split
  Array<uint8_t> raised;        // of each patch

  explicit Builder(Context& context, PatchMesh* result)
      : mesh(result), cornered(context), chord(context), patch_start(context), raised(context) {}
};

// Memory for one patch, reused: the border, the vertices of the patch that are on curves (those of
// the loops, then inner ones), the mesh either way, and what both come to: triangles over these
// vertices and free ones behind them, the corners' places for the metric, and where the free
// vertices may start in space.
struct PatchScratch {
  Border border;
  Array<uint32_t> local;         // of each curve vertex, k_none between patches
  Array<uint32_t> vertex;        // of each local one the curve vertex
  Array<uint32_t> loop;          // local, in the order of the border
  Array<uint32_t> inner_edge;    // two local ones each
  Array<Chord> curve_edge;       // local, a < b, sorted: loops' and inner edges
  uint32_t isolated = 0;         // so many of the last local vertices are points
  Array<Vec3> position, normal;  // of the local vertices
  Array<Vec2> flat;
  planar::PolygonMesh planar;
  SpaceMesh spatial;
  Array<Vec3> place;
  Array<Vec3> inner;

  explicit PatchScratch(Context& context)
      : border(context),
        local(context),
        vertex(context),
        loop(context),
        inner_edge(context),
        curve_edge(context),
        position(context),
        normal(context),
        flat(context),
        planar(context),
        spatial(context),
        place(context),
        inner(context) {}
};

}  // namespace

static bool may_be_left_out(const Status& status) {
  return status.code == Code::patch_without_plane || status.code == Code::patch_folded ||
         status.code == Code::patch_several_loops;
}

// Adds the place to what went wrong with a patch: its number and a curve of its border.
static Status at_patch(Status status, const Network& network, uint32_t patch) {
  if (!may_be_left_out(status) && status.code != Code::too_large) return status;
  status.place.patch = patch;
  if (status.place.curve == k_none) {
    status.place.curve = network.segment[network.cycle(patch)[0] / 2].curve;
  }
  return status;
}

static bool before(const Chord& x, const Chord& y) {
  if (x.a != y.a) return x.a < y.a;
  return x.b != y.b ? x.b < y.b : x.patch < y.patch;
}

static Status add_vertex(uint32_t v, const CurveVertices& vertices, const Vec3& normal,
                         PatchScratch* scratch, uint32_t* local) {
  if (scratch->local[v] == k_none) {
    scratch->local[v] = static_cast<uint32_t>(scratch->vertex.size());
    TRY(scratch->vertex.push(v));
    TRY(scratch->position.push(vertices.position[v]));
    TRY(scratch->normal.push(normal));
  }
  *local = scratch->local[v];
  return {};
}

static Status add_edge(uint32_t a, uint32_t b, PatchScratch* scratch) {
  return scratch->curve_edge.push(a < b ? Chord{a, b, k_none} : Chord{b, a, k_none});
}

// Numbers the curve vertices of a patch and lists its edges.
static Status take_domain(const Network& network, const CurveVertices& vertices, uint32_t patch,
                          PatchScratch* scratch) {
  TRY(border_of_patch(network, vertices, patch, &scratch->border));
  const Border& border = scratch->border;
  for (uint32_t v : scratch->vertex) scratch->local[v] = k_none;
  scratch->vertex.clear();
  scratch->position.clear();
  scratch->normal.clear();
  scratch->inner_edge.clear();
  scratch->curve_edge.clear();
  TRY(scratch->loop.resize(border.size()));
  for (uint32_t i = 0; i < border.size(); ++i) {
    TRY(add_vertex(border.vertex[i], vertices, border.normal[i], scratch, &scratch->loop[i]));
  }
  for (uint32_t l = 0; l < border.loops(); ++l) {
    for (uint32_t i = border.start[l]; i < border.start[l + 1]; ++i) {
      TRY(add_edge(scratch->loop[i], scratch->loop[next_on_border(border, l, i)], scratch));
    }
  }
  for (uint32_t s : network.inner[patch]) {
    uint32_t last = k_none, local = k_none;
    for (uint32_t k = 0; k <= vertices.edges[s]; ++k, last = local) {
      const uint32_t v = segment_vertex(network, vertices, s, k);
      TRY(add_vertex(v, vertices, vertices.normal[v], scratch, &local));
      if (k == 0) continue;
      TRY(scratch->inner_edge.push(last));
      TRY(scratch->inner_edge.push(local));
      TRY(add_edge(last, local, scratch));
    }
  }
  scratch->isolated = static_cast<uint32_t>(network.point[patch].size());
  for (uint32_t v : network.point[patch]) {
    uint32_t local = k_none;
    TRY(add_vertex(v, vertices, vertices.normal[v], scratch, &local));
  }
  sort(scratch->curve_edge.span(), before);
  return {};
}

static bool find_edge(Span<const Chord> sorted, uint32_t a, uint32_t b) {
  const Chord edge = {a, b, k_none};
  const size_t i =
      first_failing(size_t{0}, sorted.size(), [&](size_t k) { return before(sorted[k], edge); });
  return i < sorted.size() && sorted[i].a == a && sorted[i].b == b;
}

static bool is_curve_edge(const PatchScratch& scratch, uint32_t a, uint32_t b) {
  return find_edge(scratch.curve_edge.span(), a < b ? a : b, a < b ? b : a);
}

// Notes the chords of triangle `t`, whose vertices among the patch's are `corner`, and its corners
// if it has any.
static Status note_chords(const PatchScratch& scratch, const uint32_t* corner, uint32_t t,
                          uint32_t patch, Builder* builder) {
  bool any = false;
  const uint32_t n = static_cast<uint32_t>(scratch.vertex.size());
  for (int k = 0; k < 3; ++k) {
    const uint32_t a = corner[k], b = corner[(k + 1) % 3];
    if (a >= n || b >= n || is_curve_edge(scratch, a, b)) continue;
    any = true;
    // Each edge inside is met once in each direction; the ascending one is noted.
    const uint32_t from = scratch.vertex[a], to = scratch.vertex[b];
    if (from < to) TRY(builder->chord.push({from, to, patch}));
  }
  if (!any) return {};
  const Span<const Vec3> place = scratch.place.span();
  return builder->cornered.push({t, {place[corner[0]], place[corner[1]], place[corner[2]]}});
}

static Status append_patch(const PatchScratch& scratch, Span<const uint32_t> triangle,
                           uint32_t patch, Builder* builder) {
  PatchMesh* mesh = builder->mesh;
  const uint32_t n = static_cast<uint32_t>(scratch.vertex.size());
  const size_t first = mesh->patch.size(), more = triangle.size() / 3;
  TRY(make_room_in_parts(triangle.size(), &mesh->triangle));
  TRY(make_room_in_parts(more, &mesh->patch));
  TRY(make_room_in_parts(more, &mesh->shape));
  TRY(make_room_in_parts(scratch.inner.size(), &mesh->start));
  TRY(make_room_in_parts(scratch.inner.size(), &mesh->placed));
  for (size_t t = 0; t < more; ++t) {
    const uint32_t* corner = &triangle[3 * t];
    const auto global = [&](uint32_t v) {
      return v < n ? scratch.vertex[v] : mesh->vertices + (v - n);
    };
    for (int k = 0; k < 3; ++k) mesh->triangle.push_reserved(global(corner[k]));
    mesh->patch.push_reserved(patch);
    mesh->shape.push_reserved(mesh::triangle_shape(
        scratch.place[corner[0]], scratch.place[corner[1]], scratch.place[corner[2]]));
    TRY(note_chords(scratch, corner, static_cast<uint32_t>(first + t), patch, builder));
    if (t % k_triangles_per_checkpoint == k_triangles_per_checkpoint - 1)
      TRY(mesh->patch.context().checkpoint());
  }
  TRY(in_parts(mesh->patch.context(), scratch.inner.size(), [&](size_t i) {
    mesh->start.push_reserved(scratch.inner[i]);
    mesh->placed.push_reserved(scratch.spatial.raised);
  }));
  const uint64_t vertices = uint64_t{mesh->vertices} + scratch.inner.size();
  if (vertices > 0x7fffffff || mesh->triangle.size() > 0x7fffffff) {
    return fail(Code::too_large, "the spacing is too small for the network");
  }
  mesh->vertices = static_cast<uint32_t>(vertices);
  return {};
}

// Whether the triangles lie on the left of every edge of the loops: holes run clockwise, the outer
// loop does not.
static bool on_the_left(const PatchScratch& scratch, Array<Chord>* directed) {
  sort(directed->span(), before);
  for (size_t h = 0; h < scratch.planar.triangles.size(); ++h) {
    const uint32_t a = scratch.planar.triangles[h];
    const uint32_t b = scratch.planar.triangles[mesh::next_half_edge(static_cast<uint32_t>(h))];
    if (find_edge(directed->span(), b, a)) return false;
  }
  return true;
}

// Loops that all are outer ones, beside each other, bound several discs in the plane and not the
// patch.
static uint32_t outer_loops(const PatchScratch& scratch) {
  const Border& border = scratch.border;
  uint32_t count = 0;
  for (uint32_t l = 0; l < border.loops(); ++l) {
    const Vec2 base = scratch.flat[scratch.loop[border.start[l]]];
    double area = 0.0;
    for (uint32_t i = border.start[l]; i < border.start[l + 1]; ++i) {
      const Vec2 a = scratch.flat[scratch.loop[i]] - base;
      const Vec2 b = scratch.flat[scratch.loop[next_on_border(border, l, i)]] - base;
      area += a.x * b.y - a.y * b.x;
    }
    count += area > 0.0;
  }
  return count;
}

static Status mesh_flat(double spacing, PatchScratch* scratch) {
  Context& context = scratch->vertex.context();
  const Border& border = scratch->border;
  round_to_grid(scratch->flat.span(), &spacing);
  if (border.loops() == 1 && border.size() == scratch->vertex.size()) {
    return planar::mesh_polygon(context, scratch->flat.span(), spacing, &scratch->planar);
  }
  if (outer_loops(*scratch) > 1) {
    return fail(Code::patch_without_plane, "the plane shows the loops beside each other");
  }
  Array<uint32_t> edges(context);
  Array<Chord> directed(context);
  for (uint32_t l = 0; l < border.loops(); ++l) {
    for (uint32_t i = border.start[l]; i < border.start[l + 1]; ++i) {
      const uint32_t a = scratch->loop[i], b = scratch->loop[next_on_border(border, l, i)];
      TRY(edges.push(a));
      TRY(edges.push(b));
      TRY(directed.push({a, b, k_none}));
    }
  }
  const planar::Region region = {scratch->flat.span(), edges.span(), scratch->inner_edge.span(),
                                 false};
  Status status = planar::mesh_region(context, region, spacing, &scratch->planar);
  const bool outside = status.code == Code::bad_argument || status.code == Code::open_network;
  if (outside) status = fail(Code::patch_folded, "a curve inside the patch leaves it");
  status.place = {};  // its vertices are ours
  TRY(status);
  if (!on_the_left(*scratch, &directed)) {
    return fail(Code::patch_without_plane, "a loop of the patch runs the wrong way round");
  }
  return {};
}

// `least_facing` as in mesh_patches.
static Status mesh_in_plane(const Plane& plane, double spacing, double least_facing,
                            PatchScratch* scratch) {
  const size_t n = scratch->vertex.size();
  TRY(scratch->flat.resize(n));
  double facing = 0.0;
  size_t known = 0;
  for (size_t i = 0; i < n; ++i) scratch->flat[i] = plane.project(scratch->position[i]);
  for (const Vec3& normal : scratch->border.normal) {
    facing += dot(normal, plane.normal);
    known += normal != Vec3{};
  }
  if (known > 0 && facing < least_facing * static_cast<double>(known)) {
    return fail(Code::patch_without_plane, "the plane of the patch sees too much of it edge-on");
  }
  TRY(mesh_flat(spacing, scratch));
  const Array<Vec2>& points = scratch->planar.points;
  TRY(scratch->place.resize(points.size()));
  TRY(scratch->inner.resize(points.size() - n));
  return in_parts(scratch->place.context(), points.size(), [&](size_t i) {
    scratch->place[i] = {points[i].x, points[i].y, 0.0};
    if (i >= n) scratch->inner[i - n] = plane.lift(points[i]);
  });
}

// Lets the mesh in space pass through the curves and points inside the patch.
static Status inlay_patch(double spacing, PatchScratch* scratch) {
  Context& context = scratch->vertex.context();
  const Border& border = scratch->border;
  const uint32_t rim = border.size(), n = static_cast<uint32_t>(scratch->vertex.size());
  Array<Chord> lines(context);
  Array<uint32_t> edges(context);
  for (size_t e = 0; e < scratch->inner_edge.size(); e += 2) {
    const uint32_t a = scratch->inner_edge[e], b = scratch->inner_edge[e + 1];
    TRY(lines.push(a < b ? Chord{a, b, k_none} : Chord{b, a, k_none}));
  }
  sort(lines.span(), before);
  for (const Chord& line : lines) {
    TRY(edges.push(line.a));
    TRY(edges.push(line.b));
  }
  const mesh::Inlay inlay = {scratch->position.span().part(rim, n - rim), edges.span()};
  TRY(mesh::inlay_curves(context, border.start.span(), inlay, spacing, &scratch->spatial.position,
                         &scratch->spatial.triangle));
  if (has_needles(scratch->spatial)) {
    return fail(Code::patch_folded, "curves inside the patch lie too near each other");
  }
  if (!scratch->spatial.raised || scratch->spatial.band) return {};
  return raise_again(border, {n, edges.span()}, spacing, &scratch->spatial);
}

// Names the curve of the local vertex that a failure speaks of.
static Status at_local_vertex(Status status, const CurveVertices& vertices,
                              const PatchScratch& scratch) {
  const uint32_t v = status.place.vertex;
  status.place.vertex = k_none;
  if (v < scratch.vertex.size()) status.place.curve = vertices.curve[scratch.vertex[v]];
  return status;
}

static Status mesh_in_space(const CurveVertices& vertices, double spacing, PatchScratch* scratch) {
  const Border& border = scratch->border;
  const uint32_t n = static_cast<uint32_t>(scratch->vertex.size()), rim = border.size();
  for (uint32_t i = 0; i < rim; ++i) {
    if (scratch->loop[i] == i) continue;
    return fail(Code::patch_folded,
                "no plane shows the patch without folds, and its border passes a point twice");
  }
  TRY(mesh_border_in_space(border, spacing, &scratch->spatial));
  // A curve of a single edge from loop to loop brings no vertex.
  if (n != rim || !scratch->inner_edge.empty()) {
    TRY(at_local_vertex(inlay_patch(spacing, scratch), vertices, *scratch));
  }
  TRY(scratch->place.copy(scratch->spatial.position.span()));
  return scratch->inner.copy(scratch->place.span().part(n, scratch->place.size() - n));
}

#ifdef WIRESKIN_DEBUG
// In its plane the mesh is exact: no triangle is inverted.
static bool runs_counter_clockwise(const planar::PolygonMesh& mesh) {
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    if (!(orient2d(mesh.points[mesh.triangles[t]], mesh.points[mesh.triangles[t + 1]],
                   mesh.points[mesh.triangles[t + 2]]) > 0.0)) {
      return false;
    }
  }
  return true;
}
#endif

// `at`: the place of a vertex. The bound is that of every mesh, with room for splits of the chords.
template <typename At>
static Status check_areas(Context& context, Span<const uint32_t> triangle, const At& at) {
  constexpr double k_least_area = 16.0 * mesh::k_least_height;
  for (size_t t = 0; t < triangle.size(); t += 3) {
    const Vec3 a = at(triangle[t + 1]) - at(triangle[t]), b = at(triangle[t + 2]) - at(triangle[t]);
    const Vec3 c = b - a;
    const double longest2 = larger(dot(a, a), larger(dot(b, b), dot(c, c)));
    if (!(length(cross(a, b)) > k_least_area * longest2)) {
      return fail(Code::patch_folded, "the border of the patch encloses nothing");
    }
    if (t / 3 % k_triangles_per_checkpoint == k_triangles_per_checkpoint - 1) {
      TRY(context.checkpoint());
    }
  }
  return {};
}

static Status check_areas_in_space(const PatchScratch& scratch, Span<const uint32_t> triangle) {
  const size_t n = scratch.position.size();
  return check_areas(scratch.place.context(), triangle, [&](uint32_t v) {
    return v < n ? scratch.position[v] : scratch.inner[v - n];
  });
}

// Points in line within rounding have a triangle in the plane, where they are rounded again, and
// none in space; points above each other have one in space, and in the plane a needle, whose
// weights would drown those of all other triangles.
static Status check_areas_of_flat(const PatchScratch& scratch) {
  const Span<const uint32_t> triangle = scratch.planar.triangles.span();
  TRY(check_areas(scratch.place.context(), triangle, [&](uint32_t v) { return scratch.place[v]; }));
  return check_areas_in_space(scratch, triangle);
}

static bool may_be_meshed_otherwise(const Status& status) {
  return status.code == Code::patch_without_plane || status.code == Code::patch_folded;
}

static Status mesh_patch(const Network& network, const CurveVertices& vertices, double least_facing,
                         uint32_t patch, PatchScratch* scratch, Builder* builder) {
  TRY(take_domain(network, vertices, patch, scratch));
  const Border& border = scratch->border;
  const double spacing = border_length(border) / static_cast<double>(border.size());
  Plane plane;
  scratch->spatial.raised = false;
  Status status = fit_plane(border, &plane);
  if (status.ok()) status = mesh_in_plane(plane, spacing, least_facing, scratch);
  if (status.ok()) status = check_areas_of_flat(*scratch);
  if (status.ok()) {
    WIRESKIN_ASSERT(runs_counter_clockwise(scratch->planar));
    TRY(builder->mesh->way.push(PatchWay::plane));
    return append_patch(*scratch, scratch->planar.triangles.span(), patch, builder);
  }
  if (!may_be_meshed_otherwise(status)) return status;
  TRY(check_border(border));
  TRY(check_border_size(border, spacing));
  TRY(mesh_in_space(vertices, spacing, scratch));
  TRY(check_areas_in_space(*scratch, scratch->spatial.triangle.span()));
  TRY(builder->mesh->way.push(PatchWay::minimal_area));
  if (scratch->spatial.coarse && builder->mesh->coarse_patches++ == 0) {
    builder->mesh->first_coarse_patch = patch;
  }
  return append_patch(*scratch, scratch->spatial.triangle.span(), patch, builder);
}

static TriangleCorners* corners_of(uint32_t triangle, Builder* builder) {
  const size_t i = last_holding(size_t{0}, builder->cornered.size(), [&](size_t k) {
    return builder->cornered[k].triangle <= triangle;
  });
  WIRESKIN_ASSERT(builder->cornered[i].triangle == triangle);
  return &builder->cornered[i];
}

static mesh::TriangleShape shape_of(const TriangleCorners& corners) {
  return mesh::triangle_shape(corners.at[0], corners.at[1], corners.at[2]);
}

// Splits triangle t's edge from corner k to the next one at its midpoint, the new vertex m: the
// triangle keeps one half, a new triangle takes the other.
static Status split_triangle(uint32_t h, uint32_t m, Builder* builder) {
  PatchMesh* mesh = builder->mesh;
  const uint32_t next = mesh::next_half_edge(h), previous = mesh::previous_half_edge(h);
  TriangleCorners* old = corners_of(h / 3, builder);
  const Vec3 middle = 0.5 * (old->at[h % 3] + old->at[next % 3]);
  const uint32_t vertex[3] = {m, mesh->triangle[next], mesh->triangle[previous]};
  const TriangleCorners fresh = {static_cast<uint32_t>(mesh->patch.size()),
                                 {middle, old->at[next % 3], old->at[previous % 3]}};
  mesh->triangle[next] = m;
  old->at[next % 3] = middle;
  mesh->shape[h / 3] = shape_of(*old);
  for (uint32_t v : vertex) TRY(mesh->triangle.push(v));
  TRY(mesh->shape.push(shape_of(fresh)));
  TRY(mesh->patch.push(mesh->patch[h / 3]));
  return builder->cornered.push(fresh);
}

// Splits the triangles [first, end) of the chord's patch that have the chord.
static Status split_triangles(const Chord& chord, uint32_t first, uint32_t end, uint32_t middle,
                              Builder* builder) {
  const PatchMesh& mesh = *builder->mesh;
  for (uint32_t h = 3 * first; h < 3 * end; ++h) {
    const uint32_t a = mesh.triangle[h], b = mesh.triangle[mesh::next_half_edge(h)];
    const bool here = (a == chord.a && b == chord.b) || (a == chord.b && b == chord.a);
    if (here && mesh.patch[h / 3] == chord.patch) TRY(split_triangle(h, middle, builder));
  }
  return {};
}

// A patch's triangles are those it began with and some of those that came from earlier splits.
static Status split_chord(const Chord& chord, Builder* builder) {
  PatchMesh* mesh = builder->mesh;
  if (mesh->triangle.size() > 0x7fffffff) {
    return fail(Code::too_large, "the spacing is too small for the network");
  }
  const uint32_t middle = mesh->vertices++;
  TRY(mesh->start.push(0.5 * (mesh->start[chord.a] + mesh->start[chord.b])));
  TRY(mesh->placed.push(builder->raised[chord.patch]));
  const uint32_t* own = &builder->patch_start[chord.patch];
  const uint32_t first_split = builder->patch_start.back();
  const uint32_t triangles = static_cast<uint32_t>(mesh->patch.size());
  TRY(split_triangles(chord, own[0], own[1], middle, builder));
  TRY(split_triangles(chord, first_split, triangles, middle, builder));
  return mesh->triangle.context().checkpoint();
}

// Splits every chord that stands in two patches or beside a curve's edge.
static Status split_shared_chords(const Network& network, const CurveVertices& vertices,
                                  Builder* builder) {
  for (uint32_t s = 0; s < network.segment.size(); ++s) {
    for (uint32_t k = 0; k < vertices.edges[s]; ++k) {
      const uint32_t a = segment_vertex(network, vertices, s, k);
      const uint32_t b = segment_vertex(network, vertices, s, k + 1);
      TRY(builder->chord.push({a < b ? a : b, a < b ? b : a, k_none}));
    }
  }
  sort(builder->chord.span(), before);
  const Span<const Chord> chords = builder->chord.span();
  for (size_t i = 0; i < chords.size(); ++i) {
    const auto same = [&](size_t k) {
      return k < chords.size() && chords[k].a == chords[i].a && chords[k].b == chords[i].b;
    };
    const bool shared = same(i + 1) || (i > 0 && same(i - 1));
    if (shared && chords[i].patch != k_none) TRY(split_chord(chords[i], builder));
  }
  return {};
}

// Why the patch is not to be made, its number included.
static Status fault_of_patch(const Network& network, uint32_t patch, Span<const Status> faults) {
  Status status;
  for (uint32_t h : network.cycle(patch)) {
    if (status.ok() && !faults.empty()) status = faults[h / 2];
  }
  for (uint32_t s : network.inner[patch]) {
    if (status.ok() && !faults.empty()) status = faults[s];
  }
  status.place.patch = patch;
  return status;
}

Status mesh_patches(const Network& network, const CurveVertices& vertices, double least_facing,
                    bool partial, PatchMesh* mesh, Span<const Status> faults) {
  Context& context = mesh->triangle.context();
  Builder builder(context, mesh);
  PatchScratch scratch(context);
  TRY(scratch.local.assign(vertices.position.size(), k_none));
  mesh->curve_vertices = mesh->vertices = static_cast<uint32_t>(vertices.position.size());
  TRY(mesh->start.copy(vertices.position.span()));
  TRY(mesh->placed.assign(mesh->vertices, 0));
  for (uint32_t p = 0; p < network.patches(); ++p) {
    TRY(builder.patch_start.push(static_cast<uint32_t>(mesh->patch.size())));
    Status status = fault_of_patch(network, p, faults);
    const bool known = !status.ok();
    scratch.spatial.raised = false;
    if (!known) status = mesh_patch(network, vertices, least_facing, p, &scratch, &builder);
    if (!known) status = at_patch(status, network, p);
    TRY(mesh->status.push(status));
    TRY(builder.raised.push(scratch.spatial.raised));
    if (!status.ok() && !(partial && (known || may_be_left_out(status)))) return status;
    if (!status.ok()) TRY(mesh->way.push(PatchWay::plane));
    TRY(context.progress(static_cast<double>(p + 1) / static_cast<double>(network.patches())));
  }
  TRY(builder.patch_start.push(static_cast<uint32_t>(mesh->patch.size())));
  if (mesh->vertices >= k_most_vertices) {
    return fail(
        Code::too_large,
        "the spacing is too small for the network: its surface has more than 2^26 vertices");
  }
  if (mesh->patch.empty() && !mesh->status.empty()) return mesh->status[0];
  return split_shared_chords(network, vertices, &builder);
}

}  // namespace wireskin::network
