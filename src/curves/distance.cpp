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

Status distance_to_line(Span<const Vec3> samples, Span<const Vec3> line, bool closed, Pace* pace,
                        LineDistance* result) {
  // The search begins a little before the last nearest edge, and goes on beyond the nearest one so
  // far for this many edges and for the way that the samples went.
  constexpr size_t k_back = 4, k_patience = 16;
  *result = {};
  if (line.size() < 2) return {};
  const size_t edges = line.size() - 1;
  size_t from = 0;
  for (size_t i = 0; i < samples.size(); ++i) {
    double best = -1.0;
    size_t nearest = from, misses = 0;
    const double way = i > 0 ? 2.0 * length(samples[i] - samples[i - 1]) : 0.0;
    double walked = 0.0;  // since the nearest edge
    from =
        closed ? (from + edges - k_back % edges) % edges : from - (from < k_back ? from : k_back);
    for (size_t step = 0; step < edges; ++step) {
      if (!closed && from + step >= edges) break;
      TRY(pace->after());
      const size_t e = (from + step) % edges;
      const double square = square_distance(samples[i], line[e], line[e + 1]);
      if (best < 0.0 || square < best) {
        best = square;
        nearest = e;
        misses = 0;
        walked = 0.0;
        continue;
      }
      walked += length(line[e + 1] - line[e]);
      if (i > 0 && ++misses > k_patience && walked > way) {
        break;  // the first sample of a closed curve may be anywhere
      }
    }
    from = nearest;
    result->sum_of_squares += best;
    if (best > result->greatest * result->greatest) result->greatest = std::sqrt(best);
  }
  return {};
}

}  // namespace wireskin::curves
