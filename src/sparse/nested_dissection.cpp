#include "sparse/nested_dissection.h"

#include "base/in_parts.h"
#include "base/select.h"

namespace wireskin::sparse {

static constexpr uint32_t k_leaf = 8;  // vertices that are not divided further

namespace {

struct AxisKey {
  double key;
  uint32_t vertex;
};

// A stretch of the order under construction, of the patches patch_first .. patch_end of the list.
struct Stretch {
  uint32_t first, end;
  uint32_t patch_first, patch_end;
};

struct PatchCentre {
  Vec3 sum;
  Vec3 reach;  // the greatest distances along the axes between neighbours in this patch
  uint32_t vertices = 0;
};

// Neighbours p < q and how many vertices of both touch the other.
struct PatchContact {
  uint32_t p, q, weight;
};

struct Dissector {
  const Geometry& geometry;
  Array<uint32_t> start, neighbour;  // the graph of the vertices
  Array<uint32_t> columns;           // of each vertex
  Array<uint8_t> mixed;              // has a neighbour in another patch
  Array<PatchCentre> centre;
  Array<PatchContact> contact;
  Array<uint32_t> patches;  // in the order of their division
  Array<uint8_t> side;      // of each vertex, in the split under way: 0 neither, 1 left, 2 right
  Array<uint8_t> patch_side;
  Array<AxisKey> keys;
  Array<uint32_t> layer;  // places of the vertices that touch the other side
  Array<uint32_t> order;  // of the vertices: every stretch becomes left, right, separator
  Array<Stretch> stack;
  size_t work = 0;

