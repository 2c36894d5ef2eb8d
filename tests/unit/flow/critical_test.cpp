#include "flow/critical.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>

#include "unit/flow/flow_sets.h"

using namespace wireskin;
using namespace unit;
using flow::Complex;
using flow::CriticalPoints;

namespace {

using Real = long double;

struct Found {
  Complex complex;
  CriticalPoints critical;

  Found(Heap& heap, const Points& points, double jitter)
      : complex(heap.context), critical(heap.context) {
    flow::ComplexOptions options;
    options.jitter = jitter;
    must(flow::build_complex(heap.context, view(points), options, &complex));
    must(flow::find_critical_points(complex, &critical));
    CHECK(critical.euler() == 1);
  }

  std::string counts() const {
    return std::to_string(critical.edge.size()) + "/" + std::to_string(critical.triangle.size()) +
           "/" + std::to_string(critical.tet.size());
  }

  // Vertices of all critical simplices.
  std::vector<std::vector<uint32_t>> simplices() const {
    std::vector<std::vector<uint32_t>> all;
    const auto add = [&all](const Array<uint32_t>& list, const Array<uint32_t>& vertices,
                            size_t n) {
      for (const uint32_t s : list) {
        std::vector<uint32_t> one(vertices.begin() + n * s, vertices.begin() + n * (s + 1));
        std::sort(one.begin(), one.end());
        all.push_back(one);
      }
    };
    add(critical.edge, complex.edge, 2);
    add(critical.triangle, complex.triangle, 3);
    add(critical.tet, complex.tet, 4);
    return all;
  }
};

// Circumcentre of two to four points as weights of the points: solves the normal equations of the
// differences by elimination. Positive weights: the centre lies inside the simplex.
std::vector<Real> centre_weights(const Points& p, const std::vector<uint32_t>& s) {
  const size_t n = s.size() - 1;
  Real d[3][3] = {}, m[3][4] = {};
  for (size_t i = 0; i < n; ++i) {
    d[i][0] = Real{p[s[i + 1]].x} - p[s[0]].x;
    d[i][1] = Real{p[s[i + 1]].y} - p[s[0]].y;
    d[i][2] = Real{p[s[i + 1]].z} - p[s[0]].z;
  }
  for (size_t i = 0; i < n; ++i) {
    for (size_t k = 0; k < n; ++k)
      m[i][k] = d[i][0] * d[k][0] + d[i][1] * d[k][1] + d[i][2] * d[k][2];
    m[i][3] = m[i][i] / 2;
  }
  for (size_t i = 0; i < n; ++i) {
    for (size_t k = 0; k < n; ++k) {
      if (k == i) continue;
      const Real f = m[k][i] / m[i][i];
      for (size_t c = 0; c < 4; ++c) m[k][c] -= f * m[i][c];
    }
  }
  std::vector<Real> w = {1};
  for (size_t i = 0; i < n; ++i) {
    w.push_back(m[i][3] / m[i][i]);
    w[0] -= w.back();
  }
  return w;
}

struct Centre {
  Real x = 0, y = 0, z = 0;
  Real squared_distance(const Vec3& q) const {
    return (q.x - x) * (q.x - x) + (q.y - y) * (q.y - y) + (q.z - z) * (q.z - z);
  }
};

Centre centre_of(const Points& p, const std::vector<uint32_t>& s) {
  const std::vector<Real> w = centre_weights(p, s);
  Centre c;
  for (size_t i = 0; i < s.size(); ++i) {
    c.x += w[i] * p[s[i]].x;
    c.y += w[i] * p[s[i]].y;
    c.z += w[i] * p[s[i]].z;
  }
  return c;
}

// By the definition alone: the circumcentre lies inside the simplex and no point is closer.
bool critical_by_definition(const Points& p, const std::vector<uint32_t>& s) {
  for (const Real w : centre_weights(p, s)) {
    if (!(w > 0)) return false;
  }
  const Centre c = centre_of(p, s);
  const Real radius = c.squared_distance(p[s[0]]);
  for (uint32_t i = 0; i < p.size(); ++i) {
    if (std::find(s.begin(), s.end(), i) == s.end() && c.squared_distance(p[i]) < radius)
      return false;
  }
  return true;
}

void subsets(uint32_t from, uint32_t n, std::vector<uint32_t>* s,
             std::vector<std::vector<uint32_t>>* all) {
  if (s->size() >= 2) all->push_back(*s);
  if (s->size() == 4) return;
  for (uint32_t i = from; i < n; ++i) {
    s->push_back(i);
    subsets(i + 1, n, s, all);
    s->pop_back();
  }
}

// Critical simplices of one place, which a jitter has torn apart, are one critical point with the
// greatest index among them, or none where they cancel (a right angle: its edge and its triangle).
std::string merged_counts(const Found& found, const Points& p) {
  const double near = 1e-5 * found.complex.diagonal;
  struct Place {
    Centre centre;
    size_t index;
    int64_t euler;
  };
  std::vector<Place> places;
  Points moved(found.complex.point.begin(), found.complex.point.end());
  CHECK(moved.size() == p.size());
  for (const std::vector<uint32_t>& s : found.simplices()) {
    const Centre c = centre_of(moved, s);
    const size_t index = s.size() - 1;
    const int64_t sign = index % 2 == 0 ? 1 : -1;
    bool known = false;
    for (Place& place : places) {
      const Centre& o = place.centre;
      if (c.squared_distance({double(o.x), double(o.y), double(o.z)}) > Real{near} * near) continue;
      place.index = std::max(place.index, index);
      place.euler += sign;
      known = true;
      break;
    }
    if (!known) places.push_back({c, index, sign});
  }
  size_t count[4] = {};
  for (const Place& place : places) {
    if (place.euler == 0) continue;
    CHECK(place.euler == (place.index % 2 == 0 ? 1 : -1));
    ++count[place.index];
  }
  return std::to_string(count[1]) + "/" + std::to_string(count[2]) + "/" + std::to_string(count[3]);
}

const std::string k_data = WIRESKIN_TEST_DATA;

}  // namespace

