#include "flow/thicken.h"

#include "base/in_parts.h"
#include "base/sort.h"
#include "num/minmax.h"

namespace wireskin::flow {

static constexpr double k_outside_key = 10.0;

namespace {

struct Room {
  double greatest = 0.0;  // the largest squared circumradius
  uint32_t owner = 0;     // the label of the void that it belongs to
  bool filled = false;
};

struct Wall {
  uint32_t room[2];  // on its sides; equal for a fin
  double value;      // greatest of its triangles
  double feasibility;
  uint32_t paired;  // room whose maximum is paired with a creator in this wall, or k_none
  bool present, addable;
};

// The complex of all voids: small where the Delaunay complex is large.
struct Cells {
  Sheet sheet;
  Array<uint32_t> room_of;  // tetrahedra and outside
  Array<uint32_t> wall_of;  // triangles
  Array<Room> room;
  Array<Wall> wall;
  Array<uint32_t> start, triangle;  // of each wall
  Array<uint32_t> room_start, room_wall;

  explicit Cells(Context& context)
      : sheet(context),
        room_of(context),
        wall_of(context),
        room(context),
        wall(context),
        start(context),
        triangle(context),
        room_start(context),
        room_wall(context) {}
};

struct Opening {
  double key;
  uint32_t wall;
};

}  // namespace

Status find_tangents(const Samples& samples, SampleTangents* tangents) {
  TRY(tangents->start.assign(samples.position.size() + 1, 0));
  size_t count = 0;
  const auto each_segment = [&](const auto& visit) {
    for (uint32_t a = 0; a + 1 < samples.start.size(); ++a) {
      for (uint32_t i = samples.start[a]; i + 1 < samples.start[a + 1]; ++i) {
        visit(samples.at[i], samples.at[i + 1]);
      }
    }
  };
  each_segment([&](uint32_t p, uint32_t q) {
    ++tangents->start[p];
    ++tangents->start[q];
    count += 2;
  });
  TRY(tangents->direction.resize(count));
  starts_from_counts(tangents->start.span());
  each_segment([&](uint32_t p, uint32_t q) {
    const Vec3 direction = unit(samples.position[q] - samples.position[p]);
    tangents->direction[tangents->start[p]++] = direction;
    tangents->direction[tangents->start[q]++] = direction;
  });
  for (size_t v = tangents->start.size() - 1; v > 0; --v) {
    tangents->start[v] = tangents->start[v - 1];
  }
  tangents->start[0] = 0;
  return {};
}

// ---- The complex of rooms and walls -------------------------------------------------------------

static Status number_rooms(Context& context, const Complex& complex, Span<const uint32_t> owner,
                           Cells* cells) {
  Array<uint32_t> label(context), number(context);
  Pace pace(context);
  TRY(label_rooms(complex, cells->sheet, &label));
  TRY(number.assign(label.size(), k_none));
  TRY(cells->room_of.resize(label.size()));
  for (uint32_t i = 0; i < label.size(); ++i) {
    TRY(pace.after());
    uint32_t& room = number[label[i]];
    if (room == k_none) {
      room = static_cast<uint32_t>(cells->room.size());
      TRY(cells->room.push({0.0, owner[i], false}));
    }
    cells->room_of[i] = room;
    const double value = i + 1 < label.size() ? complex.tet_value[i] : DBL_MAX;
    cells->room[room].greatest = larger(cells->room[room].greatest, value);
  }
  return {};
}

static double feasibility_of(const Complex& complex, const SampleTangents& tangents,
                             Span<const uint32_t> wall) {
  double area_sum = 0.0, sum = 0.0;
  for (const uint32_t t : wall) {
    const uint32_t* const v = &complex.triangle[3 * size_t{t}];
    const Vec3& a = complex.point[v[0]];
    const Vec3 across = cross(complex.point[v[1]] - a, complex.point[v[2]] - a);
    const double area = length(across);
    const Vec3 normal = unit(across);
    double feasibility = 3.0;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t first = tangents.start[v[k]], last = tangents.start[v[k] + 1];
      double least = first < last ? 1.0 : 0.0;
      for (uint32_t i = first; i < last; ++i) {
        least = smaller(least, std::fabs(dot(normal, tangents.direction[i])));
      }
      feasibility -= least;
    }
    area_sum += area;
    sum += area * feasibility;
  }
  return area_sum > 0.0 ? sum / area_sum : 0.0;
}

static uint32_t room_at(const Complex& complex, const Cells& cells, uint32_t triangle,
                        uint32_t side) {
  return cells.room_of[complex.side_of(triangle, side)];
}

