#include "surface/flow_measure.h"

#include "base/in_parts.h"
#include "num/minmax.h"

namespace wireskin {

namespace {

// Where on the arcs a vertex of theirs lies: between two places of Samples::at.
struct ArcPlace {
  uint32_t first, last;  // of its arc; equal: it is on none
  uint32_t before;
};

}  // namespace

static Status place_vertices(const flow::Flow& flow, Array<ArcPlace>* places) {
  const flow::Arcs& arcs = flow.arcs;
  const flow::Samples& samples = flow.samples;
  Pace pace(places->context());
  TRY(assign_in_parts(arcs.vertex.size(), ArcPlace{0, 0, 0}, places));
  for (uint32_t a = 0; a < arcs.size(); ++a) {
    const uint32_t first = samples.start[a], last = samples.start[a + 1] - 1;
    uint32_t at = first;
    for (uint32_t i = arcs.start[a]; i < arcs.start[a + 1]; ++i) {
      TRY(pace.after());
      while (at + 1 < last && samples.along[at + 1] <= arcs.along[i]) ++at;
      (*places)[arcs.path[i]] = {first, last, at};
    }
  }
  return {};
}

static double square_to_edge(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a, e = p - a;
  const double square = dot(d, d);
  const double share = square > 0.0 ? smaller(larger(dot(d, e) / square, 0.0), 1.0) : 0.0;
  const Vec3 across = e - share * d;
  return dot(across, across);
}

Status measure_given(const flow::Flow& flow, Span<const Vec3> given, Span<const uint32_t> vertex_of,
                     Surface* surface) {
  Array<ArcPlace> places(surface->position.context());
  TRY(place_vertices(flow, &places));
  double greatest = 0.0, sum = 0.0;
  TRY(in_parts(places.context(), given.size(), [&](size_t s) {
    const ArcPlace& place = places[flow.arcs.sample_vertex[s]];
    if (place.first == place.last) return;
    // Noise may have brought the sample beside a neighbour of its edge.
    const uint32_t low = place.before > place.first ? place.before - 1 : place.first;
    const uint32_t high = place.before + 2 < place.last ? place.before + 2 : place.last;
    double least = DBL_MAX;
    for (uint32_t i = low; i < high; ++i) {
      const Vec3& a = surface->position[vertex_of[flow.samples.at[i]]];
      const Vec3& b = surface->position[vertex_of[flow.samples.at[i + 1]]];
      least = smaller(least, square_to_edge(given[s], a, b));
    }
    greatest = larger(greatest, least);
    sum += least;
  }));
  surface->counts.greatest_distance = std::sqrt(greatest);
  if (!given.empty())
    surface->counts.mean_square_distance = sum / static_cast<double>(given.size());
  return {};
}

}  // namespace wireskin