TEST_CASE("critical points of small random sets are those of the definition") {
  Random random(5);
  for (int round = 0; round < 60; ++round) {
    const Points p = random_points(4 + random.below(12), random);
    Heap heap;
    const Found found(heap, p, 0.0);
    std::vector<std::vector<uint32_t>> all, expected;
    std::vector<uint32_t> s;
    subsets(0, static_cast<uint32_t>(p.size()), &s, &all);
    for (const auto& one : all) {
      if (critical_by_definition(p, one)) expected.push_back(one);
    }
    std::vector<std::vector<uint32_t>> got = found.simplices();
    std::sort(got.begin(), got.end());
    std::sort(expected.begin(), expected.end());
    CHECK(got == expected);
  }
}

TEST_CASE("critical points of a cube, an octahedron and a circle, ties merged") {
  const auto merged = [](const Points& p) {
    Heap heap;
    const Found found(heap, p, 1e-7);
    return merged_counts(found, p);
  };
  CHECK(merged(cube_corners()) == "12/6/1");
  CHECK(merged(octahedron_corners()) == "12/8/1");
  CHECK(merged(tetrahedron_corners()) == "6/4/1");
  Points circle;
  add_circle({1, 2, 3}, {0.6, 0.8, 0}, {0, 0, 1}, 24, &circle);
  CHECK(merged(circle) == "24/1/0");
  CHECK(merged(coaxial_circles(0.5, 24)) == "72/26/1");
}

TEST_CASE("reference counts of critical points: sets without ties exactly, others merged") {
  const auto rows = read_table(k_data + "/flow-reference/counts.csv");
  if (rows.empty()) {
    std::printf("skipped: flow-reference is not in WIRESKIN_TEST_DATA\n");
    return;
  }
  size_t exact = 0, tied = 0;
  for (const auto& row : rows) {
    CAPTURE(row[0]);
    const std::string truth = row.back();
    const Points p = read_points(k_data + "/flow-reference/" + row[0] + ".xyz");
    REQUIRE(p.size() == std::stoul(row[1]));
    Heap heap;
    const Found jittered(heap, p, 1e-7);
    if (truth == "unknown") continue;
    if (row[5] == "0") {
      CHECK(Found(heap, p, 0.0).counts() == truth);
      CHECK(jittered.counts() == truth);
      ++exact;
    } else {
      CHECK(merged_counts(jittered, p) == truth);
      ++tied;
    }
  }
  CHECK(exact >= 13);
  CHECK(tied >= 6);
}

TEST_CASE("reference counts of critical points of real data") {
  const auto rows = read_table(k_data + "/flow-reference/real_counts.csv");
  if (rows.empty()) {
    std::printf("skipped: flow-reference is not in WIRESKIN_TEST_DATA\n");
    return;
  }
  size_t compared = 0;
  for (const auto& row : rows) {
    CAPTURE(row[0]);
    const std::string path = row[5].substr(0, row[5].find(' '));
    if (path.find(".net") != std::string::npos) continue;
    const Points p = read_points(k_data + "/" + path);
    REQUIRE(p.size() == std::stoul(row[1]));
    Heap heap;
    CHECK(Found(heap, p, 0.0).counts() == row[2] + "/" + row[3] + "/" + row[4]);
    CHECK(Found(heap, p, 1e-7).critical.points == p.size());
    ++compared;
  }
  CHECK(compared >= 15);
}