// The classes of triangles under edges that are no curve and have two of them.
static Status number_walls(const Complex& complex, const CurveEdges& curves, const FlatCells& flat,
                           const SampleTangents& tangents, const Topology3& topology,
                           Cells* cells) {
  Array<uint32_t>& queue = cells->triangle;
  Pace pace(queue.context());
  TRY(cells->wall_of.assign(complex.triangle_count(), k_none));
  TRY(cells->start.push(0));
  for (uint32_t t = 0; t < complex.triangle_count(); ++t) {
    TRY(pace.after());
    if (cells->sheet.in[t] == 0 || cells->wall_of[t] != k_none) continue;
    const uint32_t wall = static_cast<uint32_t>(cells->wall.size());
    const size_t first = queue.size();
    double value = 0.0;
    TRY(queue.push(t));
    cells->wall_of[t] = wall;
    for (size_t i = first; i < queue.size(); ++i) {
      TRY(pace.after());
      value = larger(value, complex.triangle_value[queue[i]]);
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t e = complex.triangle_edge[3 * size_t{queue[i]} + k];
        if (cells->sheet.degree[e] != 2 || curves.on_curve(e)) continue;
        for (const uint32_t next : complex.triangles_of(e)) {
          if (cells->sheet.in[next] == 0 || cells->wall_of[next] != k_none) continue;
          cells->wall_of[next] = wall;
          TRY(queue.push(next));
        }
      }
    }
    const Span<const uint32_t> part = queue.span().part(first, queue.size() - first);
    TRY(cells->start.push(static_cast<uint32_t>(queue.size())));
    TRY(cells->wall.push(
        {{room_at(complex, *cells, t, 0), room_at(complex, *cells, t, 1)},
         value,
         feasibility_of(complex, tangents, part),
         k_none,
         topology.walls.in[t] != 0,
         topology.closed.in[t] == 0 &&
             !(flat.any_settled &&
               measure_border(complex, curves, flat, cells->sheet, part).is_idle())}));
  }
  return {};
}

static Status link_rooms(Cells* cells) {
  TRY(cells->room_start.assign(cells->room.size() + 1, 0));
  TRY(cells->room_wall.resize(2 * cells->wall.size()));
  for (const Wall& w : cells->wall) {
    for (const uint32_t r : w.room) ++cells->room_start[r];
  }
  starts_from_counts(cells->room_start.span());
  for (uint32_t i = 0; i < cells->wall.size(); ++i) {
    for (const uint32_t r : cells->wall[i].room) cells->room_wall[cells->room_start[r]++] = i;
  }
  shift_starts_back(cells->room_start.span());
  return {};
}

static Status find_cells(Context& context, const Complex& complex, const CurveEdges& curves,
                         const FlatCells& flat, const Persistence& persistence,
                         const SampleTangents& tangents, const Topology3& topology, Cells* cells) {
  TRY(start_sheet(complex, &cells->sheet));
  TRY(in_parts(context, complex.triangle_count(), [&](size_t i) {
    const uint32_t t = static_cast<uint32_t>(i), v = persistence.void_of[t];
    if (persistence.creator[t] == 0 || v != k_none) add_to_sheet(complex, t, &cells->sheet);
  }));
  TRY(peel(complex, curves, Protect::curves, &cells->sheet));
  TRY(number_rooms(context, complex, topology.label.span(), cells));
  TRY(number_walls(complex, curves, flat, tangents, topology, cells));
  TRY(link_rooms(cells));
  for (const Void& v : persistence.voids) {
    const uint32_t wall = cells->wall_of[v.creator];
    if (wall != k_none) cells->wall[wall].paired = cells->room_of[v.maximum];
  }
  return {};
}

// ---- Filling ------------------------------------------------------------------------------------

// An added wall must keep the room that it is paired with, or any if it is paired with none.
static bool stays(const Cells& cells, const Wall& wall) {
  if (wall.paired != k_none) return cells.room[wall.paired].filled;
  return cells.room[wall.room[0]].filled || cells.room[wall.room[1]].filled;
}

// Figure 17: takes out what would change the topology, until nothing does.
static Status take_back(Array<uint8_t>* added, Cells* cells) {
  Pace pace(added->context());
  for (bool changed = true; changed;) {
    changed = false;
    for (uint32_t i = 0; i < cells->wall.size(); ++i) {
      TRY(pace.after());
      const Wall& wall = cells->wall[i];
      if ((*added)[i] != 0 && !stays(*cells, wall)) {
        (*added)[i] = 0;
        changed = true;
      }
      if ((*added)[i] != 0 || wall.present) continue;
      for (const uint32_t r : wall.room) {
        if (!cells->room[r].filled) continue;
        cells->room[r].filled = false;
        changed = true;
      }
    }
  }
  return {};
}

