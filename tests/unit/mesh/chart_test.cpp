#include "mesh/chart.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/loop_mesh.h"
#include "num/predicates.h"
#include "support/context.h"
#include "support/fails_cleanly.h"

using namespace unit;
using namespace wireskin;
using namespace wireskin::mesh;

namespace {

// Between two circles round the axis z, the lower one the longer, as mesh_loops fills them.
struct Bucket {
  std::vector<uint32_t> start{0, 24, 40};
  std::vector<Vec3> position, normal;
  std::vector<uint32_t> triangle;

  Bucket() {
    for (uint32_t i = 0; i < 40; ++i) {
      const double t = 6.283185307179586 * (i < 24 ? i / 24.0 : -(i - 24.0) / 16.0);
      const Vec3 out = {std::cos(t), std::sin(t), 0.0};
      position.push_back(i < 24 ? 0.5 * out : 0.3 * out + Vec3{0.0, 0.0, 0.7});
      normal.push_back(out);
    }
    Heap heap;
    LoopMesh mesh(heap.context);
    must(mesh_loops(heap.context, {view(start), view(position), view(normal)}, 0.1, &mesh));
    position.insert(position.end(), mesh.inner.begin(), mesh.inner.end());
    triangle = to_vector(mesh.triangle);
  }
  Status flatten(Context& context, Array<Vec2>* flat) const {
    return lay_flat(context, view(start), view(position), view(triangle), flat);
  }
};

}  // namespace

TEST_CASE("chart: a bucket without bottom lies in the unit disc without folds") {
  const Bucket bucket;
  Heap heap;
  Array<Vec2> flat(heap.context);
  must(bucket.flatten(heap.context, &flat));
  REQUIRE(flat.size() == bucket.position.size());
  REQUIRE(flat.size() > 60);
  const Vec2 origin = {0.0, 0.0};
  for (uint32_t v = 0; v < flat.size(); ++v) {
    const double radius = std::hypot(flat[v].x, flat[v].y);
    if (v < 24) {
      CHECK(radius == doctest::Approx(1.0).epsilon(1e-12));
      CHECK(orient2d(origin, flat[v], flat[(v + 1) % 24]) > 0.0);
    } else {
      CHECK(radius < 1.0);
    }
  }
  for (size_t t = 0; t < bucket.triangle.size(); t += 3) {
    CHECK(orient2d(flat[bucket.triangle[t]], flat[bucket.triangle[t + 1]],
                   flat[bucket.triangle[t + 2]]) > 0.0);
  }
}

TEST_CASE("chart: a mesh turned over is refused") {
  Bucket bucket;
  for (size_t t = 0; t < bucket.triangle.size(); t += 3) {
    std::swap(bucket.triangle[t], bucket.triangle[t + 1]);
  }
  Heap heap;
  Array<Vec2> flat(heap.context);
  CHECK(bucket.flatten(heap.context, &flat).code == Code::patch_folded);
}

TEST_CASE("chart: whatever fails there") {
  const Bucket bucket;
  fails_cleanly([&](Context& context) -> Status {
    Array<Vec2> flat(context);
    return bucket.flatten(context, &flat);
  });
}
