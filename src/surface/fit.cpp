#include "surface/fit.h"

#include "base/in_parts.h"
#include "curves/sides.h"
#include "network/node_normals.h"

namespace wireskin {

double diagonal(Span<const Vec3> points) {
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y, p.z < low.z ? p.z : low.z};
    high = {p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y, p.z > high.z ? p.z : high.z};
  }
  return length(high - low);
}

static curves::Samples samples_of(const CurveSet& set, Span<const uint32_t> node, uint32_t curve) {
  const size_t first = set.start[curve], count = set.start[curve + 1] - first;
  return {set.position.part(first, count), set.normal.part(first, count),
          node.empty() ? node : node.part(first, count), set.closed[curve] != 0};
}

// The same with the normals on the right of a sharp curve.
static curves::Samples right_samples_of(const CurveSet& set, uint32_t curve) {
  curves::Samples samples = samples_of(set, {}, curve);
  samples.normal = set.right.part(set.start[curve], samples.position.size());
  return samples;
}

// A curve of one sample is a point that the surface passes through.
static bool is_point(const CurveSet& set, uint32_t curve) {
  return set.start[curve + 1] - set.start[curve] == 1 && !set.closed[curve];
}

static Status at_curve(Status status, uint32_t curve) {
  if (!status.ok()) status.place.curve = curve;
  return status;
}

// What sharp curves need besides: the normals on their right, and those of their nodes.
static Status fit_sides(const CurveSet& set, Span<network::Node> nodes, curves::Curves* fitted) {
  Pace pace(fitted->start.context());
  for (uint32_t c = 0; c < set.sharp.size(); ++c) {
    if (set.sharp[c] && !is_point(set, c))
      TRY(at_curve(curves::check_samples(right_samples_of(set, c), &pace), c));
  }
  TRY(curves::fit_right_normals({set.start, set.right, set.sharp}, fitted));
  return network::complete_node_normals(*fitted, nodes);
}

// Gives the samples of every node its position and normal; at creases curves keep their own.
static Status unite_nodes(Context& context, const CurveSet& set, Span<const uint32_t> node,
                          Span<const network::Node> nodes) {
  return in_parts(context, node.size(), [&](size_t i) {
    if (node[i] == k_none) return;
    set.position[i] = nodes[node[i]].position;
    if (!nodes[node[i]].crease) set.normal[i] = nodes[node[i]].normal;
  });
}

// Thins all curves, takes the noise out of what is kept, and lets nodes move with their curves.
static Status smooth_curves(Context& context, const CurveSet& set, Span<const uint32_t> node,
                            const network::SmoothingOptions& options, Span<network::Node> nodes,
                            Array<uint32_t>* kept_start, Array<uint32_t>* kept, Counts* counts) {
  Array<uint32_t> thinned(context);
  Pace pace(context);
  TRY(kept_start->push(0));
  TRY(kept->reserve(node.size()));
  for (uint32_t c = 0; c < counts->curves; ++c) {
    // Neighbours that differed by less than the tolerance may have become one point.
    if (is_point(set, c)) {
      TRY(thinned.assign(1, 0));
    } else {
      TRY(at_curve(curves::check_samples(samples_of(set, {}, c), &pace), c));
      TRY(at_curve(curves::thin(samples_of(set, node, c), &pace, &thinned), c));
    }
    for (const uint32_t i : thinned) {
      TRY(pace.after());
      kept->push_reserved(i);
    }
    TRY(kept_start->push(static_cast<uint32_t>(kept->size())));
  }
  if (options.noise == network::Noise::none) return {};
  // Where curves are sharp a node has no one normal, so normals stay as they are; the constant
  // field in their place has no noise.
  Array<Vec3> constant(context);
  const bool creased = !set.sharp.empty();
  if (creased) TRY(assign_in_parts(set.normal.size(), Vec3{0, 0, 1}, &constant));
  const Span<Vec3> normals = creased ? constant.span() : set.normal;
  TRY(network::smooth_samples(
      context,
      {set.start, kept_start->span(), kept->span(), node, {}, set.closed, set.position, normals},
      options, &counts->noise));
  return in_parts(context, node.size(), [&](size_t i) {
    if (node[i] == k_none) return;
    nodes[node[i]].position = set.position[i];
    if (!creased) nodes[node[i]].normal = set.normal[i];
  });
}

// Checks every curve, unites the samples of each node, smooths and fits the splines.
Status fit_curves(Context& context, const CurveSet& set, double size,
                  const network::SmoothingOptions& smoothing, Array<network::Node>* nodes,
                  curves::Curves* fitted, Counts* counts) {
  constexpr double k_node_tolerance = 1e-9;
  Array<uint32_t> node(context), kept_start(context), kept(context);
  Pace pace(context);
  counts->curves = static_cast<uint32_t>(set.closed.size());
  for (uint32_t c = 0; c < counts->curves; ++c) {
    if (is_point(set, c)) continue;
    TRY(at_curve(curves::check_samples(samples_of(set, {}, c), &pace), c));
  }
  const network::SampleNumbers samples = {set.start,  set.number, set.position,
                                          set.normal, set.sharp,  set.right};
  TRY(network::find_nodes(samples, k_node_tolerance * size, nodes, &node));
  TRY(network::add_loose_ends(samples, set.closed, nodes, node.span()));
  counts->nodes = static_cast<uint32_t>(nodes->size());
  TRY(unite_nodes(context, set, node.span(), nodes->span()));
  TRY(smooth_curves(context, set, node.span(), smoothing, nodes->span(), &kept_start, &kept,
                    counts));
  TRY(curves::reserve_knots(kept.size() + counts->curves, fitted));  // closed ones repeat the first
  for (uint32_t c = 0; c < counts->curves; ++c) {
    const Span<const uint32_t> own =
        kept.span().part(kept_start[c], kept_start[c + 1] - kept_start[c]);
    TRY(at_curve(curves::fit_curve(samples_of(set, node.span(), c), own, &pace, fitted), c));
    TRY(context.progress(static_cast<double>(c + 1) / counts->curves));
  }
  return set.sharp.empty() ? Status{} : fit_sides(set, nodes->span(), fitted);
}

}  // namespace wireskin
