#include "network/group.h"

#include "network/group_enclosed.h"
#include "network/group_guests.h"
#include "network/group_rings.h"
#include "network/group_sight.h"
#include "network/regroup.h"

namespace wireskin::network {

// A ring on its own needs normals that tell inside from outside.
static Status check_rings(Grouping* g) {
  constexpr double k_no_cosine = 1e-6, k_clear_area = 1.0 / 60.0;
  Border border(g->parent.context());
  for (uint32_t p = 0; p < g->parent.size(); ++p) {
    if (!g->network->ring[p] || !g->is_alone(p) || g->told[p]) continue;
    TRY(border_of_patch(*g->network, g->vertices, p, &border));
    double area = 0.0;
    bool known = false;
    for (const Vec3& n : border.normal) known = known || n != Vec3{};
    const double cosine = closing_cosine(border, &area), perimeter = border_length(border);
    const bool clear = area > k_clear_area * perimeter * perimeter;
    if (!known || !clear || std::fabs(cosine) > k_no_cosine) continue;
    Place place;
    place.curve = g->network->segment[g->network->cycle(p)[0] / 2].curve;
    place.sample = 0;
    return fail(Code::open_network,
                "the normals do not tell on which side of this boundary curve the surface lies",
                place);
  }
  return {};
}

static Status check_holders(const Grouping& g, Span<const uint8_t> settled) {
  const Network& network = *g.network;
  for (uint32_t c = 0; c < g.holder.size(); ++c) {
    if (g.components.bounds[c] || settled[c] || g.holder[c] != k_none) continue;
    const uint32_t v = g.components.members[c][0];
    Place place;
    place.curve = g.vertices.curve[v];
    for (const Segment& s : network.segment) {
      const bool here = s.from != k_none && (g.components.of_vertex[s.from] == c);
      if (here && s.curve < place.curve) place.curve = s.curve;
    }
    return fail(Code::open_network,
                place.curve == k_none ? "the point lies inside no patch"
                                      : "the curve bounds no patch and lies inside none",
                place);
  }
  return {};
}

static void count_ambiguous(Span<const uint8_t> ambiguous, Ambiguity* ambiguity) {
  for (uint32_t p = 0; p < ambiguous.size(); ++p) {
    if (ambiguous[p] && ambiguity->patches++ == 0) ambiguity->first = p;
  }
}

Status group_patches(const CurveVertices& vertices, Network* network, Ambiguity* ambiguity) {
  Ambiguity unasked;
  Context& context = network->segment.context();
  Grouping planes(context, vertices, network), spaces(context, vertices, network);
  Array<uint32_t> number(context);
  Array<uint8_t> settled(context), ambiguous(context);
  TRY(take_components(&planes));
  TRY(find_enclosing(*network, vertices, planes.components, &planes.enclosing));
  TRY(join_enclosed(&planes));
  TRY(join_rings(&planes));
  TRY(join_in_sight(&planes));
  TRY(rebuild(&planes, &number, &ambiguous));
  TRY(take_components(&spaces));
  TRY(settled.assign(planes.holder.size(), 0));
  for (size_t c = 0; c < settled.size(); ++c) {
    settled[c] = planes.holder[c] != k_none;
    const uint32_t doubtful = planes.doubtful[c];
    if (doubtful != k_none) spaces.doubtful[c] = number[doubtful];
  }
  for (size_t p = 0; p < ambiguous.size(); ++p) spaces.ambiguous[p] = ambiguous[p];
  TRY(join_guests(&spaces, settled.span()));
  TRY(check_rings(&spaces));
  TRY(check_holders(spaces, settled.span()));
  TRY(rebuild(&spaces, &number, &ambiguous));
  count_ambiguous(ambiguous.span(), ambiguity != nullptr ? ambiguity : &unasked);
  return {};
}

}  // namespace wireskin::network
