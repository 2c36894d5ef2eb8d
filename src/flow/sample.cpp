#include "flow/sample.h"

#include "base/in_parts.h"
#include "flow/point_grid.h"
#include "num/minmax.h"

namespace wireskin::flow {

static constexpr double k_least_step = 0.02;  // of the greatest one
static constexpr uint32_t k_least_pieces = 3, k_least_pieces_of_loop = 6;
static constexpr size_t k_most_samples = size_t{1} << 24;

namespace {

// Positions by arc length, for queries that walk forward.
struct ArcWalk {
  const Arcs& arcs;
  uint32_t step;

  ArcWalk(const Arcs& all, uint32_t arc) : arcs(all), step(all.start[arc]) {}
  void go_back(uint32_t to) { step = to; }
  Vec3 at(double along, uint32_t last_step) {
    while (step < last_step && arcs.along[step + 1] < along) ++step;
    if (arcs.along[step + 1] == along) return arcs.vertex[arcs.path[step + 1]];
    const double length = arcs.along[step + 1] - arcs.along[step];
    const double share = length > 0.0 ? (along - arcs.along[step]) / length : 0.0;
    const Vec3 &a = arcs.vertex[arcs.path[step]], &b = arcs.vertex[arcs.path[step + 1]];
    return a + smaller(larger(share, 0.0), 1.0) * (b - a);
  }
};

// Points along the arcs that are only used to measure how near arcs come to each other.
struct CoarseArcs {
  Array<uint32_t> start, arc;
  Array<Vec3> point;

  explicit CoarseArcs(Context& context) : start(context), arc(context), point(context) {}
};

// Arc lengths of the samples; arc a has along[start[a]] .. along[start[a + 1] - 1], ends included.
struct Stations {
  Array<uint32_t> start;
  Array<double> along;

  explicit Stations(Context& context) : start(context), along(context) {}
};

// The stations of one arc; fixed ones stay where they are.
struct StationLine {
  Array<double> along;
  Array<uint8_t> fixed;

  explicit StationLine(Context& context) : along(context), fixed(context) {}
  void clear() {
    along.clear();
    fixed.clear();
  }
  Status push(double at, uint8_t is_fixed) {
    TRY(along.push(at));
    return fixed.push(is_fixed);
  }
  Status copy(const StationLine& other) {
    TRY(along.copy(other.along.span()));
    return fixed.copy(other.fixed.span());
  }
};

// A sample in the diametral ball of a segment.
struct Encroacher {
  uint32_t sample = k_none;
  double share = 0.0;     // of the segment, up to its foot
  double gap = 0.0;       // its distance from there
  double from_end = 0.0;  // along the segment
};

}  // namespace

static uint32_t pieces_for(double length, double step) {
  const double wished = length / step;
  if (!(wished < 1e9)) return 1000000000u;
  const uint32_t pieces = static_cast<uint32_t>(wished);
  return pieces * step < length ? pieces + 1 : pieces;
}

static double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a, e = p - a;
  const double square = dot(d, d);
  const double share = square > 0.0 ? smaller(larger(dot(d, e) / square, 0.0), 1.0) : 0.0;
  return length(e - share * d);
}

static Status coarsen_arcs(Context& context, const Arcs& arcs, double step, CoarseArcs* coarse) {
  Pace pace(context);
  TRY(coarse->start.push(0));
  for (uint32_t a = 0; a < arcs.size(); ++a) {
    const double whole = arcs.length_of(a);
    const uint32_t pieces = pieces_for(whole, step) < 4 ? 4 : pieces_for(whole, step);
    if (coarse->point.size() + pieces > k_most_samples) {
      return fail(Code::too_large, "the step is too small for the curves");
    }
    ArcWalk walk(arcs, a);
    for (uint32_t i = 0; i <= pieces; ++i) {
      const uint32_t from = walk.step;
      TRY(coarse->point.push(walk.at(whole * i / pieces, arcs.start[a + 1] - 2)));
      TRY(coarse->arc.push(a));
      TRY(pace.after(1 + walk.step - from));
    }
    TRY(coarse->start.push(static_cast<uint32_t>(coarse->point.size())));
  }
  return {};
}

