#include "network/shared_chords.h"

#include "base/search.h"
#include "base/sort.h"

namespace wireskin::network {

static bool before(const Chord& x, const Chord& y) {
  if (x.a != y.a) return x.a < y.a;
  return x.b != y.b ? x.b < y.b : x.patch < y.patch;
}

Status SharedChords::note(const PatchDomain& domain, const uint32_t* corner, const Vec3* at,
                          uint32_t patch, uint32_t t) {
  bool any = false;
  const uint32_t n = domain.size();
  for (int k = 0; k < 3; ++k) {
    const uint32_t a = corner[k], b = corner[(k + 1) % 3];
    if (a >= n || b >= n || domain.is_curve_edge(a, b)) continue;
    any = true;
    // Each edge inside is met once in each direction; the ascending one is noted.
    const uint32_t from = domain.vertex[a], to = domain.vertex[b];
    if (from < to) TRY(chord.push({from, to, patch}));
  }
  if (!any) return {};
  return cornered.push({t, {at[0], at[1], at[2]}});
}

static TriangleCorners* corners_of(uint32_t triangle, SharedChords* chords) {
  const size_t i = last_holding(size_t{0}, chords->cornered.size(),
                                [&](size_t k) { return chords->cornered[k].triangle <= triangle; });
  WIRESKIN_ASSERT(chords->cornered[i].triangle == triangle);
  return &chords->cornered[i];
}

static mesh::TriangleShape shape_of(const TriangleCorners& corners) {
  return mesh::triangle_shape(corners.at[0], corners.at[1], corners.at[2]);
}

// Splits triangle t's edge from corner k to the next one at its midpoint, the new vertex m: the
// triangle keeps one half, a new triangle takes the other.
static Status split_triangle(uint32_t h, uint32_t m, SharedChords* chords) {
  PatchMesh* mesh = chords->mesh;
  const uint32_t next = mesh::next_half_edge(h), previous = mesh::previous_half_edge(h);
  TriangleCorners* old = corners_of(h / 3, chords);
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
  return chords->cornered.push(fresh);
}

// Splits the triangles [first, end) of the chord's patch that have the chord.
static Status split_triangles(const Chord& chord, uint32_t first, uint32_t end, uint32_t middle,
                              SharedChords* chords) {
  const PatchMesh& mesh = *chords->mesh;
  for (uint32_t h = 3 * first; h < 3 * end; ++h) {
    const uint32_t a = mesh.triangle[h], b = mesh.triangle[mesh::next_half_edge(h)];
    const bool here = (a == chord.a && b == chord.b) || (a == chord.b && b == chord.a);
    if (here && mesh.patch[h / 3] == chord.patch) TRY(split_triangle(h, middle, chords));
  }
  return {};
}

// A patch's triangles are those it began with and some of those that came from earlier splits.
static Status split_chord(const Chord& chord, SharedChords* chords) {
  PatchMesh* mesh = chords->mesh;
  if (mesh->triangle.size() > 0x7fffffff) {
    return fail(Code::too_large, "the spacing is too small for the network");
  }
  const uint32_t middle = mesh->vertices++;
  TRY(mesh->start.push(0.5 * (mesh->start[chord.a] + mesh->start[chord.b])));
  TRY(mesh->placed.push(chords->raised[chord.patch]));
  const uint32_t* own = &chords->patch_start[chord.patch];
  const uint32_t first_split = chords->patch_start.back();
  const uint32_t triangles = static_cast<uint32_t>(mesh->patch.size());
  TRY(split_triangles(chord, own[0], own[1], middle, chords));
  TRY(split_triangles(chord, first_split, triangles, middle, chords));
  return mesh->triangle.context().checkpoint();
}

// Every edge of the curves, as a chord of no patch.
static Status note_curves(const Network& network, const CurveVertices& vertices,
                          Array<Chord>* chords) {
  for (uint32_t s = 0; s < network.segment.size(); ++s) {
    for (uint32_t k = 0; k < vertices.edges[s]; ++k) {
      const uint32_t a = segment_vertex(network, vertices, s, k);
      const uint32_t b = segment_vertex(network, vertices, s, k + 1);
      TRY(chords->push({a < b ? a : b, a < b ? b : a, k_none}));
    }
  }
  return {};
}

Status SharedChords::split(const Network& network, const CurveVertices& vertices) {
  TRY(note_curves(network, vertices, &chord));
  sort(chord.span(), before);
  const Span<const Chord> chords = chord.span();
  for (size_t i = 0; i < chords.size(); ++i) {
    const auto same = [&](size_t k) {
      return k < chords.size() && chords[k].a == chords[i].a && chords[k].b == chords[i].b;
    };
    const bool shared = same(i + 1) || (i > 0 && same(i - 1));
    if (shared && chords[i].patch != k_none) TRY(split_chord(chords[i], this));
  }
  return {};
}

}  // namespace wireskin::network
