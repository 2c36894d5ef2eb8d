#include "network/ring_pairs.h"

#include "num/minmax.h"

namespace wireskin::network {

// A curve closed on both sides hangs there by itself: that costs so many times more while another
// one is in sight.
static constexpr double k_blob = 2.0;
// A side whose normals agree less with its axis has no lid.
static constexpr double k_clockwise = -0.3;
// An exchange must cost less than this part; choices that cost no more than this are equally good.
static constexpr double k_saves = 1.0 - 1e-6, k_as_good = 1.1;
// Sides see each other with this cosine at least; others are only asked for what is left.
static constexpr double k_in_sight = 0.02;
// So many bands an exchange chooses one after the other. Each concerns two sides, their twins, and
// the partners of these with their twins; the sides of those chosen before are noted already.
static constexpr uint32_t k_most_links = 6, k_most_touched = 12 * k_most_links;

namespace {

struct RingPairing {
  RingBands* bands;
  Lists bands_of;           // of each side, by cost
  Array<uint32_t> partner;  // of each side
  Array<double> paid;       // of each side with a partner: the cost of the band
  Array<uint8_t> fixed;     // of each side: its partner is not exchanged any more
  double blob = k_blob;     // what closing both sides of a curve costs more

  RingPairing(Context& context, RingBands* of)
      : bands(of), bands_of(context), partner(context), paid(context), fixed(context) {}
};

// One band chosen, and for the sides that lose their partners by it the best others, and so on:
// what it changed, so that all can be taken back.
struct Chain {
  uint32_t side[k_most_touched];
  uint32_t partner[k_most_touched];
  double paid[k_most_touched];
  uint32_t count = 0;
  double before = 0.0;            // the cost of all these sides
  uint32_t left[k_most_touched];  // sides that lost their partners
  uint32_t lefts = 0;
  uint32_t chosen[2 * k_most_links];  // sides of bands that the chain has chosen
  uint32_t choices = 0;
};

}  // namespace

// A checkpoint after so many bands: an exchange takes some microseconds.
static Status pause_after_bands(uint32_t i, Context& context) {
  return i % 1024 == 1023 ? context.checkpoint() : Status{};
}

static Status list_bands_of_sides(RingPairing* pairing) {
  Lists& of = pairing->bands_of;
  const RingBands& bands = *pairing->bands;
  TRY(of.start.assign(bands.side.size() + 1, 0));
  TRY(of.item.resize(2 * bands.band.size()));
  for (uint32_t i = 0; i < bands.band.size(); ++i) {
    ++of.start[bands.band[i].a];
    ++of.start[bands.band[i].b];
    TRY(pause_after_bands(i, of.item.context()));
  }
  starts_from_counts(of.start.span());
  for (uint32_t i = 0; i < bands.band.size(); ++i) {
    of.item[of.start[bands.band[i].a]++] = i;
    of.item[of.start[bands.band[i].b]++] = i;
    TRY(pause_after_bands(i, of.item.context()));
  }
  shift_starts_back(of.start.span());
  return {};
}

// Whether both sides of a curve are alone, each with a lid. What has none lies on another patch.
static bool is_blob(const RingPairing& pairing, uint32_t s) {
  const RingBands& bands = *pairing.bands;
  const uint32_t other = bands.side[s].other;
  return other != k_none && pairing.partner[other] == k_none &&
         bands.side[s].cosine > k_clockwise && bands.side[other].cosine > k_clockwise;
}

static double cost_of_side(const RingPairing& pairing, uint32_t s) {
  if (pairing.partner[s] != k_none) return 0.5 * pairing.paid[s];
  const RingSide& side = pairing.bands->side[s];
  if (side.twin == k_none) return is_blob(pairing, s) ? pairing.blob * side.alone : side.alone;
  return pairing.partner[side.twin] != k_none ? 0.0 : 0.5 * side.alone;
}

static void unlink_side(uint32_t s, RingPairing* pairing) {
  if (s == k_none || pairing->partner[s] == k_none) return;
  pairing->partner[pairing->partner[s]] = k_none;
  pairing->partner[s] = k_none;
}

static void link_sides(const RingBand& band, RingPairing* pairing) {
  unlink_side(pairing->bands->side[band.a].twin, pairing);
  unlink_side(pairing->bands->side[band.b].twin, pairing);
  unlink_side(band.a, pairing);
  unlink_side(band.b, pairing);
  pairing->partner[band.a] = band.b;
  pairing->partner[band.b] = band.a;
  pairing->paid[band.a] = pairing->paid[band.b] = band.cost;
}

static void note_side(uint32_t s, const RingPairing& pairing, Chain* chain) {
  if (s == k_none) return;
  for (uint32_t i = 0; i < chain->count; ++i) {
    if (chain->side[i] == s) return;
  }
  WIRESKIN_ASSERT(chain->count < k_most_touched);
  const uint32_t i = chain->count++;
  chain->side[i] = s;
  chain->partner[i] = pairing.partner[s];
  chain->paid[i] = pairing.paid[s];
  chain->before += cost_of_side(pairing, s);
}

// Both sides of a curve: what one costs depends on the other.
static void note_curve(uint32_t s, const RingPairing& pairing, Chain* chain) {
  note_side(s, pairing, chain);
  note_side(pairing.bands->side[s].twin, pairing, chain);
  note_side(pairing.bands->side[s].other, pairing, chain);
}

// Notes a side and the partners that its curve loses, before anything changes there; the partners
// are left over.
static void note_round(uint32_t s, const RingPairing& pairing, Chain* chain) {
  note_curve(s, pairing, chain);
  const uint32_t own[2] = {s, pairing.bands->side[s].twin};
  for (uint32_t side : own) {
    if (side == k_none) continue;
    const uint32_t other = pairing.partner[side];
    if (other == k_none) continue;
    note_curve(other, pairing, chain);
    chain->left[chain->lefts++] = other;
  }
}

static void choose_band(const RingBand& band, RingPairing* pairing, Chain* chain) {
  note_round(band.a, *pairing, chain);
  note_round(band.b, *pairing, chain);
  link_sides(band, pairing);
  chain->chosen[chain->choices++] = band.a;
  chain->chosen[chain->choices++] = band.b;
}

static double cost_now(const RingPairing& pairing, const Chain& chain) {
  double sum = 0.0;
  for (uint32_t i = 0; i < chain.count; ++i) sum += cost_of_side(pairing, chain.side[i]);
  return sum;
}

static bool was_chosen(const Chain& chain, uint32_t s) {
  bool was = false;
  for (uint32_t i = 0; i < chain.choices; ++i) was = was || chain.chosen[i] == s;
  return was;
}

static bool may_link(const RingPairing& pairing, const RingBand& band, double least_cosine) {
  const RingSide &a = pairing.bands->side[band.a], &b = pairing.bands->side[band.b];
  return !pairing.fixed[band.a] && !pairing.fixed[band.b] && band.cosine >= least_cosine &&
         pairing.partner[band.a] != band.b && band.cost < pairing.blob * (a.alone + b.alone);
}

// The band with the least cost for a side left over, k_none where there is none.
static uint32_t next_band(const RingPairing& pairing, uint32_t s, double least_cosine,
                          const Chain& chain) {
  for (uint32_t i : pairing.bands_of[s]) {
    const RingBand& band = pairing.bands->band[i];
    const uint32_t other = band.a == s ? band.b : band.a, twin = pairing.bands->side[other].twin;
    if (!may_link(pairing, band, least_cosine) || was_chosen(chain, other)) continue;
    if (twin == k_none || !was_chosen(chain, twin)) return i;
  }
  return k_none;
}

// What the sides concerned cost when a band is chosen and others behind it, in proportion to what
// they cost now, where that is least; the choice is taken back unless it saves something and is to
// be kept.
static double change_by(const RingBand& band, double least_cosine, bool keep,
                        RingPairing* pairing) {
  Chain chain;
  choose_band(band, pairing, &chain);
  double least = cost_now(*pairing, chain) / chain.before;
  uint32_t next = 0;
  for (uint32_t link = 1; link < k_most_links && next < chain.lefts; ++link) {
    if (keep && least < k_saves) return least;
    const uint32_t s = chain.left[next++];
    if (pairing->partner[s] != k_none || was_chosen(chain, s)) continue;
    const uint32_t b = next_band(*pairing, s, least_cosine, chain);
    if (b == k_none) continue;
    choose_band(pairing->bands->band[b], pairing, &chain);
    least = smaller(least, cost_now(*pairing, chain) / chain.before);
  }
  if (keep && least < k_saves) return least;
  for (uint32_t i = 0; i < chain.count; ++i) {
    pairing->partner[chain.side[i]] = chain.partner[i];
    pairing->paid[chain.side[i]] = chain.paid[i];
  }
  return least;
}

static bool is_free(const RingPairing& pairing, uint32_t s) {
  const uint32_t twin = pairing.bands->side[s].twin;
  return pairing.partner[s] == k_none && (twin == k_none || pairing.partner[twin] == k_none);
}

// The bands with the least cost first.
static Status pair_nearest(double least_cosine, RingPairing* pairing) {
  for (uint32_t i = 0; i < pairing->bands->band.size(); ++i) {
    const RingBand& band = pairing->bands->band[i];
    TRY(pause_after_bands(i, pairing->partner.context()));
    if (!may_link(*pairing, band, least_cosine)) continue;
    if (!is_free(*pairing, band.a) || !is_free(*pairing, band.b)) continue;
    const double alone = cost_of_side(*pairing, band.a) + cost_of_side(*pairing, band.b);
    if (band.cost < alone) link_sides(band, pairing);
  }
  return {};
}

// Every round saves something, so there is an end; a few rounds get where many would.
static Status exchange_partners(double least_cosine, RingPairing* pairing) {
  constexpr int k_most_rounds = 16;
  bool any = true;
  for (int round = 0; any && round < k_most_rounds; ++round) {
    any = false;
    for (uint32_t i = 0; i < pairing->bands->band.size(); ++i) {
      const RingBand& band = pairing->bands->band[i];
      TRY(pause_after_bands(i, pairing->partner.context()));
      if (!may_link(*pairing, band, least_cosine)) continue;
      any = change_by(band, least_cosine, true, pairing) < k_saves || any;
    }
    TRY(pairing->partner.context().checkpoint());
  }
  return {};
}

// Partners in sight stay; so does the other side of a ring that has only one.
static void fix_partners(RingPairing* pairing) {
  for (uint32_t s = 0; s < pairing->partner.size(); ++s) {
    if (pairing->partner[s] == k_none) continue;
    const uint32_t twin = pairing->bands->side[s].twin;
    pairing->fixed[s] = 1;
    if (twin != k_none) pairing->fixed[twin] = 1;
  }
}

// What looks across itself is rather closed by itself than bent back to another side.
static void prefer_lids_in_sight(RingPairing* pairing) {
  pairing->blob = 1.0;
  for (RingSide& side : pairing->bands->side)
    side.alone *= band_weight(0.0) / band_weight(side.cosine);
}

static Status mark_doubtful(RingPairing* pairing, Span<uint8_t> doubtful) {
  for (uint32_t i = 0; i < pairing->bands->band.size(); ++i) {
    const RingBand& band = pairing->bands->band[i];
    TRY(pause_after_bands(i, pairing->partner.context()));
    const RingSide &a = pairing->bands->side[band.a], &b = pairing->bands->side[band.b];
    bool as_good = false;
    if (pairing->partner[band.a] == band.b) {
      as_good = a.lid + b.lid < k_as_good * band.cost * band_weight(band.cosine);
    } else {
      as_good = may_link(*pairing, band, -1.0) && change_by(band, -1.0, false, pairing) < k_as_good;
    }
    if (as_good) doubtful[band.a] = doubtful[band.b] = 1;
  }
  return {};
}

Status pair_sides(RingBands* bands, Array<uint32_t>* partner, Array<uint8_t>* doubtful) {
  Context& context = partner->context();
  RingPairing pairing(context, bands);
  const size_t sides = bands->side.size();
  TRY(pairing.partner.assign(sides, k_none));
  TRY(pairing.paid.assign(sides, 0.0));
  TRY(pairing.fixed.assign(sides, 0));
  TRY(doubtful->assign(sides, 0));
  TRY(list_ring_bands(bands));
  TRY(list_bands_of_sides(&pairing));
  TRY(pair_nearest(k_in_sight, &pairing));
  TRY(exchange_partners(k_in_sight, &pairing));
  fix_partners(&pairing);
  prefer_lids_in_sight(&pairing);
  TRY(pair_nearest(-1.0, &pairing));
  TRY(exchange_partners(-1.0, &pairing));
  TRY(mark_doubtful(&pairing, doubtful->span()));
  return partner->copy(pairing.partner.span());
}

}  // namespace wireskin::network
