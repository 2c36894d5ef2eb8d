#include "flow/flat_lids.h"

#include "num/minmax.h"

namespace wireskin::flow {

static constexpr double k_off_plane = 3.0;   // times what counts as flat
static constexpr double k_sideways = 0.05;   // sine of the angle between two faces' planes
static constexpr double k_same_wall = 0.7;   // cosine of the angle between curves in it
static constexpr double k_look_along = 0.1;  // of the diagonal

namespace {

// The ends of arcs at each vertex of the complex.
struct ArcEnds {
  Array<uint32_t> start, end;  // an end: twice the arc, and one for its last sample

  explicit ArcEnds(Context& context) : start(context), end(context) {}
};

struct LidSearch {
  const Drawing& drawing;
  const FlatFaces& faces;
  FaceRims* rims;
  ArcEnds ends;
  size_t work = 0;
};

// What goes on from a curve, as one face at it sees that.
struct Sheets {
  uint32_t above = 0, below = 0, within = 0;
  bool through = false;  // straight on from above to below
  bool flat = false;     // some of it

  uint32_t count() const { return 1 + above + below + within; }
};

}  // namespace

static uint32_t vertex_of_end(const Complex& complex, const Samples& samples, uint32_t end) {
  const uint32_t a = end / 2;
  const uint32_t at = (end & 1) == 0 ? samples.start[a] : samples.start[a + 1] - 1;
  return complex.same_as[samples.at[at]];
}

static Status link_ends(const Complex& complex, const Samples& samples, ArcEnds* ends) {
  const uint32_t count = 2 * static_cast<uint32_t>(samples.start.size() - 1);
  TRY(ends->start.assign(complex.point.size() + 1, 0));
  TRY(ends->end.resize(count));
  for (uint32_t i = 0; i < count; ++i) ++ends->start[vertex_of_end(complex, samples, i)];
  starts_from_counts(ends->start.span());
  for (uint32_t i = 0; i < count; ++i) {
    ends->end[ends->start[vertex_of_end(complex, samples, i)]++] = i;
  }
  shift_starts_back(ends->start.span());
  return {};
}

// Where an arc leaves a plane through its end, seen from there; zero where it stays for a while.
static Vec3 leaving(LidSearch* search, uint32_t end, const Vec3& normal) {
  const Samples& samples = search->drawing.samples;
  const double diagonal = search->drawing.complex.diagonal;
  const uint32_t first = samples.start[end / 2], last = samples.start[end / 2 + 1] - 1;
  const bool forward = (end & 1) == 0;
  const uint32_t from = forward ? first : last;
  for (uint32_t k = 1; k <= last - first; ++k) {
    const uint32_t i = forward ? first + k : last - k;
    const Vec3 to = samples.position[samples.at[i]] - samples.position[samples.at[from]];
    ++search->work;
    if (std::fabs(dot(to, normal)) > k_off_plane * search->faces.flat) return to;
    if (std::fabs(samples.along[i] - samples.along[from]) > k_look_along * diagonal) break;
  }
  return {};
}

static Vec3 tangent_of_end(const Samples& samples, uint32_t end) {
  const uint32_t first = samples.start[end / 2], last = samples.start[end / 2 + 1] - 1;
  const uint32_t from = (end & 1) == 0 ? first : last;
  const uint32_t to = (end & 1) == 0 ? first + 1 : last - 1;
  return unit(samples.position[samples.at[to]] - samples.position[samples.at[from]]);
}

// Whether a straight curve that ends at the node goes on there.
static bool runs_on(const LidSearch& search, uint32_t vertex, uint32_t end) {
  const uint32_t line = search.drawing.lines.line_of[end / 2];
  if (line == k_none) return false;
  for (uint32_t i = search.ends.start[vertex]; i < search.ends.start[vertex + 1]; ++i) {
    const uint32_t other = search.ends.end[i];
    if (other / 2 != end / 2 && search.drawing.lines.line_of[other / 2] == line) return true;
  }
  return false;
}

// A curve that ends in mid-air shows no wall.
static bool is_loose(const LidSearch& search, uint32_t end) {
  const uint32_t v = vertex_of_end(search.drawing.complex, search.drawing.samples, end);
  return search.ends.start[v + 1] - search.ends.start[v] == 1;
}

// Walls that curves show which leave the plane at an end of an arc. Those that leave it far apart,
// seen along the arc, are in different walls: two on a side are enough to know.
static void add_walls(LidSearch* search, uint32_t rim_end, const Vec3& normal, Sheets* sheets) {
  const uint32_t v = vertex_of_end(search->drawing.complex, search->drawing.samples, rim_end);
  const Vec3 tangent = tangent_of_end(search->drawing.samples, rim_end);
  Vec3 first[2];
  uint32_t count[2] = {};
  for (uint32_t i = search->ends.start[v]; i < search->ends.start[v + 1]; ++i) {
    const uint32_t end = search->ends.end[i];
    if (end / 2 == rim_end / 2 || is_loose(*search, end ^ 1)) continue;
    const Vec3 across = unit(reject(leaving(search, end, normal), tangent));
    if (dot(across, across) == 0.0) continue;
    const uint32_t side = dot(across, normal) > 0.0 ? 0 : 1;
    if (side == 0) sheets->through = sheets->through || runs_on(*search, v, end);
    if (count[side] == 0) {
      first[side] = across;
      count[side] = 1;
    } else if (dot(first[side], across) < k_same_wall) {
      count[side] = 2;
    }
  }
  if (count[0] > sheets->above) sheets->above = count[0];
  if (count[1] > sheets->below) sheets->below = count[1];
}

// Other flat faces at the same arc.
static Sheets faces_beside(LidSearch* search, uint32_t rim, const Vec3& normal) {
  const FlatFaces& faces = search->faces;
  const uint32_t arc = faces.rim[rim].arc;
  Sheets sheets;
  uint32_t up = k_none, down = k_none;
  for (uint32_t i = search->rims->start[arc]; i < search->rims->start[arc + 1]; ++i) {
    const uint32_t other = search->rims->rim[i];
    const uint32_t face = search->rims->face[other];
    ++search->work;
    if (other == rim || !search->rims->stays(face)) continue;
    sheets.flat = true;
    const double lean = dot(faces.rim[other].into, normal);
    if (std::fabs(lean) < k_sideways) {
      ++sheets.within;
    } else if (lean > 0.0) {
      ++sheets.above;
      up = face;
    } else {
      ++sheets.below;
      down = face;
    }
  }
  if (up != k_none && down != k_none) {
    sheets.through = std::fabs(dot(faces.normal[up], faces.normal[down])) > k_same_line;
  }
  return sheets;
}

// A wall is flat or shown by curves, maybe both.
static Sheets sheets_at(LidSearch* search, uint32_t rim) {
  const Vec3& normal = search->faces.normal[search->rims->face[rim]];
  const uint32_t arc = search->faces.rim[rim].arc;
  Sheets sheets = faces_beside(search, rim, normal);
  for (uint32_t k = 0; k < 2; ++k) add_walls(search, 2 * arc + k, normal, &sheets);
  return sheets;
}

struct RimFacts {
  bool crowded_all_round = true, crowded = false, walled = false;
  bool hole = true;     // all round a face in its plane goes on, and one wall
  bool section = true;  // all round there are walls on both sides
};

static RimFacts look_round(LidSearch* search, uint32_t face) {
  const FlatFaces& faces = search->faces;
  const bool polygon = faces.polygon[face] != 0;
  RimFacts facts;
  for (uint32_t i = faces.rim_start[face]; i < faces.rim_start[face + 1]; ++i) {
    const Sheets sheets = sheets_at(search, i);
    const bool crowded = sheets.count() > 2 && !(polygon && (sheets.through || sheets.flat));
    const uint32_t walls = sheets.above + sheets.below;
    facts.crowded = facts.crowded || crowded;
    facts.crowded_all_round = facts.crowded_all_round && crowded;
    facts.walled = facts.walled || (walls == 1 && sheets.within == 0);
    facts.hole = facts.hole && walls == 1 && sheets.within == 1;
    facts.section = facts.section && sheets.above > 0 && sheets.below > 0;
  }
  return facts;
}

static uint32_t root_of_net(Span<uint32_t> parent, uint32_t a) {
  while (parent[a] != a) a = parent[a] = parent[parent[a]];
  return a;
}

// Arcs that hang together, each by the least of them.
static Status find_nets(const ArcEnds& ends, uint32_t arcs, Array<uint32_t>* net) {
  TRY(net->resize(arcs));
  for (uint32_t a = 0; a < arcs; ++a) (*net)[a] = a;
  for (size_t v = 0; v + 1 < ends.start.size(); ++v) {
    for (uint32_t i = ends.start[v]; i + 1 < ends.start[v + 1]; ++i) {
      const uint32_t a = root_of_net(net->span(), ends.end[i] / 2);
      const uint32_t b = root_of_net(net->span(), ends.end[i + 1] / 2);
      (*net)[a < b ? b : a] = a < b ? a : b;
    }
  }
  for (uint32_t a = 0; a < arcs; ++a) (*net)[a] = root_of_net(net->span(), a);
  return {};
}

// What discs turn out to be.
struct Discs {
  Array<uint32_t> lid, hole, section;

