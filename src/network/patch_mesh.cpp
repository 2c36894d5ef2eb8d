#include "network/patch_mesh.h"

#include "base/sort.h"
#include "mesh/loop_mesh.h"
#include "network/border.h"
#include "network/enclosure.h"
#include "network/side_normals.h"
#include "planar/polygon_mesh.h"

namespace wireskin::network {

namespace {

// An edge inside a patch between two curve vertices, a < b; or with patch k_none an edge of a
// curve.
struct Chord {
  uint32_t a, b;
  uint32_t patch;
};

// What is gathered over all patches: corner[3 t + k] is corner k of triangle t, in space or in its
// patch's plane (z = 0; the same vertex then has another place in each patch).
struct Builder {
  PatchMesh* mesh;
  Array<Vec3> corner;
  Array<Chord> chord;
  Array<uint32_t> patch_start;  // first triangle of each patch, before chords are split

  explicit Builder(Context& context, PatchMesh* result)
      : mesh(result), corner(context), chord(context), patch_start(context) {}
};

// Memory for one patch, reused: the border, the mesh either way, and what both come to: triangles
// over border vertices 0 .. n - 1 and inner ones from n, the corners' places for the metric, and
// where the inner vertices may start in space.
struct PatchScratch {
  Array<uint32_t> border;
  Array<Vec2> polygon;
  Array<Vec3> loop, loop_normal;  // along the border; normals are zero where not known
  planar::PolygonMesh planar;
  mesh::LoopMesh spatial;
  Array<Vec3> place;
  Array<Vec3> inner;