// How far arc a strays from arc b, as soon as that is known to reach `enough`.
static double stray(const CoarseArcs& coarse, uint32_t a, uint32_t b, double enough, Pace* pace) {
  double greatest = 0.0;
  const uint32_t first = coarse.start[a], count = coarse.start[a + 1] - first;
  for (uint32_t i = 0; i < count && greatest < enough; ++i) {
    // From the middle on, where an arc that only crosses or continues this one is found far
    // soonest.
    const Vec3& p = coarse.point[first + (count / 2 + i) % count];
    double least = DBL_MAX;
    for (uint32_t j = coarse.start[b]; j + 1 < coarse.start[b + 1] && least > greatest; ++j) {
      least = smaller(least, distance_to_segment(p, coarse.point[j], coarse.point[j + 1]));
      pace->add(1);
    }
    greatest = larger(greatest, least);
  }
  return greatest;
}

// The greatest step of each arc: half its distance to the nearest other one.
static Status choose_steps(Context& context, const Arcs& arcs, double greatest_step,
                           Array<double>* steps) {
  CoarseArcs coarse(context);
  PointGrid grid(context);
  Array<uint32_t> seen(context);
  Pace pace(context);
  const double spacing = 0.5 * greatest_step;
  TRY(steps->assign(arcs.size(), greatest_step));
  TRY(coarsen_arcs(context, arcs, spacing, &coarse));
  TRY(grid.build(coarse.point.span()));
  TRY(seen.assign(arcs.size(), k_none));
  for (uint32_t a = 0; a < arcs.size(); ++a) {
    TRY(pace.after());
    double nearest = 2.0 * greatest_step;
    const uint32_t middle = coarse.start[a] + (coarse.start[a + 1] - coarse.start[a]) / 2;
    seen[a] = a;
    grid.any_near(coarse.point[middle], nearest + spacing, [&](uint32_t near) {
      const uint32_t b = coarse.arc[near];
      if (seen[b] == a) return false;
      seen[b] = a;
      const double distance = stray(coarse, a, b, nearest, &pace);
      if (distance > k_same_curve * arcs.diagonal) nearest = smaller(nearest, distance);
      return false;
    });
    (*steps)[a] = larger(0.5 * nearest, k_least_step * greatest_step);
  }
  return {};
}

static bool is_loop(const Arcs& arcs, uint32_t a) {
  return arcs.path[arcs.start[a]] == arcs.path[arcs.start[a + 1] - 1];
}

// The place on the arc's path, strictly between two lengths, that lies farthest from the chord
// between these; k_none if none is farther than `tolerance`. The walk goes on to the end.
static uint32_t worst_between(const Arcs& arcs, uint32_t a, double from, double to,
                              double tolerance, ArcWalk* walk) {
  const uint32_t last_step = arcs.start[a + 1] - 2;
  const Vec3 p = walk->at(from, last_step);
  const uint32_t first = walk->step + 1;
  const Vec3 q = walk->at(to, last_step);
  uint32_t worst = k_none;
  for (uint32_t i = first; i <= last_step && arcs.along[i] < to; ++i) {
    if (!(arcs.along[i] > from)) continue;
    const double distance = distance_to_segment(arcs.vertex[arcs.path[i]], p, q);
    if (!(distance > tolerance)) continue;
    tolerance = distance;
    worst = i;
  }
  return worst;
}

// The step from an end of the arc, halved until the arc is nearly straight so far.
static double straight_step(const Arcs& arcs, uint32_t a, bool at_end, double step) {
  constexpr int k_most_halvings = 20;
  const double whole = arcs.length_of(a);
  for (int k = 0; k < k_most_halvings; ++k, step *= 0.5) {
    ArcWalk walk(arcs, a);
    const double from = at_end ? whole - step : 0.0, to = at_end ? whole : step;
    if (worst_between(arcs, a, from, to, k_given_distance * step, &walk) == k_none) break;
  }
  return step;
}

// Evenly from the last station on; `from` itself is one already.
static Status divide_stretch(double from, double to, double step, StationLine* line) {
  const uint32_t pieces = pieces_for(to - from, step * (1.0 + 1e-9));
  if (line->along.size() + pieces > k_most_samples) {
    return fail(Code::too_large, "curves so near to each other need too many samples");
  }
  for (uint32_t i = 1; i < pieces; ++i) TRY(line->push(from + (to - from) * i / pieces, 0));
  return line->push(to, 1);
}

