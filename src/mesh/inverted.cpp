#include "mesh/inverted.h"

namespace wireskin::mesh {

namespace {

struct FacedMesh {
  Span<const Vec3> position;
  Span<const uint32_t> triangle, patch;

  bool same_patch(uint32_t t, uint32_t other) const {
    return patch.empty() || patch[t] == patch[other];
  }
  Vec3 facing(uint32_t t) const {
    const Vec3& a = position[triangle[3 * size_t{t}]];
    return cross(position[triangle[3 * size_t{t} + 1]] - a,
                 position[triangle[3 * size_t{t} + 2]] - a);
  }
};

}  // namespace

static bool faces_a_neighbour(const FacedMesh& mesh, Span<const uint32_t> twins, uint32_t t) {
  for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
    if (twins[h] == k_none || !mesh.same_patch(t, twins[h] / 3)) continue;
    if (dot(mesh.facing(t), mesh.facing(twins[h] / 3)) < 0.0) return true;
  }
  return false;
}

static bool is_inverted(const FacedMesh& mesh, Span<const uint32_t> start,
                        Span<const uint32_t> corner, uint32_t t) {
  const Vec3 own = mesh.facing(t);
  uint32_t against = 0;
  for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
    const uint32_t v = mesh.triangle[h];
    Vec3 others;
    bool any = false;
    for (uint32_t c = start[v]; c < start[v + 1]; ++c) {
      const uint32_t other = corner[c] / 3;
      if (other == t || !mesh.same_patch(t, other)) continue;
      others += mesh.facing(other);
      any = true;
    }
    if (!any) continue;
    if (!(dot(own, others) < 0.0)) return false;
    ++against;
  }
  return against > 0;
}

Status find_inverted(Context& context, Span<const Vec3> position, Span<const uint32_t> triangle,
                     Span<const uint32_t> patch, Inverted* inverted) {
  constexpr size_t k_work_per_checkpoint = 1u << 16;
  constexpr uint32_t k_triangles_per_checkpoint = 1u << 15;
  const FacedMesh mesh = {position, triangle, patch};
  const uint32_t vertices = static_cast<uint32_t>(position.size());
  Array<uint32_t> twins(context), start(context), corner(context), candidate(context);
  *inverted = {};
  TRY(find_twins(vertices, triangle, &twins));
  for (uint32_t t = 0; t < triangle.size() / 3; ++t) {
    if (faces_a_neighbour(mesh, twins.span(), t)) TRY(candidate.push(t));
    if (t % k_triangles_per_checkpoint == k_triangles_per_checkpoint - 1) TRY(context.checkpoint());
  }
  if (candidate.empty()) return {};
  TRY(find_corners(vertices, triangle, &start, &corner));
  size_t work = 0;
  for (const uint32_t t : candidate) {
    for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      work += start[triangle[h] + 1] - start[triangle[h]];
    }
    if (work > k_work_per_checkpoint) {
      work = 0;
      TRY(context.checkpoint());
    }
    if (!is_inverted(mesh, start.span(), corner.span(), t)) continue;
    if (inverted->count++ == 0) inverted->first = t;
  }
  return {};
}

}  // namespace wireskin::mesh
