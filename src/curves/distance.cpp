#include "curves/distance.h"

namespace wireskin::curves {

static double square_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 edge = b - a;
  const double square = dot(edge, edge);
  double t = square > 0.0 ? dot(p - a, edge) / square : 0.0;
  t = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
  const Vec3 d = p - (a + t * edge);
  return dot(d, d);
}

LineDistance distance_to_line(Span<const Vec3> samples, Span<const Vec3> line, bool closed) {
  // Beyond the nearest edge so far the search goes on this many edges without finding a nearer one.
  constexpr size_t k_patience = 16;
  LineDistance result;
  if (line.size() < 2) return result;
  const size_t edges = line.size() - 1;
  size_t from = 0;
  for (size_t i = 0; i < samples.size(); ++i) {
    double best = -1.0;
    size_t nearest = from, misses = 0;
    for (size_t step = 0; step < edges; ++step) {
      if (!closed && from + step >= edges) break;
      const size_t e = (from + step) % edges;
      const double square = square_distance(samples[i], line[e], line[e + 1]);
      if (best < 0.0 || square < best) {
        best = square;
        nearest = e;
        misses = 0;
      } else if (i > 0 && ++misses > k_patience) {
        break;  // the first sample of a closed curve may be anywhere
      }
    }
    from = nearest;
    result.sum_of_squares += best;
    if (best > result.greatest * result.greatest) result.greatest = std::sqrt(best);
  }
  return result;
}

}  // namespace wireskin::curves
