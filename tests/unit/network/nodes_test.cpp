#include "network/nodes.h"

#include <doctest/doctest.h>

#include "support/context.h"

using namespace unit;
using namespace wireskin::network;

namespace {

struct Input {
  std::vector<uint32_t> start, number;
  std::vector<Vec3> position, normal;

  // Curves of these numbers; every number n lies at (n, 0, 0), samples without number elsewhere.
  explicit Input(const std::vector<std::vector<uint32_t>>& curves) {
    start = {0};
    for (const auto& curve : curves) {
      for (uint32_t n : curve) {
        number.push_back(n);
        const double x = n == k_none ? -static_cast<double>(number.size()) : n;
        position.push_back({x, 0, 0});
        normal.push_back({0, 0, 1});
      }
      start.push_back(static_cast<uint32_t>(number.size()));
    }
  }
};

struct Found {
  Heap heap;
  Array<Node> nodes{heap.context};
  Array<uint32_t> of_sample{heap.context};
  Status status;

  explicit Found(const Input& i, double tolerance = 1e-9) {
    status = find_nodes({view(i.start), view(i.number), view(i.position), view(i.normal)},
                        tolerance, &nodes, &of_sample);
  }
};

using Indices = std::vector<uint32_t>;

}  // namespace

TEST_CASE("nodes: numbers that occur twice, in ascending order") {
  const Found f(Input({{7, k_none, 3, 9}, {3, 1, 7}, {k_none, 1, 5}}));
  REQUIRE(f.status.ok());
  REQUIRE(f.nodes.size() == 3);
  CHECK(f.nodes[0].number == 1);
  CHECK(f.nodes[1].number == 3);
  CHECK(f.nodes[2].number == 7);
  CHECK(f.nodes[2].position == Vec3{7, 0, 0});
  CHECK(to_vector(f.of_sample) == Indices{2, k_none, 1, k_none, 1, 0, 2, k_none, 0, k_none});
}

TEST_CASE("nodes: twice in one curve, the greatest number, and none") {
  const Found f(Input({{4, k_none, 4}, {0xfffffffe, 2}, {0xfffffffe, 0}}));
  REQUIRE(f.nodes.size() == 2);
  CHECK(f.nodes[0].number == 4);
  CHECK(f.nodes[1].number == 0xfffffffe);
  CHECK(f.of_sample[0] == 0);
  CHECK(f.of_sample[2] == 0);
  const Found none(Input({{k_none, k_none}, {1, 2}, {}, {3}}));
  CHECK(none.status.ok());
  CHECK(none.nodes.empty());
  CHECK(to_vector(none.of_sample) == Indices(5, k_none));
}

TEST_CASE("nodes: samples farther apart than the tolerance are named") {
  Input input({{k_none, 5}, {}, {1, 2, 5}});
  input.position[4].y = 1e-3;
  CHECK(Found(input, 2e-3).status.ok());
  CHECK(Found(input, 2e-3).nodes[0].position == Vec3{5, 0, 0});  // that of the first sample
  const Status s = Found(input, 5e-4).status;
  CHECK(s.code == Code::node_mismatch);
  CHECK(s.place.curve == 2);
  CHECK(s.place.sample == 2);
  CHECK(s.place.node == 5);
}

TEST_CASE("nodes: normals are averaged, opposed ones refused") {
  Input input({{5, 1}, {5, 2}, {5, 3}});
  input.normal[2] = {0, 1, 0};
  input.normal[4] = {1, 0, 0};
  const Found f(input);
  REQUIRE(f.status.ok());
  CHECK(wireskin::length(f.nodes[0].normal - wireskin::unit({1, 1, 1})) < 1e-15);
  input.normal[4] = {0, 0, -1};
  const Status s = Found(input).status;
  CHECK(s.code == Code::inconsistent_normals);
  CHECK(s.place.node == 5);
  CHECK(s.place.curve == 0);  // the sum is (0, 1, 0), to which the first one is at a right angle
  CHECK(s.place.sample == 0);
  Input two({{5, 1}, {5, 2}});
  two.normal[2] = {0, 0, -1};
  CHECK(Found(two).status.code == Code::inconsistent_normals);
}