  explicit Discs(Context& context) : lid(context), hole(context), section(context) {}
};

// Sections of what has a lid are in the way of its void: they are open.
static Status keep_lids(Context& context, const LidSearch& search, const Discs& discs, Lids which,
                        Array<uint32_t>* lids) {
  const FlatFaces& faces = search.faces;
  const uint32_t arcs = search.rims->arc_count();
  Array<uint32_t> net(context), count(context);
  TRY(find_nets(search.ends, arcs, &net));
  TRY(count.assign(arcs, 0));
  const auto net_of = [&](uint32_t face) { return net[faces.rim[faces.rim_start[face]].arc]; };
  const auto stay = [&](uint32_t n) {
    return count[n] > 0 && (which == Lids::all || (which == Lids::single && count[n] == 1));
  };
  for (const uint32_t f : discs.lid) ++count[net_of(f)];
  for (const uint32_t f : discs.lid) {
    if (stay(net_of(f))) search.rims->state[f] = FaceState::dangling;
    TRY(lids->push(f));
  }
  for (const uint32_t f : discs.section) {
    if (stay(net_of(f))) search.rims->state[f] = FaceState::hole;
  }
  return {};
}

// Holes that a curve joins to another one stay as they are: walls that do not bulge with a tunnel
// leave gaps at its ends, and the ends' discs are surer.
static Status open_holes(Context& context, LidSearch* search, Span<const uint32_t> holes) {
  const Complex& complex = search->drawing.complex;
  const Samples& samples = search->drawing.samples;
  const FlatFaces& faces = search->faces;
  Array<uint32_t> hole_at(context);
  TRY(hole_at.assign(complex.point.size(), k_none));
  const auto each_end = [&](uint32_t f, const auto& visit) {
    for (uint32_t i = faces.rim_start[f]; i < faces.rim_start[f + 1]; ++i) {
      for (uint32_t k = 0; k < 2; ++k) {
        visit(vertex_of_end(complex, samples, 2 * faces.rim[i].arc + k));
      }
    }
  };
  for (const uint32_t f : holes) each_end(f, [&](uint32_t v) { hole_at[v] = f; });
  for (const uint32_t f : holes) {
    bool tunnel = false;
    each_end(f, [&](uint32_t v) {
      for (uint32_t i = search->ends.start[v]; i < search->ends.start[v + 1]; ++i) {
        const uint32_t other = hole_at[vertex_of_end(complex, samples, search->ends.end[i] ^ 1)];
        tunnel = tunnel || (other != k_none && other != f);
      }
    });
    const bool goes_on = sheets_at(search, faces.rim_start[f]).within == 1;
    if (!tunnel && goes_on) search->rims->state[f] = FaceState::hole;
  }
  return {};
}

Status find_lids(Context& context, const Drawing& drawing, const FlatFaces& faces, Lids which,
                 FaceRims* rims, Array<uint32_t>* lids) {
  constexpr size_t k_work_per_checkpoint = 1u << 16;
  LidSearch search = {drawing, faces, rims, ArcEnds(context)};
  Discs discs(context);
  Array<uint8_t> is_disc(context);
  TRY(link_ends(drawing.complex, drawing.samples, &search.ends));
  TRY(is_disc.assign(faces.size(), 0));
  // Discs count as sheets, too, until they turn out to be sections.
  for (uint32_t f = 0; f < faces.size(); ++f) {
    if (faces.polygon[f] != 0) continue;
    is_disc[f] = 1;
    rims->state[f] = FaceState::dangling;
  }
  for (uint32_t pass = 0; pass < 2; ++pass) {
    for (uint32_t f = 0; f < faces.size(); ++f) {
      if (rims->state[f] != FaceState::dangling || (pass == 1 && is_disc[f] == 0)) continue;
      const RimFacts facts = look_round(&search, f);
      if (pass == 0 && facts.crowded_all_round) {
        rims->state[f] = FaceState::inner;
        if (is_disc[f] != 0 && facts.hole) TRY(discs.hole.push(f));
        if (is_disc[f] != 0 && facts.section) TRY(discs.section.push(f));
      } else if (pass == 1 && facts.walled && !facts.crowded) {
        TRY(discs.lid.push(f));
      }
      if (search.work < k_work_per_checkpoint) continue;
      search.work = 0;
      TRY(context.checkpoint());
    }
  }
  for (uint32_t f = 0; f < faces.size(); ++f) {
    if (is_disc[f] != 0) rims->state[f] = FaceState::inner;
  }
  TRY(keep_lids(context, search, discs, which, lids));
  return open_holes(context, &search, discs.hole.span());
}

}  // namespace wireskin::flow
