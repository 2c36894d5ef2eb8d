// libFuzzer target: points in space to their Delaunay triangulation: tetrahedra positively
// oriented, linked both ways, with no neighbour's corner in a ball.
#include "flow/delaunay.h"
#include "fuzz/bytes.h"
#include "num/predicates3.h"

using namespace wireskin;

static void check_tetrahedra(const flow::Delaunay& d, const std::vector<Vec3>& points) {
  for (uint32_t i = 0; i < d.tets.size(); ++i) {
    const uint32_t* v = d.tets[i].vertex;
    const Vec3 a = points[v[0]], b = points[v[1]], c = points[v[2]], e = points[v[3]];
    fuzz::require(orient3d(a, b, c, e) > 0.0);
    for (uint32_t k = 0; k < 4; ++k) {
      const uint32_t across = d.tets[i].across[k];
      if (across == k_none) continue;
      const flow::Tetrahedron& other = d.tets[across / 4];
      fuzz::require(other.across[across % 4] == 4 * i + k);
      fuzz::require(insphere(a, b, c, e, points[other.vertex[across % 4]]) <= 0.0);
    }
  }
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz::Bytes bytes(data, size);
  fuzz::Limits limits;
  fuzz::Arena& heap = limits.allocator;
  {
    Context context({heap.allocate, heap.release, &heap}, size_t{1} << 26, {});
    std::vector<Vec3> points;
    const uint32_t most = 3 + bytes.count(20, 80);
    while (!bytes.empty() && points.size() < most) {
      Vec3 p = {bytes.number(), bytes.number(), bytes.number()};
      // Some on a sphere, some again.
      if (bytes.one_in(8)) p = std::sqrt(1.0 / (1e-9 + dot(p, p))) * p;
      points.push_back(p);
    }
    flow::Delaunay delaunay(context);
    const Status status =
        flow::triangulate(context, {points.data(), points.size()}, 1u << 16, &delaunay);
    if (status.ok()) {
      fuzz::require(delaunay.same_as.size() == points.size());
      fuzz::require((delaunay.dimension == 3) == !delaunay.tets.empty());
      check_tetrahedra(delaunay, points);
    }
  }
  fuzz::require(heap.clean());
  return 0;
}
