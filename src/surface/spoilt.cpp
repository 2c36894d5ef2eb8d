#include "surface/spoilt.h"

#include "base/in_parts.h"
#include "num/minmax.h"

namespace wireskin {

// The solver aims at a residual of 1e-12; what is thinner than this no one can tell from rounding.
static constexpr double k_least_height = 1e-10;
// Soft curves carry it from patch to patch; where that does not end, all patches go back.
static constexpr uint32_t k_most_rounds = 8;

namespace {

// A triangle's doubled area, and its longest edge squared: their quotient is its height over that
// edge as a share of it.
struct Height {
  double area, longest2;
};

}  // namespace

static Height height_of(Span<const Vec3> position, Span<const uint32_t> triangle, size_t t) {
  const Vec3& a = position[triangle[3 * t]];
  const Vec3& b = position[triangle[3 * t + 1]];
  const Vec3& c = position[triangle[3 * t + 2]];
  const double longest2 = larger(dot(b - a, b - a), larger(dot(c - b, c - b), dot(a - c, a - c)));
  return {length(cross(b - a, c - a)), longest2};
}

static bool is_thin(const Height& height) {
  return !(height.area > k_least_height * height.longest2);
}

static double share_of(const Height& height) {
  return height.longest2 > 0.0 ? height.area / height.longest2 : 0.0;
}

// The square of the distance that no vertex may go.
static Status find_farthest(Context& context, Span<const Vec3> start, double* farthest2) {
  Vec3 low = start[0], high = start[0];
  TRY(in_parts(context, start.size(), [&](size_t v) {
    const Vec3& p = start[v];
    low = {smaller(low.x, p.x), smaller(low.y, p.y), smaller(low.z, p.z)};
    high = {larger(high.x, p.x), larger(high.y, p.y), larger(high.z, p.z)};
  }));
  *farthest2 = dot(high - low, high - low);
  return {};
}

static bool is_far(const SmoothedMesh& mesh, double farthest2, size_t v) {
  const Vec3 way = mesh.position[v] - mesh.start[v];
  return dot(way, way) > farthest2;
}

// Whether there is a thin triangle or a far vertex at all.
static Status may_be_spoilt(Context& context, const SmoothedMesh& mesh, double farthest2,
                            bool* may_be) {
  *may_be = false;
  TRY(in_parts(context, mesh.patch.size(), [&](size_t t) {
    *may_be = *may_be || is_thin(height_of(mesh.position, mesh.triangle, t));
  }));
  return in_parts(context, mesh.position.size(),
                  [&](size_t v) { *may_be = *may_be || is_far(mesh, farthest2, v); });
}

// The least height in each patch as a share of the edge, 1 where none is thin.
static Status find_least(Context& context, Span<const Vec3> position, Span<const uint32_t> triangle,
                         Span<const uint32_t> patch, Span<double> least) {
  for (double& l : least) l = 1.0;
  return in_parts(context, patch.size(), [&](size_t t) {
    const Height height = height_of(position, triangle, t);
    if (!is_thin(height)) return;
    least[patch[t]] = smaller(least[patch[t]], share_of(height));
  });
}

Status find_spoilt(Context& context, const SmoothedMesh& mesh, uint32_t patches, Spoilt* spoilt) {
  double farthest2 = 0.0;
  bool may_be = false;
  spoilt->patch.clear();
  spoilt->first = k_none;
  TRY(find_farthest(context, mesh.start, &farthest2));
  TRY(may_be_spoilt(context, mesh, farthest2, &may_be));
  if (!may_be) return {};
  Array<double> before(context);
  TRY(before.resize(patches));
  TRY(find_least(context, mesh.start, mesh.unturned, mesh.patch, before.span()));
  TRY(spoilt->patch.assign(patches, 0));
  TRY(in_parts(context, mesh.patch.size(), [&](size_t t) {
    const uint32_t p = mesh.patch[t];
    const Height height = height_of(mesh.position, mesh.triangle, t);
    bool bad = is_thin(height) && share_of(height) < before[p];
    for (size_t h = 3 * t; h < 3 * t + 3; ++h) {
      bad = bad || is_far(mesh, farthest2, mesh.triangle[h]);
    }
    if (!bad) return;
    spoilt->patch[p] = 1;
    if (spoilt->first == k_none) spoilt->first = static_cast<uint32_t>(t);
  }));
  if (spoilt->first == k_none) spoilt->patch.clear();
  return {};
}

// With its curves a patch is what it was. A vertex goes back on every side of a crease.
static Status put_back(Context& context, const SmoothedMesh& mesh, Span<const uint8_t> back) {
  const auto origin_of = [&](size_t v) { return mesh.origin.empty() ? v : mesh.origin[v]; };
  Array<uint8_t> goes(context);
  TRY(assign_in_parts(mesh.position.size(), 0, &goes));
  TRY(in_parts(context, mesh.triangle.size(), [&](size_t h) {
    if (!back[mesh.patch[h / 3]]) return;
    mesh.triangle[h] = mesh.unturned[h];
    goes[origin_of(mesh.unturned[h])] = 1;
  }));
  return in_parts(context, mesh.position.size(), [&](size_t v) {
    if (goes[origin_of(v)]) mesh.position[v] = mesh.start[v];
  });
}

Status put_back_spoilt(Context& context, const SmoothedMesh& mesh, uint32_t patches,
                       Array<uint8_t>* back) {
  Spoilt spoilt(context);
  back->clear();
  for (uint32_t round = 0;; ++round) {
    TRY(find_spoilt(context, mesh, patches, &spoilt));
    if (spoilt.first == k_none) return {};
    if (back->empty()) TRY(back->assign(patches, 0));
    WIRESKIN_ASSERT(round <= k_most_rounds && !(*back)[mesh.patch[spoilt.first]]);
    for (size_t p = 0; p < patches; ++p) {
      if (spoilt.patch[p] || round == k_most_rounds) (*back)[p] = 1;
    }
    TRY(put_back(context, mesh, back->span()));
    TRY(context.checkpoint());
  }
}

}  // namespace wireskin