// Given points that lie too far from the segments become stations, the worst of each first: a
// station nearby moves there, or else one is added. At last all points of a segment are added, so
// that the cost stays near-linear whatever the curve.
static Status take_strays(const Arcs& arcs, uint32_t a, double step, Pace* pace, StationLine* line,
                          StationLine* work) {
  constexpr int k_most_passes = 16;
  constexpr double k_near = 0.4;  // of the step
  bool any = true;
  for (int pass = 0; any && pass <= k_most_passes; ++pass) {
    ArcWalk walk(arcs, a);
    any = false;
    work->clear();
    for (size_t i = 0; i + 1 < line->along.size(); ++i) {
      const double from = line->along[i], to = line->along[i + 1];
      const uint32_t first = walk.step + 1;
      const uint32_t worst = worst_between(arcs, a, from, to, k_given_distance * step, &walk);
      TRY(pace->after(2 + walk.step - first));
      TRY(work->push(from, line->fixed[i]));
      if (worst == k_none) continue;
      any = true;
      const double at = arcs.along[worst];
      if (pass == k_most_passes) {
        for (uint32_t k = first; arcs.along[k] < to; ++k) {
          if (arcs.along[k] > from) TRY(work->push(arcs.along[k], 1));
        }
      } else if (work->fixed.back() == 0 && at - from < k_near * step) {
        work->along.back() = at;
        work->fixed.back() = 1;
      } else if (line->fixed[i + 1] == 0 && to - at < k_near * step) {
        line->along[i + 1] = at;
        line->fixed[i + 1] = 1;
        walk.go_back(first - 1);
      } else {
        TRY(work->push(at, 1));
      }
    }
    TRY(work->push(line->along.back(), 1));
    if (any) TRY(line->copy(*work));
  }
  return {};
}

// Divides every arc; at a node all arcs take the same first step, the least of their own.
static Status divide_arcs(Context& context, const Arcs& arcs, Span<const double> greatest,
                          Stations* stations) {
  Array<double> first_step(context);
  StationLine own(context), work(context);
  Pace pace(context);
  TRY(assign_in_parts(arcs.vertex.size(), DBL_MAX, &first_step));
  for (uint32_t a = 0; a < arcs.size(); ++a) {
    const uint32_t ends[2] = {arcs.path[arcs.start[a]], arcs.path[arcs.start[a + 1] - 1]};
    const uint32_t wished = pieces_for(arcs.length_of(a), greatest[a]);
    const uint32_t least = is_loop(arcs, a) ? k_least_pieces_of_loop : k_least_pieces;
    const double step = arcs.length_of(a) / (wished < least ? least : wished);
    TRY(pace.after(arcs.start[a + 1] - arcs.start[a]));
    for (uint32_t k = 0; k < 2; ++k) {
      const double straight = arcs.closed[a] != 0 ? step : straight_step(arcs, a, k == 1, step);
      first_step[ends[k]] = smaller(first_step[ends[k]], straight);
    }
  }
  TRY(stations->start.push(0));
  for (uint32_t a = 0; a < arcs.size(); ++a) {
    const double whole = arcs.length_of(a);
    const double begin = first_step[arcs.path[arcs.start[a]]];
    const double end = first_step[arcs.path[arcs.start[a + 1] - 1]];
    const double step = arcs.closed[a] != 0 ? begin : greatest[a];
    own.clear();
    TRY(own.push(0.0, 1));
    TRY(own.push(begin, arcs.closed[a] == 0));
    TRY(divide_stretch(begin, whole - end, step, &own));
    TRY(own.push(whole, 1));
    if (arcs.closed[a] != 0) own.fixed[own.fixed.size() - 2] = 0;
    TRY(take_strays(arcs, a, step, &pace, &own, &work));
    if (stations->along.size() + own.along.size() > k_most_samples) {
      return fail(Code::too_large, "curves so near to each other need too many samples");
    }
    for (const double at : own.along) TRY(stations->along.push(at));
    TRY(stations->start.push(static_cast<uint32_t>(stations->along.size())));
    TRY(pace.after(own.along.size()));
  }
  return {};
}

