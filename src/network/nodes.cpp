#include "network/nodes.h"

#include "base/search.h"
#include "base/sort_in_parts.h"
#include "curves/opposed.h"

namespace wireskin::network {

static uint32_t curve_of_sample(const SampleNumbers& samples, uint32_t sample) {
  const uint32_t curves = static_cast<uint32_t>(samples.start.size()) - 1;
  return last_holding(uint32_t{0}, curves, [&](uint32_t c) { return samples.start[c] <= sample; });
}

static Status fail_at(Code code, const char* sentence, const SampleNumbers& samples,
                      uint32_t sample) {
  Place place;
  place.curve = curve_of_sample(samples, sample);
  place.sample = sample - samples.start[place.curve];
  place.node = samples.number[sample];
  return fail(code, sentence, place);
}

// The normal of a node of sharp curves: normals differ across these, so none opposes another here.
static void merge_sides(const SampleNumbers& samples, Span<const uint32_t> members, Node* node) {
  Vec3 sharp, smooth;
  for (uint32_t sample : members) {
    if (!samples.sharp[curve_of_sample(samples, sample)]) {
      smooth += samples.normal[sample];
      continue;
    }
    const Vec3 &left = samples.normal[sample], &right = samples.right[sample];
    node->crease = true;
    node->certain = node->certain && dot(left, left) > 0.0 && dot(right, right) > 0.0;
    sharp += left + right;
  }
  if (!node->crease) return;
  // Sides that nearly cancel out have no mean that tells anything.
  constexpr double k_least_sum = 1e-3;
  if (!(length(sharp) > k_least_sum)) node->certain = false;
  node->normal = unit(node->certain ? sharp : sharp + smooth);
}

// The directions in which a sample's curve leaves it, up to two of them.
struct Rays {
  Vec3 direction[2];
  int count = 0;
};

static Rays rays_of(const SampleNumbers& samples, uint32_t sample) {
  const uint32_t c = curve_of_sample(samples, sample);
  const Vec3& here = samples.position[sample];
  Rays rays;
  if (sample > samples.start[c]) {
    rays.direction[rays.count++] = unit(samples.position[sample - 1] - here);
  }
  if (sample + 1 < samples.start[c + 1]) {
    rays.direction[rays.count++] = unit(samples.position[sample + 1] - here);
  }
  return rays;
}

// Whether the normals of two curves at their common node lie on different sides of the surface,
// seen along every chord from the one curve to the other.
static bool contradict(const SampleNumbers& samples, uint32_t a, uint32_t b) {
  constexpr double k_least_turn = 0.5;  // of the chord between unit directions: 29 degrees
  const Vec3 &n = samples.normal[a], &m = samples.normal[b];
  if (n == Vec3{} || m == Vec3{} || dot(n, m) > 0.0) return false;
  const Rays from = rays_of(samples, a), to = rays_of(samples, b);
  bool found = false;
  for (int i = 0; i < from.count; ++i) {
    for (int k = 0; k < to.count; ++k) {
      const Vec3 chord = to.direction[k] - from.direction[i];
      if (dot(chord, chord) < k_least_turn * k_least_turn) continue;
      if (!curves::lies_across(n, from.direction[i])) continue;
      if (!curves::lies_across(m, to.direction[k])) continue;
      if (!curves::opposed(n, m, chord)) return false;
      found = true;
    }
  }
  return found;
}

// At nodes of many curves each is only compared with the next few.
static constexpr size_t k_most_compared = 8;

static size_t count_contradictions(const SampleNumbers& samples, Span<const uint32_t> members,
                                   size_t of) {
  size_t count = 0;
  const size_t first = of > k_most_compared ? of - k_most_compared : 0;
  for (size_t k = first; k < members.size() && k <= of + k_most_compared; ++k) {
    count += k != of && contradict(samples, members[k], members[of]);
  }
  return count;
}

// The sample whose normal contradicts most of the others at the node, the later one of two; k_none
// where all agree.
static uint32_t contradicting_sample(const SampleNumbers& samples, Span<const uint32_t> members) {
  size_t most = 0;
  uint32_t worst = k_none;
  for (size_t k = 0; k < members.size(); ++k) {
    const size_t count = count_contradictions(samples, members, k);
    if (count == 0 || count < most) continue;
    most = count;
    worst = members[k];
  }
  return worst;
}

// Makes one node of the samples that carry the same number.
static Status merge(const SampleNumbers& samples, Span<const uint32_t> members, double tolerance,
                    Node* node) {
  node->number = samples.number[members[0]];
  node->position = samples.position[members[0]];
  Vec3 sum;
  for (uint32_t sample : members) {
    if (length(samples.position[sample] - node->position) > tolerance) {
      return fail_at(Code::node_mismatch, "samples of the same node lie at different points",
                     samples, sample);
    }
    sum += samples.normal[sample];
  }
  node->normal = unit(sum);
  if (!samples.sharp.empty()) merge_sides(samples, members, node);
  if (node->crease) return {};
  uint32_t worst = contradicting_sample(samples, members);
  for (uint32_t sample : members) {
    if (worst != k_none) break;
    if (samples.normal[sample] == Vec3{}) continue;  // a point without one
    if (!(dot(samples.normal[sample], node->normal) > 0.0)) worst = sample;
  }
  if (worst == k_none) return {};
  return fail_at(Code::inconsistent_normals,
                 "the normal opposes those of the other curves at this node; if only signs are "
                 "wrong, the option orient makes them agree",
                 samples, worst);
}

Status find_nodes(const SampleNumbers& samples, double tolerance, Array<Node>* nodes,
                  Array<uint32_t>* node_of_sample) {
  Context& context = nodes->context();
  Array<uint32_t> order(context);
  Pace pace(context);
  TRY(order.reserve(samples.number.size()));
  TRY(assign_in_parts(samples.number.size(), k_none, node_of_sample));
  TRY(in_parts(context, samples.number.size(), [&](size_t i) {
    if (samples.number[i] != k_none) order.push_reserved(static_cast<uint32_t>(i));
  }));
  const Span<const uint32_t> number = samples.number;
  TRY(sort_in_parts(context, order.span(), [number](uint32_t a, uint32_t b) {
    return number[a] != number[b] ? number[a] < number[b] : a < b;
  }));
  nodes->clear();
  for (size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && number[order[end]] == number[order[first]]) ++end;
    TRY(pace.after(end - first));
    if (end - first < 2) continue;
    Node node;
    TRY(merge(samples, order.span().part(first, end - first), tolerance, &node));
    for (size_t k = first; k < end; ++k) {
      (*node_of_sample)[order[k]] = static_cast<uint32_t>(nodes->size());
    }
    TRY(nodes->push(node));
  }
  return {};
}

Status add_loose_ends(const SampleNumbers& samples, Span<const uint8_t> closed, Array<Node>* nodes,
                      Span<uint32_t> node_of_sample) {
  for (uint32_t c = 0; c < closed.size(); ++c) {
    const uint32_t first = samples.start[c], last = samples.start[c + 1] - 1;
    if (closed[c] && first != last) continue;
    for (int end = 0; end < (first == last ? 1 : 2); ++end) {
      const uint32_t sample = end == 0 ? first : last;
      if (node_of_sample[sample] != k_none) {
        Node& known = (*nodes)[node_of_sample[sample]];
        if (first == last && known.point_curve == k_none) known.point_curve = c;
        continue;
      }
      node_of_sample[sample] = static_cast<uint32_t>(nodes->size());
      Node node = {samples.position[sample], samples.normal[sample], samples.number[sample]};
      if (!samples.sharp.empty() && samples.sharp[c]) {
        Array<uint32_t> self(nodes->context());
        TRY(self.push(sample));
        merge_sides(samples, self.span(), &node);
      }
      if (first == last) node.point_curve = c;
      TRY(nodes->push(node));
    }
  }
  return {};
}

}  // namespace wireskin::network