static Status fill_rooms(const Complex& complex, const Persistence& persistence,
                         const Topology3& topology, double reach, Array<uint8_t>* added,
                         Cells* cells, bool* any) {
  const Void& first = persistence.voids[topology.chosen[0]];
  const double limit = reach * reach * complex.triangle_value[first.creator];
  TRY(added->assign(cells->wall.size(), 0));
  for (Room& r : cells->room) r.filled = r.greatest < limit;
  for (const uint32_t v : topology.chosen) {
    cells->room[cells->room_of[persistence.voids[v].maximum]].filled = false;
  }
  for (uint32_t i = 0; i < cells->wall.size(); ++i) {
    const Wall& wall = cells->wall[i];
    (*added)[i] = !wall.present && wall.addable && wall.value < limit;
  }
  TRY(take_back(added, cells));
  *any = false;
  for (const Room& r : cells->room) *any = *any || r.filled;
  return {};
}

// ---- Emptying -----------------------------------------------------------------------------------

static bool before(const Opening& a, const Opening& b) {
  return a.key != b.key ? a.key < b.key : a.wall < b.wall;
}

static bool between_full_and_empty(const Cells& cells, const Wall& wall) {
  return cells.room[wall.room[0]].filled != cells.room[wall.room[1]].filled;
}

// The walls of an empty room behind which there is a full one.
static Status push_openings(const Cells& cells, uint32_t room, double outside_key,
                            uint32_t outside_label, Array<Opening>* heap) {
  for (uint32_t i = cells.room_start[room]; i < cells.room_start[room + 1]; ++i) {
    const Wall& wall = cells.wall[cells.room_wall[i]];
    if (!between_full_and_empty(cells, wall)) continue;
    const double extra = cells.room[room].owner == outside_label ? outside_key : 0.0;
    TRY(heap->push({extra + wall.feasibility, cells.room_wall[i]}));
    for (size_t child = heap->size() - 1; child > 0;) {
      const size_t parent = (child - 1) / 2;
      if (!before((*heap)[child], (*heap)[parent])) break;
      swap_values((*heap)[child], (*heap)[parent]);
      child = parent;
    }
  }
  return {};
}

static Opening pop_opening(Array<Opening>* heap) {
  const Opening top = (*heap)[0];
  (*heap)[0] = heap->back();
  heap->pop();
  const auto after = [](const Opening& a, const Opening& b) { return before(b, a); };
  if (!heap->empty()) sift_down(heap->data(), 0, heap->size(), after);
  return top;
}

// Each full room is opened through one wall, to the void that reaches it first.
static Status empty_rooms(Context& context, uint32_t outside_label, bool inside_first, Cells* cells,
                          Array<uint8_t>* opened) {
  Array<Opening> heap(context);
  const double outside_key = inside_first ? k_outside_key : 0.0;
  TRY(opened->assign(cells->wall.size(), 0));
  for (uint32_t r = 0; r < cells->room.size(); ++r) {
    if (cells->room[r].filled) continue;
    TRY(push_openings(*cells, r, outside_key, outside_label, &heap));
  }
  while (!heap.empty()) {
    const uint32_t i = pop_opening(&heap).wall;
    const Wall& wall = cells->wall[i];
    if (!between_full_and_empty(*cells, wall)) continue;
    const uint32_t full = cells->room[wall.room[0]].filled ? wall.room[0] : wall.room[1];
    const uint32_t empty = wall.room[0] == full ? wall.room[1] : wall.room[0];
    (*opened)[i] = 1;
    cells->room[full].filled = false;
    cells->room[full].owner = cells->room[empty].owner;
    TRY(push_openings(*cells, full, outside_key, outside_label, &heap));
  }
  return {};
}

Status thicken_and_prune(Context& context, const Complex& complex, const CurveEdges& curves,
                         const FlatCells& flat, const Persistence& persistence,
                         const SampleTangents& tangents, const ThickenOptions& options,
                         Topology3* topology) {
  if (topology->chosen.empty() || !(options.reach > 0.0)) return {};
  Cells cells(context);
  Array<uint8_t> added(context), opened(context);
  bool any = false;
  TRY(find_cells(context, complex, curves, flat, persistence, tangents, *topology, &cells));
  TRY(context.checkpoint());
  TRY(fill_rooms(complex, persistence, *topology, options.reach, &added, &cells, &any));
  if (!any) return {};
  const uint32_t outside_label = topology->label[complex.tet_count()];
  TRY(empty_rooms(context, outside_label, options.inside_first, &cells, &opened));
  begin_removal(&topology->walls);
  Pace pace(context);
  for (uint32_t i = 0; i < cells.wall.size(); ++i) {
    for (uint32_t k = cells.start[i]; k < cells.start[i + 1]; ++k) {
      if (opened[i] != 0) {
        remove_triangle(complex, curves, cells.triangle[k], &topology->walls);
      } else if (added[i] != 0) {
        add_to_sheet(complex, cells.triangle[k], &topology->walls);
      }
    }
    TRY(pace.after(cells.start[i + 1] - cells.start[i]));
  }
  TRY(peel(complex, curves, Protect::curves, &topology->walls));
  return label_rooms(complex, topology->walls, &topology->label);
}

}  // namespace wireskin::flow