// Nodes and isolated points first, then the inner samples arc by arc.
static Status place_samples(Context& context, const Arcs& arcs, const Stations& stations,
                            Samples* samples) {
  const size_t room = stations.along.size();
  Array<uint32_t> sample_of(context);
  TRY(assign_in_parts(arcs.vertex.size(), k_none, &sample_of));
  TRY(samples->start.copy(stations.start.span()));
  TRY(samples->along.copy(stations.along.span()));
  TRY(samples->at.resize(room));
  TRY(samples->step.resize(room));
  TRY(samples->position.reserve(room + arcs.vertex.size()));
  TRY(samples->vertex.reserve(room + arcs.vertex.size()));
  samples->position.clear();
  samples->vertex.clear();
  const auto add = [&](const Vec3& p, uint32_t vertex) {
    if (vertex != k_none) sample_of[vertex] = static_cast<uint32_t>(samples->position.size());
    samples->position.push_reserved(p);
    samples->vertex.push_reserved(vertex);
  };
  Pace pace(context);
  for (uint32_t v = 0; v < arcs.vertex.size(); ++v) {
    TRY(pace.after());
    if (arcs.is_node[v] != 0) add(arcs.vertex[v], v);
  }
  for (const uint32_t v : arcs.point) add(arcs.vertex[v], v);
  for (uint32_t a = 0; a < arcs.size(); ++a) {
    const uint32_t first = stations.start[a], last = stations.start[a + 1] - 1;
    const uint32_t last_step = arcs.start[a + 1] - 2;
    const uint32_t begin = arcs.path[arcs.start[a]], end = arcs.path[last_step + 1];
    if (sample_of[begin] == k_none) add(arcs.vertex[begin], begin);
    ArcWalk walk(arcs, a);
    for (uint32_t i = first; i <= last; ++i) {
      const uint32_t from = walk.step;
      const Vec3 p = walk.at(stations.along[i], last_step);
      TRY(pace.after(1 + walk.step - from));
      samples->step[i] = walk.step;
      samples->at[i] = i == first  ? sample_of[begin]
                       : i == last ? sample_of[end]
                                   : static_cast<uint32_t>(samples->position.size());
      if (i != first && i != last) add(p, k_none);
    }
  }
  return {};
}

// The sample in the segment's diametral ball whose foot on it is nearest to the middle.
// Not one that all but coincides with an end.
static Encroacher find_encroacher(const PointGrid& grid, const Samples& samples, uint32_t i,
                                  double diagonal) {
  const uint32_t p = samples.at[i], q = samples.at[i + 1];
  const Vec3 &a = samples.position[p], &b = samples.position[q];
  const double square = dot(b - a, b - a);
  const double same = k_coincidence * k_coincidence * diagonal * diagonal;
  Encroacher best;
  double best_off = DBL_MAX;
  grid.any_near(0.5 * (a + b), 0.5 * length(b - a), [&](uint32_t r) {
    if (r == p || r == q) return false;
    const Vec3& c = samples.position[r];
    if (!(dot(a - c, b - c) < 0.0)) return false;
    if (dot(a - c, a - c) < same || dot(b - c, b - c) < same) return false;
    const double share = dot(c - a, b - a) / square, off = std::fabs(share - 0.5);
    if (off > best_off || (off == best_off && r > best.sample)) return false;
    best_off = off;
    best = {r, share, length(c - a - share * (b - a)), (0.5 - off) * std::sqrt(square)};
    return false;
  });
  return best;
}

static double power_of_two_near(double x) {
  double power = 1.0;
  while (power > x) power *= 0.5;
  return x - power > 2.0 * power - x ? 2.0 * power : power;
}

