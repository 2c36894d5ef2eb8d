#include "surface/flow_noise.h"

#include "base/in_parts.h"
#include "flow/chains.h"

namespace wireskin {

namespace {

// The chains as the smoothing reads them: every place a sample of its own, all of them kept.
struct ChainSamples {
  Array<uint32_t> kept;
  Array<uint32_t> node;  // of each place: the point that it shares with others, or k_none
  Array<Vec3> position, normal;

  explicit ChainSamples(Context& context)
      : kept(context), node(context), position(context), normal(context) {}
};

}  // namespace

// Vertices that occur in several places get numbers of their own.
static Status number_shared(uint32_t vertices, const flow::Chains& chains, Array<uint32_t>* node) {
  Context& context = node->context();
  Array<uint32_t> uses(context);
  const size_t n = chains.vertex.size();
  TRY(assign_in_parts(vertices, 0, &uses));
  TRY(node->resize(n));
  TRY(in_parts(context, n, [&](size_t i) { ++uses[chains.vertex[i]]; }));
  uint32_t numbers = 0;
  TRY(in_parts(context, vertices, [&](size_t v) { uses[v] = uses[v] > 1 ? numbers++ : k_none; }));
  return in_parts(context, n, [&](size_t i) { (*node)[i] = uses[chains.vertex[i]]; });
}

// Without normals a constant field, which has no noise, stands for them.
static Status gather_places(const flow::Arcs& arcs, const flow::Chains& chains,
                            Span<const Vec3> normal, ChainSamples* places) {
  const size_t n = chains.vertex.size();
  Array<Vec3> of_vertex(places->normal.context());
  Pace pace(places->normal.context());
  TRY(number_shared(static_cast<uint32_t>(arcs.vertex.size()), chains, &places->node));
  TRY(places->kept.resize(n));
  TRY(places->position.resize(n));
  TRY(places->normal.resize(n));
  TRY(assign_in_parts(arcs.vertex.size(), Vec3{0, 0, 1}, &of_vertex));
  for (size_t s = normal.size(); s-- > 0;) {
    TRY(pace.after());
    of_vertex[arcs.sample_vertex[s]] = normal[s];
  }
  for (uint32_t c = 0; c < chains.size(); ++c) {
    for (uint32_t i = chains.start[c]; i < chains.start[c + 1]; ++i) {
      TRY(pace.after());
      places->kept[i] = i - chains.start[c];
      places->position[i] = arcs.vertex[chains.vertex[i]];
      places->normal[i] = of_vertex[chains.vertex[i]];
    }
  }
  return {};
}

static Status measure_move(Context& context, const flow::Arcs& arcs, const flow::Chains& chains,
                           Span<const Vec3> position, double* greatest) {
  *greatest = 0.0;
  return in_parts(context, position.size(), [&](size_t i) {
    const double move = length(position[i] - arcs.vertex[chains.vertex[i]]);
    if (move > *greatest) *greatest = move;
  });
}

// All samples of a vertex that moved get its new place.
static Status write_samples(const flow::Arcs& arcs, const flow::Chains& chains,
                            Span<const Vec3> places, Span<Vec3> samples) {
  Array<uint32_t> place(chains.vertex.context());
  Context& context = place.context();
  TRY(assign_in_parts(arcs.vertex.size(), k_none, &place));
  TRY(in_parts(context, chains.vertex.size(),
               [&](size_t i) { place[chains.vertex[i]] = static_cast<uint32_t>(i); }));
  return in_parts(context, samples.size(), [&](size_t s) {
    const uint32_t i = place[arcs.sample_vertex[s]];
    if (i != k_none) samples[s] = places[i];
  });
}

Status smooth_polylines(Context& context, const flow::Polylines& polylines,
                        const network::SmoothingOptions& options, Span<Vec3> position,
                        Span<Vec3> normal, network::SmoothingReport* report) {
  *report = {};
  if (options.noise == network::Noise::none) return {};
  flow::Arcs arcs(context);
  flow::Chains chains(context);
  ChainSamples places(context);
  const bool found = options.noise == network::Noise::estimate;
  TRY(flow::find_arcs(context, polylines, &arcs));
  TRY(flow::find_chains(context, arcs, found ? 0.0 : options.sigma, &chains));
  if (chains.size() == 0) return {};
  TRY(gather_places(arcs, chains, normal, &places));
  const network::KeptSamples kept = {
      chains.start.span(),  chains.start.span(),  places.kept.span(),     places.node.span(),
      chains.corner.span(), chains.closed.span(), places.position.span(), places.normal.span()};
  network::SmoothingOptions inside = options;
  inside.negligible = k_no_noise * arcs.diagonal;
  inside.negligible_normal = k_no_noise_of_normals;
  TRY(network::smooth_samples(context, kept, inside, report));
  double moved = 0.0;
  TRY(measure_move(context, arcs, chains, places.position.span(), &moved));
  if (moved > (found ? k_no_noise * arcs.diagonal : 0.0)) {
    TRY(write_samples(arcs, chains, places.position.span(), position));
  }
  if (normal.empty() || !(report->lambda_normal > 0.0)) return {};
  return write_samples(arcs, chains, places.normal.span(), normal);
}

}  // namespace wireskin
