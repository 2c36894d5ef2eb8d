// Chords between curve vertices that stand in two patches, or beside an edge of a curve: the
// patches would share an edge that is none of the curves'. Each is split by a free vertex in the
// middle.
//
// In: the triangles of each patch as they come. Out: the mesh of all, with the triangles at such
// chords split. O(n log n); a split costs the triangles of its patch.
#pragma once

#include "network/patch_domain.h"
#include "network/patch_mesh.h"

namespace wireskin::network {

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

struct SharedChords {
  PatchMesh* mesh;
  Array<Chord> chord;
  Array<TriangleCorners> cornered;  // the triangles that have chords, ascending
  Array<uint32_t> patch_start;      // first triangle of each patch, and the end, before any split
  Array<uint8_t> raised;            // of each patch

  SharedChords(Context& context, PatchMesh* result)
      : mesh(result), chord(context), cornered(context), patch_start(context), raised(context) {}

  // Notes the chords of triangle `t`, whose vertices in the patch's domain are `corner`; where it
  // has any, also the places of these.
  Status note(const PatchDomain& domain, const uint32_t* corner, const Vec3* at, uint32_t patch,
              uint32_t t);
  // When all patches are there.
  Status split(const Network& network, const CurveVertices& vertices);
};

}  // namespace wireskin::network
