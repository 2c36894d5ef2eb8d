#include "flow/face_rims.h"

namespace wireskin::flow {

Status link_rims(const FlatFaces& faces, uint32_t arcs, FaceRims* rims) {
  TRY(rims->start.assign(size_t{arcs} + 1, 0));
  TRY(rims->rim.resize(faces.rim.size()));
  TRY(rims->face.resize(faces.rim.size()));
  TRY(rims->state.assign(faces.size(), FaceState::inner));
  for (uint32_t f = 0; f < faces.size(); ++f) {
    for (uint32_t i = faces.rim_start[f]; i < faces.rim_start[f + 1]; ++i) {
      rims->face[i] = f;
      ++rims->start[faces.rim[i].arc];
    }
  }
  starts_from_counts(rims->start.span());
  for (uint32_t i = 0; i < faces.rim.size(); ++i) {
    rims->rim[rims->start[faces.rim[i].arc]++] = i;
  }
  shift_starts_back(rims->start.span());
  return {};
}

bool continue_flat(const FlatFaces& faces, const StraightLines& lines, const FaceRims& rims,
                   uint32_t i, uint32_t k) {
  const Vec3& a = faces.normal[rims.face[i]];
  const Vec3& b = faces.normal[rims.face[k]];
  if (std::fabs(dot(a, b)) < k_same_line) return false;
  return !lines.is_straight(faces.rim[i].arc) || dot(faces.rim[i].into, faces.rim[k].into) < 0.0;
}

}  // namespace wireskin::flow