  explicit PatchScratch(Context& context)
      : border(context),
        polygon(context),
        loop(context),
        loop_normal(context),
        planar(context),
        spatial(context),
        place(context),
        inner(context) {}
};

}  // namespace

// Adds the place to what went wrong with a patch: its number and a curve of its border.
static Status at_patch(Status status, const Network& network, uint32_t patch) {
  const bool geometric = status.code == Code::patch_without_plane ||
                         status.code == Code::patch_folded ||
                         status.code == Code::patch_several_loops;
  if (!geometric) return status;
  status.place.patch = patch;
  if (status.place.curve == k_none) {
    status.place.curve = network.segment[network.cycle(patch)[0] / 2].curve;
  }
  return status;
}

static double mean_edge(const CurveVertices& vertices, Span<const uint32_t> border) {
  double sum = 0.0;
  for (size_t i = 0; i < border.size(); ++i) {
    const size_t next = i + 1 == border.size() ? 0 : i + 1;
    sum += length(vertices.position[border[next]] - vertices.position[border[i]]);
  }
  return sum / static_cast<double>(border.size());
}

static Status append_patch(const PatchScratch& scratch, Span<const uint32_t> triangle,
                           uint32_t patch, Builder* builder) {
  PatchMesh* mesh = builder->mesh;
  const uint32_t n = static_cast<uint32_t>(scratch.border.size());
  const auto global = [&](uint32_t v) {
    return v < n ? scratch.border[v] : mesh->vertices + (v - n);
  };
  for (size_t h = 0; h < triangle.size(); ++h) {
    const uint32_t a = triangle[h], b = triangle[mesh::next_half_edge(static_cast<uint32_t>(h))];
    TRY(mesh->triangle.push(global(a)));
    TRY(builder->corner.push(scratch.place[a]));
    if (h % 3 == 0) TRY(mesh->patch.push(patch));
    const bool on_border = (a + 1) % n == b || (b + 1) % n == a;
    // Each edge inside is met once in each direction; the ascending one is noted.
    if (a < n && b < n && !on_border && global(a) < global(b)) {
      TRY(builder->chord.push({global(a), global(b), patch}));
    }
  }
  for (const Vec3& p : scratch.inner) TRY(mesh->start.push(p));
  const uint64_t vertices = uint64_t{mesh->vertices} + scratch.inner.size();
  if (vertices > 0x7fffffff || mesh->triangle.size() > 0x7fffffff) {
    return fail(Code::too_large, "the spacing is too small for the network");
  }
  mesh->vertices = static_cast<uint32_t>(vertices);
  return {};
}

static Status mesh_in_plane(const CurveVertices& vertices, const Enclosure& enclosure,
                            double spacing, double least_facing, PatchScratch* scratch) {
  Plane plane;
  TRY(fit_plane(vertices, scratch->border.span(), scratch->loop_normal.span(), &plane));
  const size_t n = scratch->border.size();
  TRY(scratch->polygon.resize(n));
  double facing = 0.0;
  size_t known = 0;
  for (size_t i = 0; i < n; ++i) {
    scratch->polygon[i] = plane.project(scratch->loop[i]);
    facing += dot(scratch->loop_normal[i], plane.normal);
    known += scratch->loop_normal[i] != Vec3{};
  }
  TRY(enclosure.check(vertices, scratch->border.span(), scratch->polygon.span(), plane));
  if (known > 0 && facing < least_facing * static_cast<double>(known)) {
    return fail(Code::patch_without_plane, "the plane of the patch sees too much of it edge-on");
  }
  round_to_grid(scratch->polygon.span(), &spacing);
  TRY(planar::mesh_polygon(scratch->border.context(), scratch->polygon.span(), spacing,
                           &scratch->planar));
  const Array<Vec2>& points = scratch->planar.points;
  TRY(scratch->place.resize(points.size()));
  TRY(scratch->inner.resize(points.size() - n));
  for (size_t i = 0; i < points.size(); ++i) {
    scratch->place[i] = {points[i].x, points[i].y, 0.0};
    if (i >= n) scratch->inner[i - n] = plane.lift(points[i]);
  }
  return {};
}

static Status mesh_in_space(double spacing, PatchScratch* scratch) {
  TRY(mesh::mesh_loop(scratch->border.context(), scratch->loop.span(), scratch->loop_normal.span(),
                      spacing, &scratch->spatial));
  TRY(scratch->inner.copy(scratch->spatial.inner.span()));
  TRY(scratch->place.copy(scratch->loop.span()));
  for (const Vec3& p : scratch->inner) TRY(scratch->place.push(p));
  return {};
}

static Status mesh_patch(const Network& network, const CurveVertices& vertices,
                         const Enclosure& enclosure, double least_facing, uint32_t patch,
                         PatchScratch* scratch, Builder* builder) {
  TRY(border_of_patch(network, vertices, patch, &scratch->border));
  TRY(normals_of_border(network, vertices, patch, &scratch->loop_normal));
  const size_t n = scratch->border.size();
  TRY(scratch->loop.resize(n));
  for (size_t i = 0; i < n; ++i) {
    scratch->loop[i] = vertices.position[scratch->border[i]];
  }
  const double spacing = mean_edge(vertices, scratch->border.span());
  const Status status = mesh_in_plane(vertices, enclosure, spacing, least_facing, scratch);
  if (status.ok()) {
    TRY(builder->mesh->way.push(PatchWay::plane));
    return append_patch(*scratch, scratch->planar.triangles.span(), patch, builder);
  }
  if (status.code != Code::patch_without_plane && status.code != Code::patch_folded) return status;
  TRY(check_border(scratch->border.context(), scratch->loop.span(), scratch->loop_normal.span()));
  TRY(mesh_in_space(spacing, scratch));
  TRY(builder->mesh->way.push(PatchWay::minimal_area));
  return append_patch(*scratch, scratch->spatial.triangle.span(), patch, builder);
}

// Splits triangle t's edge from corner k to the next one at its midpoint, the new vertex m: the
// triangle keeps one half, a new triangle takes the other.
static Status split_triangle(uint32_t h, uint32_t m, Builder* builder) {
  PatchMesh* mesh = builder->mesh;
  const uint32_t next = mesh::next_half_edge(h), previous = mesh::previous_half_edge(h);
  const Vec3 middle = 0.5 * (builder->corner[h] + builder->corner[next]);
  const uint32_t vertex[3] = {m, mesh->triangle[next], mesh->triangle[previous]};
  const Vec3 corner[3] = {middle, builder->corner[next], builder->corner[previous]};
  for (int k = 0; k < 3; ++k) {
    TRY(mesh->triangle.push(vertex[k]));
    TRY(builder->corner.push(corner[k]));
  }
  mesh->triangle[next] = m;
  builder->corner[next] = middle;
  return mesh->patch.push(mesh->patch[h / 3]);
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
  sort(builder->chord.span(), [](const Chord& x, const Chord& y) {
    if (x.a != y.a) return x.a < y.a;
    return x.b != y.b ? x.b < y.b : x.patch < y.patch;
  });
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

Status mesh_patches(const Network& network, const CurveVertices& vertices, double least_facing,
                    PatchMesh* mesh) {
  Context& context = mesh->triangle.context();
  Builder builder(context, mesh);
  PatchScratch scratch(context);
  Enclosure enclosure(context);
  TRY(enclosure.find_components(network, vertices));
  mesh->curve_vertices = mesh->vertices = static_cast<uint32_t>(vertices.position.size());
  TRY(mesh->start.copy(vertices.position.span()));
  for (uint32_t p = 0; p < network.patches(); ++p) {
    TRY(builder.patch_start.push(static_cast<uint32_t>(mesh->patch.size())));
    TRY(at_patch(mesh_patch(network, vertices, enclosure, least_facing, p, &scratch, &builder),
                 network, p));
    TRY(context.progress(static_cast<double>(p + 1) / static_cast<double>(network.patches())));
  }
  TRY(builder.patch_start.push(static_cast<uint32_t>(mesh->patch.size())));
  TRY(split_shared_chords(network, vertices, &builder));
  TRY(mesh->shape.resize(mesh->patch.size()));
  for (size_t t = 0; t < mesh->shape.size(); ++t) {
    const Vec3* corner = &builder.corner[3 * t];
    mesh->shape[t] = mesh::triangle_shape(corner[0], corner[1], corner[2]);
  }
  return {};
}

}  // namespace wireskin::network
