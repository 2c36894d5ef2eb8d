#include "mesh/check.h"

#include <doctest/doctest.h>

#include <limits>
#include <string>

#include "support/context.h"

using namespace unit;
using namespace wireskin;
using namespace wireskin::mesh;

namespace {

// Two patches that share an edge: a square in the plane, counter-clockwise from above, in four
// triangles round its middle, and one triangle that stands on its right side.
struct Subject {
  std::vector<Vec3> position{{0, 0, 0}, {1, 0, 0},     {1, 1, 0},
                             {0, 1, 0}, {0.5, 0.5, 0}, {1, 0.5, 1}};
  std::vector<uint32_t> triangle{0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 2, 1, 5};
  std::vector<uint32_t> patch{0, 0, 0, 0, 1};
  std::vector<uint32_t> edge{0, 1, 1, 2, 3, 2, 0, 3, 2, 5};
  std::vector<Vec3> normal{{0, 0, 1}, {0, 0, 0}};
  int32_t euler = 1;
  bool may_fold = false;

  Status check() const {
    Heap heap;
    Expectations e;
    e.position = view(position);
    e.triangle = view(triangle);
    e.patch = view(patch);
    e.edge = view(edge);
    e.patch_normal = view(normal);
    e.euler_characteristic = &euler;
    e.may_fold = may_fold;
    return wireskin::mesh::check(heap.context, e);
  }
};

void expect(const Status& status, Code code, uint32_t vertex, uint32_t triangle,
            const char* sentence) {
  CHECK(status.code == code);
  CHECK(status.place.vertex == vertex);
  CHECK(status.place.triangle == triangle);
  CHECK(std::string(status.sentence).find(sentence) != std::string::npos);
}

}  // namespace

TEST_CASE("a good mesh passes, with and without what is expected of it") {
  Subject s;
  CHECK(s.check().ok());
  s.edge.clear();
  s.normal.clear();
  s.patch.clear();
  CHECK(s.check().ok());
}

TEST_CASE("indices, orientation and fans") {
  Subject s;
  s.triangle[4] = 9;
  expect(s.check(), Code::index_out_of_range, k_none, 1, "does not exist");
  s = Subject();
  std::swap(s.triangle[3], s.triangle[4]);
  CHECK(s.check().code == Code::bad_mesh);
  s = Subject();
  s.position.push_back({7, 7, 7});
  expect(s.check(), Code::bad_mesh, 6, k_none, "");
  // A second triangle on the edge 1-2 that runs like the first.
  s = Subject();
  s.triangle.insert(s.triangle.end(), {1, 2, 5});
  s.patch.push_back(1);
  CHECK(s.check().code == Code::bad_mesh);
  // A triangle that touches the middle of the square only.
  s = Subject();
  s.position.insert(s.position.end(), {{3, 0, 1}, {3, 1, 1}});
  s.triangle.insert(s.triangle.end(), {4, 6, 7});
  s.patch.push_back(1);
  expect(s.check(), Code::bad_mesh, 4, k_none, "");
}

TEST_CASE("an edge of a curve that the mesh does not have") {
  Subject s;
  s.edge.insert(s.edge.end(), {3, 1});
  expect(s.check(), Code::bad_mesh, 3, k_none, "curve");
  s.edge.back() = 12;
  expect(s.check(), Code::index_out_of_range, 12, k_none, "edge");
}

TEST_CASE("the Euler characteristic") {
  Subject s;
  s.euler = 2;
  expect(s.check(), Code::bad_mesh, k_none, k_none, "Euler");
}

TEST_CASE("coordinates, areas, facing and folds") {
  Subject s;
  s.position[4].y = std::numeric_limits<double>::quiet_NaN();
  expect(s.check(), Code::not_a_number, 4, k_none, "finite");
  s = Subject();
  s.position[4] = {0.5, 0.0, 0.0};
  expect(s.check(), Code::bad_mesh, k_none, 0, "no area");
  s.position[4] = {0.5, 1e-13, 0.0};
  CHECK(s.check().ok());
  s.position[4] = {0.5, 1e-15, 0.0};
  expect(s.check(), Code::bad_mesh, k_none, 0, "no area");
  s = Subject();
  s.position[4] = {0.5, -0.25, 0.0};
  expect(s.check(), Code::bad_mesh, k_none, 0, "faces against");
  s.normal.clear();
  expect(s.check(), Code::bad_mesh, k_none, 0, "folded");
  s.may_fold = true;
  CHECK(s.check().ok());
}

TEST_CASE("patches that do not fit the triangles") {
  Subject s;
  s.patch.pop_back();
  CHECK(s.check().code == Code::bad_mesh);
  s = Subject();
  s.patch[2] = 5;
  expect(s.check(), Code::bad_mesh, k_none, 2, "patch");
}
