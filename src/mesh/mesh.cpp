#include "mesh/mesh.h"

#include "base/in_parts.h"
#include "num/trig.h"

namespace wireskin::mesh {

static Status fail_triangle(const char* sentence, size_t triangle) {
  Place place;
  place.triangle = static_cast<uint32_t>(triangle);
  return fail(Code::bad_mesh, sentence, place);
}

static Status fail_vertex(const char* sentence, size_t vertex) {
  Place place;
  place.vertex = static_cast<uint32_t>(vertex);
  return fail(Code::bad_mesh, sentence, place);
}

static Status check_indices(Context& context, uint32_t vertices, Span<const uint32_t> triangles) {
  Pace pace(context);
  for (size_t t = 0; t < triangles.size() / 3; ++t) {
    const uint32_t a = triangles[3 * t], b = triangles[3 * t + 1], c = triangles[3 * t + 2];
    if (a >= vertices || b >= vertices || c >= vertices) {
      Place place;
      place.triangle = static_cast<uint32_t>(t);
      return fail(Code::index_out_of_range, "the triangle names a vertex that does not exist",
                  place);
    }
    if (a == b || b == c || c == a) return fail_triangle("the triangle has a vertex twice", t);
    TRY(pace.after());
  }
  return {};
}

Status find_corners(uint32_t vertices, Span<const uint32_t> triangles, Array<uint32_t>* start,
                    Array<uint32_t>* corner) {
  Context& context = start->context();
  TRY(assign_in_parts(size_t{vertices} + 1, 0, start));
  TRY(corner->resize(triangles.size()));
  TRY(in_parts(context, triangles.size(), [&](size_t h) { ++(*start)[triangles[h]]; }));
  starts_from_counts(start->span());
  TRY(in_parts(context, triangles.size(),
               [&](size_t h) { (*corner)[(*start)[triangles[h]]++] = static_cast<uint32_t>(h); }));
  shift_starts_back(start->span());
  return {};
}

Status find_twins(uint32_t vertices, Span<const uint32_t> triangles, Array<uint32_t>* twins) {
  if (triangles.size() >= k_none) return fail(Code::too_large, "too many triangles");
  Context& context = twins->context();
  TRY(check_indices(context, vertices, triangles));
  Array<uint32_t> start(context), corner(context), leaving_to(context);
  TRY(find_corners(vertices, triangles, &start, &corner));
  TRY(assign_in_parts(vertices, k_none,
                      &leaving_to));  // of each vertex: the half-edge to it from this one
  TRY(twins->resize(triangles.size()));
  const auto head = [&](uint32_t h) { return triangles[next_half_edge(h)]; };
  Pace pace(context);
  for (uint32_t v = 0; v < vertices; ++v) {
    const Span<const uint32_t> leaving = corner.span().part(start[v], start[v + 1] - start[v]);
    for (uint32_t h : leaving) {
      if (leaving_to[head(h)] != k_none) {
        return fail_triangle("an edge of the triangle belongs to another one in the same direction",
                             h / 3);
      }
      leaving_to[head(h)] = h;
    }
    // Every half-edge arrives at one vertex, in the triangle of one that leaves there.
    for (uint32_t h : leaving) {
      const uint32_t arriving = previous_half_edge(h);
      (*twins)[arriving] = leaving_to[triangles[arriving]];
    }
    for (uint32_t h : leaving) leaving_to[head(h)] = k_none;
    TRY(pace.after());
  }
  return {};
}

// Joins the vertices of each triangle; every tree's root is its least vertex.
static uint32_t root_of(Span<uint32_t> parent, uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

static Status find_components(Context& context, Span<const uint32_t> triangles,
                              Topology* topology) {
  const Span<uint32_t> parent = topology->component.span();
  TRY(in_parts<k_light_steps_per_checkpoint>(
      context, parent.size(), [&](size_t v) { parent[v] = static_cast<uint32_t>(v); }));
  TRY(in_parts(context, triangles.size() / 3, [&](size_t t) {
    for (size_t h = 3 * t + 1; h < 3 * t + 3; ++h) {
      const uint32_t a = root_of(parent, triangles[3 * t]), b = root_of(parent, triangles[h]);
      (a < b ? parent[b] : parent[a]) = a < b ? a : b;
    }
  }));
  // Roots come before their members, so one pass replaces parents by component numbers.
  return in_parts(context, parent.size(), [&](size_t v) {
    parent[v] = parent[v] == v ? topology->components++ : parent[parent[v]];
  });
}

namespace {

// The corners of a vertex: how many there are, at how many of them the surface ends clockwise, and
// the last of those, or one of all where there are none.
struct Fan {
  uint32_t first;
  uint32_t corners;
  uint32_t borders;
};

}  // namespace

static Status find_fans(Context& context, Span<const uint32_t> triangles,
                        Span<const uint32_t> twins, Span<Fan> fans) {
  TRY(in_parts<k_light_steps_per_checkpoint>(context, fans.size(), [&](size_t v) {
    fans[v] = {0, 0, 0};
  }));
  return in_parts(context, triangles.size(), [&](size_t h) {
    Fan& fan = fans[triangles[h]];
    const uint32_t border = twins[h] == k_none;
    ++fan.corners;
    fan.borders += border;
    if (border != 0 || fan.borders == 0) fan.first = static_cast<uint32_t>(h);
  });
}

// Walks round every vertex from one of its corners (at a border vertex: from the border) and
// compares the number of triangles met with those it has.
static Status check_fans(Context& context, Span<const uint32_t> twins, Span<const Fan> fans,
                         Span<uint8_t> on_border) {
  Pace pace(context);
  for (size_t v = 0; v < fans.size(); ++v) {
    const Fan fan = fans[v];
    if (fan.corners == 0) return fail_vertex("the vertex belongs to no triangle", v);
    uint32_t met = 0, h = fan.first;
    do {
      ++met;
      h = twins[previous_half_edge(h)];
    } while (h != k_none && h != fan.first && met <= fan.corners);
    if (fan.borders > 1 || met != fan.corners) {
      return fail_vertex("the triangles round the vertex do not form one fan", v);
    }
    on_border[v] = fan.borders == 1;
    TRY(pace.after());
  }
  return {};
}

// Follows every border once, marking its half-edges.
static Status count_loops(Span<const uint32_t> twins, Context& context, uint32_t* loops) {
  Array<uint8_t> seen(context);
  TRY(assign_in_parts(twins.size(), 0, &seen));
  Pace pace(context, k_light_steps_per_checkpoint);
  for (uint32_t h = 0; h < twins.size(); ++h) {
    TRY(pace.after());
    if (twins[h] != k_none || seen[h]) continue;
    ++*loops;
    for (uint32_t g = h; !seen[g];) {
      TRY(pace.after());
      seen[g] = 1;
      g = next_half_edge(g);
      while (twins[g] != k_none) g = next_half_edge(twins[g]);
    }
  }
  return {};
}

Status find_topology(uint32_t vertices, Span<const uint32_t> triangles, Span<const uint32_t> twins,
                     Topology* topology) {
  Context& context = topology->on_border.context();
  Array<Fan> fans(context);
  TRY(fans.resize(vertices));
  TRY(assign_in_parts(vertices, 0, &topology->on_border));
  TRY(topology->component.resize(vertices));
  TRY(find_fans(context, triangles, twins, fans.span()));
  TRY(check_fans(context, twins, fans.span(), topology->on_border.span()));
  TRY(find_components(context, triangles, topology));
  TRY(count_loops(twins, context, &topology->boundary_loops));
  TRY(in_parts(context, twins.size(),
               [&](size_t h) { topology->edges += twins[h] == k_none || h < twins[h]; }));
  topology->euler_characteristic = static_cast<int32_t>(int64_t{vertices} - topology->edges +
                                                        static_cast<int64_t>(triangles.size() / 3));
  return {};
}

Status check_areas(Context& context, Span<const Vec3> positions, Span<const uint32_t> triangles) {
  Pace pace(context);
  for (size_t t = 0; t < triangles.size(); t += 3) {
    const Vec3& a = positions[triangles[t]];
    const Vec3 area = cross(positions[triangles[t + 1]] - a, positions[triangles[t + 2]] - a);
    if (!(dot(area, area) > 0.0)) return fail_triangle("the triangle has no area", t / 3);
    TRY(pace.after());
  }
  return {};
}

Status patches_of_vertices(Context& context, Span<const uint32_t> triangles,
                           Span<const uint32_t> patch, Span<uint32_t> result) {
  return in_parts(context, triangles.size(),
                  [&](size_t h) { result[triangles[h]] = patch[h / 3]; });
}

// The smallest angle of a triangle has the largest cosine, so one arctangent at the end is enough.
Status least_angle(Context& context, Span<const Vec3> positions, Span<const uint32_t> triangles,
                   double* degrees) {
  double greatest_cosine = -1.0;
  double angle = 0.0;
  TRY(in_parts(context, triangles.size() / 3, [&](size_t t) {
    const uint32_t* v = &triangles[3 * t];
    const Vec3 at[3] = {positions[v[0]], positions[v[1]], positions[v[2]]};
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = at[k == 2 ? 0 : k + 1] - at[k], b = at[k == 0 ? 2 : k - 1] - at[k];
      const double product = dot(a, b), squares = dot(a, a) * dot(b, b);
      // A cosine that is surely less needs no root.
      const double enough = (1.0 - 1e-9) * greatest_cosine * greatest_cosine * squares;
      if (greatest_cosine > 0.0 && squares > 1e-200 && product * std::fabs(product) < enough) {
        continue;
      }
      const double cosine = product / std::sqrt(squares);
      if (!(cosine > greatest_cosine)) continue;
      greatest_cosine = cosine;
      angle = angle_between(a, b);
    }
  }));
  *degrees = angle * (180.0 / k_pi);
  return {};
}

}  // namespace wireskin::mesh