  Dissector(Context& c, const Geometry& g)
      : geometry(g),
        start(c),
        neighbour(c),
        columns(c),
        mixed(c),
        centre(c),
        contact(c),
        patches(c),
        side(c),
        patch_side(c),
        keys(c),
        layer(c),
        order(c),
        stack(c) {}
};

}  // namespace

static uint32_t vertex_of(const Geometry& geometry, uint32_t column) {
  return geometry.vertex.empty() ? column : geometry.vertex[column];
}

// The neighbours of every vertex; where a vertex has several columns, each neighbour once.
static Status build_graph(const Csc& lower, Dissector* d) {
  const Geometry& g = d->geometry;
  const uint32_t vertices = static_cast<uint32_t>(g.position.size());
  Context& context = d->start.context();
  Array<uint32_t> next(context), seen(context);
  TRY(assign_in_parts(size_t{vertices} + 1, 0, &d->start));
  TRY(assign_in_parts(vertices, 0, &d->columns));
  Pace pace(context, k_light_steps_per_checkpoint);
  for (uint32_t j = 0; j < lower.cols; ++j) {
    TRY(pace.after(lower.start[j + 1] - lower.start[j]));
    const uint32_t v = vertex_of(g, j);
    ++d->columns[v];
    for (uint32_t k = lower.start[j] + 1; k < lower.start[j + 1]; ++k) {
      const uint32_t w = vertex_of(g, lower.row[k]);
      if (w == v) continue;
      ++d->start[v];
      ++d->start[w];
    }
  }
  TRY(d->neighbour.resize(starts_from_counts(d->start.span())));
  TRY(copy_in_parts(d->start, &next));
  for (uint32_t j = 0; j < lower.cols; ++j) {
    TRY(pace.after(lower.start[j + 1] - lower.start[j]));
    const uint32_t v = vertex_of(g, j);
    for (uint32_t k = lower.start[j] + 1; k < lower.start[j + 1]; ++k) {
      const uint32_t w = vertex_of(g, lower.row[k]);
      if (w == v) continue;
      d->neighbour[next[v]++] = w;
      d->neighbour[next[w]++] = v;
    }
  }
  if (g.vertex.empty()) return {};
  TRY(assign_in_parts(vertices, k_none, &seen));
  uint32_t write = 0;
  for (uint32_t v = 0; v < vertices; ++v) {
    const uint32_t first = d->start[v], end = d->start[v + 1];
    TRY(pace.after(end - first));
    d->start[v] = write;
    for (uint32_t k = first; k < end; ++k) {
      const uint32_t w = d->neighbour[k];
      if (seen[w] == v) continue;
      seen[w] = v;
      d->neighbour[write++] = w;
    }
  }
  d->start[vertices] = write;
  d->neighbour.shrink(write);
  return {};
}

static double greater(double a, double b) {
  return a > b ? a : b;
}

// What the patches are like and which touch each other.
static Status survey_patches(Dissector* d) {
  Context& context = d->start.context();
  const Geometry& g = d->geometry;
  const uint32_t vertices = static_cast<uint32_t>(g.position.size());
  uint32_t count = 0;
  for (const uint32_t p : g.patch) count = p >= count ? p + 1 : count;
  TRY(d->centre.assign(count, PatchCentre{}));
  TRY(d->mixed.assign(vertices, 0));
  Array<PatchContact> touch(context);
  for (uint32_t v = 0; v < vertices; ++v) {
    TRY(checkpoint_at_column(context, v));
    const uint32_t p = g.patch[v];
    PatchCentre& c = d->centre[p];
    c.sum += g.position[v];
    ++c.vertices;
    uint32_t last = p;
    const Vec3 here = g.position[v];
    for (uint32_t k = d->start[v]; k < d->start[v + 1]; ++k) {
      const uint32_t w = d->neighbour[k], q = g.patch[w];
      if (q == p) {
        if (w > v) continue;  // neighbours meet twice
        const Vec3 way = g.position[w] - here;
        c.reach = {greater(c.reach.x, std::fabs(way.x)), greater(c.reach.y, std::fabs(way.y)),
                   greater(c.reach.z, std::fabs(way.z))};
        continue;
      }
      d->mixed[v] = 1;
      if (q != last) TRY(touch.push({p < q ? p : q, p < q ? q : p, 1}));
      last = q;
    }
  }
  sort(touch.span(), [](const PatchContact& a, const PatchContact& b) {
    return a.p != b.p ? a.p < b.p : a.q < b.q;
  });
  for (const PatchContact& t : touch) {
    const bool same =
        !d->contact.empty() && d->contact.back().p == t.p && d->contact.back().q == t.q;
    if (same) {
      ++d->contact.back().weight;
    } else {
      TRY(d->contact.push(t));
    }
  }
  for (uint32_t p = 0; p < count; ++p) {
    if (d->centre[p].vertices > 0) TRY(d->patches.push(p));
  }
  return d->patch_side.assign(count, 0);
}

static double along(const Vec3& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

static bool key_less(const AxisKey& a, const AxisKey& b) {
  return a.key != b.key ? a.key < b.key : a.vertex < b.vertex;
}

// Orders the patches of a stretch along one axis of space and returns how many go to the left:
// about half of all vertices.
static uint32_t halve_patches(const Stretch& s, int axis, Dissector* d) {
  const uint32_t count = s.patch_end - s.patch_first;
  uint32_t all = 0;
  for (uint32_t k = 0; k < count; ++k) {
    const uint32_t p = d->patches[s.patch_first + k];
    const PatchCentre& c = d->centre[p];
    d->keys[k] = {along(c.sum, axis) / static_cast<double>(c.vertices), p};
    all += c.vertices;
  }
  sort(d->keys.span().part(0, count), key_less);
  uint32_t left = 0, sum = 0;
  for (uint32_t k = 0; k < count; ++k) d->patches[s.patch_first + k] = d->keys[k].vertex;
  while (left + 1 < count) {
    const uint32_t more = sum + d->centre[d->patches[s.patch_first + left]].vertices;
    // Taking one more must come closer to the half.
    if (left > 0 && uint64_t{more} + sum > all) break;
    sum = more;
    ++left;
  }
  return left;
}

// Marks the patches of both sides; returns the weight of the contacts between them.
static uint32_t weigh_cut(const Stretch& s, uint32_t left, Dissector* d) {
  for (uint32_t k = s.patch_first; k < s.patch_end; ++k) {
    d->patch_side[d->patches[k]] = k - s.patch_first < left ? 1 : 2;
  }
  uint32_t weight = 0;
  for (const PatchContact& c : d->contact) {
    const uint8_t a = d->patch_side[c.p], b = d->patch_side[c.q];
    if (a != 0 && b != 0 && a != b) weight += c.weight;
  }
  return weight;
}

static void forget_patch_sides(const Stretch& s, Dissector* d) {
  for (uint32_t k = s.patch_first; k < s.patch_end; ++k) d->patch_side[d->patches[k]] = 0;
}

// Splits a stretch between whole patches along the axis whose cut is shortest, and marks both
// sides. `middle`: the first vertex of the right one.
static Status split_between_patches(const Stretch& s, Dissector* d, uint32_t* patch_middle,
                                    uint32_t* middle) {
  int best_axis = 0;
  uint32_t best = k_none;
  for (int axis = 0; axis < 3; ++axis) {
    const uint32_t left = halve_patches(s, axis, d);
    const uint32_t weight = weigh_cut(s, left, d);
    forget_patch_sides(s, d);
    if (weight >= best) continue;
    best = weight;
    best_axis = axis;
  }
  const uint32_t left = halve_patches(s, best_axis, d);
  weigh_cut(s, left, d);
  *patch_middle = s.patch_first + left;
  Context& context = d->order.context();
  uint32_t left_end = s.first, write = 0;
  TRY(in_parts(context, s.end - s.first, [&](size_t k) {
    const uint32_t v = d->order[s.first + k];
    d->side[v] = d->patch_side[d->geometry.patch[v]];
    if (d->side[v] == 1) {
      d->order[left_end++] = v;
    } else {
      d->keys[write++].vertex = v;
    }
  }));
  TRY(in_parts(context, write, [&](size_t k) { d->order[left_end + k] = d->keys[k].vertex; }));
  forget_patch_sides(s, d);
  *middle = left_end;
  return {};
}

// Splits a stretch of one patch in the middle of its longest side. `window`: only vertices with
// keys in it can touch the other side. The keys are left in the order of the vertices.
static Status split_patch(const Stretch& s, Dissector* d, uint32_t* middle, double window[2]) {
  const Span<const Vec3> position = d->geometry.position;
  Context& context = d->order.context();
  const uint32_t count = s.end - s.first, half = count / 2;
  Vec3 low = position[d->order[s.first]], high = low;
  TRY(in_parts(context, count, [&](size_t k) {
    const Vec3& p = position[d->order[s.first + k]];
    low = {-greater(-low.x, -p.x), -greater(-low.y, -p.y), -greater(-low.z, -p.z)};
    high = {greater(high.x, p.x), greater(high.y, p.y), greater(high.z, p.z)};
  }));
  const Vec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  TRY(in_parts(context, count, [&](size_t k) {
    const uint32_t v = d->order[s.first + k];
    d->keys[k] = {along(position[v], axis), v};
  }));
  TRY(select_least(context, d->keys.span().part(0, count), half, key_less));
  double greatest_left = d->keys[0].key, least_right = d->keys[half].key;
  TRY(in_parts(context, count, [&](size_t k) {
    const uint32_t v = d->keys[k].vertex;
    d->order[s.first + k] = v;
    d->side[v] = k < half ? 1 : 2;
    if (k < half) greatest_left = greater(greatest_left, d->keys[k].key);
    if (k >= half) least_right = -greater(-least_right, -d->keys[k].key);
  }));
  const double reach = along(d->centre[d->geometry.patch[d->order[s.first]]].reach, axis);
  window[0] = least_right - reach;
  window[1] = greatest_left + reach;
  *middle = s.first + half;
  return {};
}

// Whether the vertex touches the other side of the split under way.
static bool touches(const Dissector& d, uint32_t v, uint8_t other) {
  for (uint32_t k = d.start[v]; k < d.start[v + 1]; ++k) {
    if (d.side[d.neighbour[k]] == other) return true;
  }
  return false;
}

// Lists the places of those of first .. end that touch the other side; those that do not pass
// `near` cannot.
template <typename Near>
static Status list_layer(uint32_t first, uint32_t end, uint8_t other, const Near& near,
                         Dissector* d, uint32_t* layer, uint32_t* layer_size) {
  uint32_t count = 0;
  TRY(in_parts(d->order.context(), end - first, [&](size_t i) {
    const uint32_t k = first + static_cast<uint32_t>(i);
    if (near(k) && touches(*d, d->order[k], other)) layer[count++] = k;
  }));
  *layer_size = count;
  return {};
}

// The columns of the vertices at these places.
static uint32_t weigh_layer(const Dissector& d, const uint32_t* place, uint32_t count) {
  uint32_t sum = 0;
  for (uint32_t k = 0; k < count; ++k) sum += d.columns[d.order[place[k]]];
  return sum;
}

// Swaps the entries at `count` ascending places to the end of those before `end`.
static void move_to_end(const uint32_t* place, uint32_t count, uint32_t end, Dissector* d) {
  for (uint32_t k = count; k-- > 0;) swap_values(d->order[place[k]], d->order[--end]);
}

// Splits a stretch into left, right and separator, in this order, and puts both sides on the stack.
static Status divide(const Stretch& s, Dissector* d) {
  uint32_t patch_middle = s.patch_end, middle = 0, left_layer = 0, right_layer = 0;
  uint32_t* const left_place = d->layer.data();
  if (s.patch_end - s.patch_first > 1) {
    TRY(split_between_patches(s, d, &patch_middle, &middle));
    const auto near = [&](uint32_t k) { return d->mixed[d->order[k]] != 0; };
    TRY(list_layer(s.first, middle, 2, near, d, left_place, &left_layer));
    TRY(list_layer(middle, s.end, 1, near, d, left_place + left_layer, &right_layer));
  } else {
    double window[2];
    TRY(split_patch(s, d, &middle, window));
    const auto near = [&](uint32_t k) {
      const double key = d->keys[k - s.first].key;
      return key >= window[0] && key <= window[1];
    };
    TRY(list_layer(s.first, middle, 2, near, d, left_place, &left_layer));
    TRY(list_layer(middle, s.end, 1, near, d, left_place + left_layer, &right_layer));
  }
  TRY(in_parts(d->order.context(), s.end - s.first,
               [&](size_t k) { d->side[d->order[s.first + k]] = 0; }));
  d->work += s.end - s.first;
  uint32_t left_size = middle - s.first, right_size = s.end - middle;
  if (weigh_layer(*d, left_place, left_layer) <=
      weigh_layer(*d, left_place + left_layer, right_layer)) {
    move_to_end(left_place, left_layer, middle, d);
    left_size -= left_layer;
    // The layer stands between left and right: it changes places with as many of right's end.
    const uint32_t swaps = left_layer < right_size ? left_layer : right_size;
    for (uint32_t k = 0; k < swaps; ++k) {
      swap_values(d->order[s.first + left_size + k], d->order[s.end - 1 - k]);
    }
  } else {
    move_to_end(left_place + left_layer, right_layer, s.end, d);
    right_size -= right_layer;
  }
  const uint32_t right_first = s.first + left_size;
  const uint32_t right_patch = patch_middle == s.patch_end ? s.patch_first : patch_middle;
  TRY(d->stack.push({s.first, right_first, s.patch_first, patch_middle}));
  return d->stack.push({right_first, right_first + right_size, right_patch, s.patch_end});
}

Status nested_dissection(const Csc& lower, const Geometry& geometry, Array<uint32_t>* order) {
  constexpr size_t k_work_per_checkpoint = 1u << 16;
  const uint32_t vertices = static_cast<uint32_t>(geometry.position.size());
  Context& context = order->context();
  WIRESKIN_ASSERT(geometry.patch.size() == vertices);
  WIRESKIN_ASSERT(geometry.vertex.empty() ? vertices == lower.cols
                                          : geometry.vertex.size() == lower.cols);
  Dissector d(context, geometry);
  TRY(order->reserve(lower.cols));
  TRY(build_graph(lower, &d));
  TRY(survey_patches(&d));
  TRY(d.side.assign(vertices, 0));
  TRY(d.keys.resize(vertices > d.patches.size() ? vertices : d.patches.size()));
  TRY(d.layer.resize(vertices));
  TRY(d.order.resize(vertices));
  TRY(in_parts<k_light_steps_per_checkpoint>(
      context, vertices, [&](size_t v) { d.order[v] = static_cast<uint32_t>(v); }));
  TRY(d.stack.push({0, vertices, 0, static_cast<uint32_t>(d.patches.size())}));
  while (!d.stack.empty()) {
    const Stretch s = d.stack.back();
    d.stack.pop();
    if (s.end - s.first <= k_leaf) continue;
    TRY(divide(s, &d));
    if (d.work < k_work_per_checkpoint) continue;
    d.work = 0;
    TRY(context.checkpoint());
  }
  // Columns of a vertex are neighbours in the matrix: where each begins, and all of them.
  order->clear();
  Array<uint32_t> first(context);
  TRY(assign_in_parts(size_t{vertices} + 1, lower.cols, &first));
  TRY(in_parts(context, lower.cols, [&](size_t i) {
    const uint32_t j = lower.cols - 1 - static_cast<uint32_t>(i);
    first[vertex_of(geometry, j)] = j;
  }));
  return in_parts(context, vertices, [&](size_t k) {
    const uint32_t v = d.order[k];
    for (uint32_t j = first[v]; j < lower.cols && vertex_of(geometry, j) == v; ++j) {
      order->push_reserved(j);
    }
  });
}

}  // namespace wireskin::sparse
