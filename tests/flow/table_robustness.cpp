// How the reconstruction bears noise, and curves added and taken away: prints a table.
//
//     flow_table [FOLDER [noise|removal]]
//
// FOLDER holds networks (.obj with l) and expected.csv; the shapes made in unseen.h are always in.
// Noise moves every vertex of the polylines by a Gaussian of the given part of the diagonal; the
// curves are smoothed afterwards along themselves by a moving mean as wide as the noise asks for,
// with their ends, where curves meet, held. A network keeps its result if Betti numbers, patches
// and annuli are those it had before.
#include <cstdio>
#include <fstream>

#include "flow/run.h"
#include "flow/unseen.h"

namespace flow_tests {

struct Shape {
  std::string name;
  Net net;
  int32_t voids;
};

static std::vector<Shape> shapes_of(const std::string& folder) {
  std::vector<Shape> shapes;
  for (const Expected& e : unseen_networks()) shapes.push_back({e.name, e.net, e.voids});
  std::ifstream in(folder + "/expected.csv");
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const bool left_out = line.find("KNOWN") != std::string::npos;
    if (left_out || line.find("torus_dense") != std::string::npos) continue;
    const std::string file = line.substr(0, line.find(','));
    // The seventh field; none before it is quoted.
    size_t field = 0;
    for (int k = 0; k < 6; ++k) field = line.find(',', field) + 1;
    const int32_t voids = line.compare(field, 4, "auto") == 0 ? -1 : std::atoi(&line[field]);
    shapes.push_back({file, read_obj(folder + "/" + file), voids});
  }
  return shapes;
}

// Straight curves of two vertices get vertices to be noisy at, a fiftieth of the diagonal apart.
static Net refined(const Net& net) {
  Net fine;
  fine.vertex = net.vertex;
  const double step = 0.02 * diagonal_of(net);
  for (const auto& curve : net.curve) {
    std::vector<uint32_t> path = {curve[0]};
    for (size_t i = 1; i < curve.size(); ++i) {
      const Vec3 a = net.vertex[curve[i - 1]], b = net.vertex[curve[i]];
      const int pieces = std::max(1, int(length(b - a) / step));
      for (int k = 1; k < pieces; ++k) path.push_back(fine.add(a + (double(k) / pieces) * (b - a)));
      path.push_back(curve[i]);
    }
    fine.curve.push_back(path);
  }
  return fine;
}

static double gaussian(unit::Random& random) {
  double sum = 0.0;
  for (int i = 0; i < 12; ++i) sum += 0.5 * random();
  return sum;
}

static Net noisy(const Net& net, double sigma, bool smooth, uint32_t seed) {
  Net result = refined(net);
  unit::Random random(seed);
  const double size = sigma * diagonal_of(net);
  std::vector<int> uses(result.vertex.size(), 0);
  for (Vec3& p : result.vertex)
    p += size * Vec3{gaussian(random), gaussian(random), gaussian(random)};
  if (!smooth) return result;
  for (const auto& curve : result.curve) {
    const bool loop = curve.front() == curve.back();
    for (size_t i = 0; i + (loop ? 1 : 0) < curve.size(); ++i) ++uses[curve[i]];
  }
  const int sweeps = sigma < 0.0015 ? 4 : sigma < 0.004 ? 12 : sigma < 0.01 ? 40 : 150;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const std::vector<Vec3> before = result.vertex;
    for (const auto& curve : result.curve) {
      const size_t n = curve.size();
      const bool loop = n > 2 && curve.front() == curve.back();
      for (size_t i = 0; i < n; ++i) {
        if (uses[curve[i]] > 1 || (!loop && (i == 0 || i + 1 == n))) continue;
        if (loop && i + 1 == n) continue;
        const Vec3& a = before[curve[i == 0 ? n - 2 : i - 1]];
        const Vec3& b = before[curve[i + 1]];
        result.vertex[curve[i]] = 0.5 * before[curve[i]] + 0.25 * (a + b);
      }
    }
  }
  return result;
}

static bool same(const Run& a, const Run& b) {
  return std::equal(a.betti, a.betti + 3, b.betti) && a.patches == b.patches &&
         a.annuli == b.annuli;
}

static void print_noise(const std::vector<Shape>& shapes) {
  const double sigmas[] = {0.001, 0.002, 0.006, 0.02, 0.1};
  std::printf(
      "| noise (of the diagonal) | kept, smoothed | kept, as they are | of |\n|---|---|---|---|\n");
  for (const double sigma : sigmas) {
    int kept[2] = {0, 0};
    std::string lost;
    for (const Shape& shape : shapes) {
      const RunOptions options = {0.02, 0, shape.voids, false, false};
      const Run plain = run(shape.net, options);
      for (int smooth = 0; smooth < 2; ++smooth) {
        bool ok = false;
        try {
          ok = same(plain, run(noisy(shape.net, sigma, smooth == 1, 17), options));
        } catch (const std::exception&) {
        }
        kept[smooth] += ok;
        if (smooth == 1 && !ok) lost += " " + shape.name + ";";
      }
    }
    std::printf("| %.1f %% | %d | %d | %zu |\n", 100 * sigma, kept[1], kept[0], shapes.size());
    std::fflush(stdout);
    std::fprintf(stderr, "%.3f lost when smoothed:%s\n", sigma, lost.c_str());
  }
}

// Each curve taken away in turn: how many patches are not among those of the whole network.
static void print_removal(const std::vector<Shape>& shapes) {
  std::printf(
      "\n| curve taken away from | patches | changed, mean | changed, most |\n|---|---|---|---|\n");
  for (const Shape& shape : shapes) {
    if (shape.net.curve.size() > 40 || shape.net.curve.size() < 3) continue;
    const RunOptions options = {0.02, 0, shape.voids, false, false};
    const Run whole = run(shape.net, options);
    size_t sum = 0, most = 0;
    for (size_t c = 0; c < shape.net.curve.size(); ++c) {
      Net less = shape.net;
      less.curve.erase(less.curve.begin() + std::ptrdiff_t(c));
      const Run r = run(less, options);
      std::vector<double> rest = whole.areas;
      size_t changed = 0;
      for (const double area : r.areas) {
        const auto found = std::find_if(rest.begin(), rest.end(), [&](double other) {
          return std::fabs(other - area) < 0.02 * area;
        });
        if (found == rest.end()) {
          ++changed;
        } else {
          rest.erase(found);
        }
      }
      sum += changed;
      most = std::max(most, changed);
    }
    std::printf("| %s | %u | %.1f | %zu |\n", shape.name.c_str(), whole.patches,
                double(sum) / double(shape.net.curve.size()), most);
    std::fflush(stdout);
  }
}

}  // namespace flow_tests

int main(int argc, char** argv) {
  const std::string folder = argc > 1 ? argv[1] : std::string(WIRESKIN_TEST_DATA) + "/flow-tests";
  const std::vector<flow_tests::Shape> shapes = flow_tests::shapes_of(folder);
  const std::string part = argc > 2 ? argv[2] : "";
  if (part != "removal") flow_tests::print_noise(shapes);
  if (part != "noise") flow_tests::print_removal(shapes);
  return 0;
}