// Beside a node at a power of two from it, so that splits of all its arcs agree. Elsewhere at the
// foot of the sample in the ball, whose ball is then clear of it however near it is: curves that
// run side by side get samples side by side, not as many as their gap goes into their length.
// Halfway if the foot is near an end, but where the curves are as good as one.
static double split_at(const Arcs& arcs, const Samples& samples, uint32_t i,
                       const Encroacher& near) {
  constexpr double k_near_end = 0.2;
  const double foot = near.share;
  const double from = samples.along[i], to = samples.along[i + 1], half = 0.5 * (to - from);
  if (near.gap <= k_least_segment * arcs.diagonal) return from + foot * (to - from);
  const uint32_t p = samples.vertex[samples.at[i]], q = samples.vertex[samples.at[i + 1]];
  const bool at_p = p != k_none && arcs.is_node[p] != 0;
  const bool at_q = q != k_none && arcs.is_node[q] != 0;
  if (at_p != at_q) return at_p ? from + power_of_two_near(half) : to - power_of_two_near(half);
  if (foot < k_near_end || foot > 1.0 - k_near_end) return from + half;
  return from + foot * (to - from);
}

// Where splitting stops: what is nearer to a short segment than a small part of its length would
// have it divided many times over, finer than any surface between the two could show.
static bool is_crowded(const Encroacher& near, double length, double greatest_step,
                       double diagonal) {
  constexpr double k_coinciding = 0.05;  // of the length
  if (length < 2.0 * k_least_segment * diagonal) return true;
  if (near.gap <= k_least_segment * diagonal && near.from_end < k_least_segment * diagonal)
    return true;
  return length < 2.0 * k_least_step * greatest_step && near.gap < k_coinciding * length;
}

// One pass over all segments; true in *any if one was split.
static Status split_encroached(Context& context, const Arcs& arcs, double greatest_step,
                               Samples* samples, Stations* stations, bool* any) {
  PointGrid grid(context);
  TRY(grid.build(samples->position.span()));
  stations->start.clear();
  stations->along.clear();
  TRY(stations->start.push(0));
  *any = false;
  samples->too_short = 0;
  constexpr uint32_t k_segments_per_checkpoint = 1u << 12;
  uint32_t looked_at = 0;
  for (uint32_t a = 0; a + 1 < samples->start.size(); ++a) {
    const uint32_t last = samples->start[a + 1] - 1;
    for (uint32_t i = samples->start[a]; i <= last; ++i) {
      TRY(stations->along.push(samples->along[i]));
      if (++looked_at % k_segments_per_checkpoint == 0) TRY(context.checkpoint());
      if (i == last) continue;
      const Encroacher near = find_encroacher(grid, *samples, i, arcs.diagonal);
      if (near.sample == k_none) continue;
      const double length = samples->along[i + 1] - samples->along[i];
      if (is_crowded(near, length, greatest_step, arcs.diagonal)) {
        ++samples->too_short;
        continue;
      }
      TRY(stations->along.push(split_at(arcs, *samples, i, near)));
      ++samples->splits;
      *any = true;
      if (stations->along.size() > k_most_samples) {
        return fail(Code::too_large, "curves so near to each other need too many samples");
      }
    }
    TRY(stations->start.push(static_cast<uint32_t>(stations->along.size())));
  }
  return {};
}

// Where curves lie on each other their samples do so bit for bit, so that they are one edge.
static Status weld_samples(Context& context, double tolerance, Samples* samples) {
  PointGrid grid(context);
  TRY(grid.build(samples->position.span()));
  return in_parts(context, samples->position.size(), [&](size_t i) {
    uint32_t first = static_cast<uint32_t>(i);
    const Vec3 p = samples->position[i];
    grid.any_near(p, tolerance, [&](uint32_t k) {
      if (k < first && length(samples->position[k] - p) <= tolerance) first = k;
      return false;
    });
    samples->position[i] = samples->position[first];
  });
}

Status sample_arcs(Context& context, const Arcs& arcs, double greatest_step, Samples* samples) {
  Array<double> steps(context);
  Stations stations(context);
  TRY(choose_steps(context, arcs, greatest_step, &steps));
  TRY(divide_arcs(context, arcs, steps.span(), &stations));
  TRY(place_samples(context, arcs, stations, samples));
  for (bool any = true; any;) {
    TRY(split_encroached(context, arcs, greatest_step, samples, &stations, &any));
    if (any) TRY(place_samples(context, arcs, stations, samples));
  }
  return weld_samples(context, k_coincidence * arcs.diagonal, samples);
}

}  // namespace wireskin::flow
