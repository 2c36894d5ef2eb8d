// Failing memory and cancelling in the triangulators: each input makes every array of theirs grow.
#include <doctest/doctest.h>

#include "planar/cavity_side.h"
#include "planar/polygon_mesh.h"
#include "planar/relax.h"
#include "support/fails_cleanly.h"

using namespace unit;
using namespace wireskin;
using namespace wireskin::planar;

namespace {

std::vector<Vec2> random_points(uint32_t count, uint32_t seed) {
  Random random(seed);
  std::vector<Vec2> points;
  for (uint32_t i = 0; i < count; ++i) points.push_back({random(), random()});
  return points;
}

// The square round random points, crossed by the longest line there is.
struct Crossed {
  std::vector<Vec2> points{{-1, -1}, {2, -1}, {2, 2}, {-1, 2}, {-0.5, 0.4}, {1.5, 0.6}};
  std::vector<uint32_t> border{0, 1, 1, 2, 2, 3, 3, 0};
  std::vector<uint32_t> lines{4, 5};

  explicit Crossed(uint32_t count) {
    for (const Vec2& p : random_points(count, 7)) points.push_back(p);
  }
  Region region() const { return {view(points), view(border), view(lines), true}; }
};

}  // namespace

TEST_CASE("faults: the side of a corridor, by the search and by reinsertion") {
  for (const uint32_t count : {9u, 60u}) {
    std::vector<Vec2> chain{{0.0, 0.0}};
    Random random(count);
    for (uint32_t i = 1; i <= count; ++i) chain.push_back({i + 0.0, 1.0 + random()});
    chain.push_back({count + 1.0, 0.0});
    fails_cleanly([&](Context& context) -> Status {
      SideTriangles side(context);
      TRY(side.points.copy(view(chain)));
      TRY(triangulate_side(&side));
      return side.triangles.size() == count ? Status{} : fail(Code::bad_mesh, "too few");
    });
  }
}

TEST_CASE("faults: a line through many triangles, and points between") {
  const Crossed crossed(400);
  fails_cleanly([&](Context& context) -> Status {
    Triangulation t(context);
    Array<uint32_t> joined(context);
    Conflict conflict;
    return triangulate_region(crossed.region(), &t, &joined, &conflict);
  });
}

TEST_CASE("faults: a mesh with interior points, evened out") {
  const Crossed crossed(20);
  fails_cleanly([&](Context& context) -> Status {
    PolygonMesh mesh(context);
    TRY(mesh_region(context, crossed.region(), 0.08, &mesh));
    return mesh.points.size() > crossed.points.size() ? Status{} : fail(Code::bad_mesh, "too few");
  });
}

TEST_CASE("faults: random points are evened out") {
  const Crossed crossed(300);
  fails_cleanly([&](Context& context) -> Status {
    Triangulation t(context);
    Array<uint32_t> joined(context);
    Array<double> sizes(context);
    Conflict conflict;
    TRY(triangulate_region(crossed.region(), &t, &joined, &conflict));
    TRY(sizes.assign(t.points.size(), 0.1));
    return relax(&t, sizes.span(), k_box_corners + 6, k_box_corners + 6, 4);
  });
}
