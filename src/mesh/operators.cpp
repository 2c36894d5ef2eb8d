#include "mesh/operators.h"

#include "base/in_parts.h"

namespace wireskin::mesh {

// From the dot products of the edge vectors at each corner and twice the area.
static TriangleShape shape_from(double dot_a, double dot_b, double dot_c, double twice_area) {
  const double inverse = 1.0 / twice_area;
  return {{dot_a * inverse, dot_b * inverse, dot_c * inverse}, 0.5 * twice_area};
}

TriangleShape triangle_shape(const Vec2& a, const Vec2& b, const Vec2& c) {
  return shape_from(dot(b - a, c - a), dot(c - b, a - b), dot(a - c, b - c), cross(b - a, c - a));
}

TriangleShape triangle_shape(const Vec3& a, const Vec3& b, const Vec3& c) {
  return shape_from(dot(b - a, c - a), dot(c - b, a - b), dot(a - c, b - c),
                    length(cross(b - a, c - a)));
}

Status triangle_shapes(Span<const Vec3> positions, Span<const uint32_t> triangles,
                       Array<TriangleShape>* shapes) {
  TRY(shapes->resize(triangles.size() / 3));
  return in_parts(shapes->context(), shapes->size(), [&](size_t t) {
    (*shapes)[t] = triangle_shape(positions[triangles[3 * t]], positions[triangles[3 * t + 1]],
                                  positions[triangles[3 * t + 2]]);
  });
}

void barycentric_areas(Span<const uint32_t> triangles, Span<const TriangleShape> shapes,
                       Span<double> areas) {
  for (double& a : areas) a = 0.0;
  for (size_t h = 0; h < triangles.size(); ++h) areas[triangles[h]] += shapes[h / 3].area / 3.0;
}

// The share of corner k. The square of the edge opposite to corner i is twice the area times the
// sum of the other two cotangents, so the shape alone is enough.
static double mixed_voronoi_share(const TriangleShape& shape, int k) {
  const double here = shape.cotangent[k];
  const double next = shape.cotangent[(k + 1) % 3], previous = shape.cotangent[(k + 2) % 3];
  if (here < 0.0) return 0.5 * shape.area;
  if (next < 0.0 || previous < 0.0) return 0.25 * shape.area;
  return 0.25 * shape.area * ((here + next) * previous + (here + previous) * next);
}

CornerAreas mixed_voronoi_shares(const TriangleShape& shape) {
  return {{mixed_voronoi_share(shape, 0), mixed_voronoi_share(shape, 1),
           mixed_voronoi_share(shape, 2)}};
}

Status mixed_voronoi_areas(Context& context, Span<const uint32_t> triangles,
                           Span<const TriangleShape> shapes, Span<double> areas) {
  TRY(in_parts(context, areas.size(), [&](size_t v) { areas[v] = 0.0; }));
  return in_parts(context, shapes.size(), [&](size_t t) {
    const CornerAreas shares = mixed_voronoi_shares(shapes[t]);
    for (size_t k = 0; k < 3; ++k) areas[triangles[3 * t + k]] += shares.at[k];
  });
}

namespace {

// One column of the matrix while it is being gathered: its rows, in the order in which the
// triangles bring them, and their sums in a dense array.
struct ColumnUnderWay {
  Array<uint32_t> met;  // of each row: the last column that had it
  Array<double> sum;    // of each row
  Array<uint32_t> row;
  uint32_t count = 0;

  explicit ColumnUnderWay(Context& context) : met(context), sum(context), row(context) {}
};

}  // namespace

// Every other call meets a new row, so no branch should ask.
static void add_to_column(uint32_t v, uint32_t row, double value, ColumnUnderWay* column) {
  const bool fresh = column->met[row] != v;
  const double before[2] = {column->sum[row], 0.0};
  column->met[row] = v;
  column->row[column->count] = row;
  column->count += fresh;
  column->sum[row] = before[fresh] + value;
}

Status cotangent_laplacian(uint32_t vertices, Span<const uint32_t> triangles,
                           Span<const TriangleShape> shapes, sparse::Csc* laplacian) {
  Context& context = laplacian->start.context();
  Array<uint32_t> start(context), corner(context);
  ColumnUnderWay column(context);
  TRY(find_corners(vertices, triangles, &start, &corner));
  TRY(column.met.resize(vertices));
  TRY(column.sum.resize(vertices));
  TRY(column.row.resize(size_t{vertices} + 1));
  laplacian->rows = laplacian->cols = vertices;
  TRY(laplacian->start.resize(size_t{vertices} + 1));
  // Twice the edges and the diagonal, as long as no more than a few edges are on borders.
  size_t room = size_t{vertices} + triangles.size() + triangles.size() / 32;
  if (size_t{vertices} + 2 * triangles.size() >= k_none) {
    return fail(Code::too_large, "the mesh is too large for 32-bit indices");
  }
  TRY(laplacian->row.reserve(room));
  TRY(laplacian->value.reserve(room));
  laplacian->row.clear();
  laplacian->value.clear();
  TRY(in_parts(context, vertices, [&](size_t v) {
    column.met[v] = k_none;
    column.sum[v] = 0.0;
  }));
  for (uint32_t v = 0; v < vertices; ++v) {
    laplacian->start[v] = static_cast<uint32_t>(laplacian->row.size());
    // A column has its diagonal and at most two entries a triangle.
    const size_t most = laplacian->row.size() + 1 + size_t{2} * (start[v + 1] - start[v]);
    if (most > room) {
      room = most + most / 8;
      TRY(laplacian->row.reserve(room));
      TRY(laplacian->value.reserve(room));
    }
    column.count = 0;
    add_to_column(v, v, 0.0, &column);
    double diagonal = 0.0;
    for (uint32_t k = start[v]; k < start[v + 1]; ++k) {
      const uint32_t triangle = corner[k] / 3, own = corner[k] % 3;
      const uint32_t next = own == 2 ? 0 : own + 1, previous = own == 0 ? 2 : own - 1;
      const TriangleShape& shape = shapes[triangle];
      const double to_next = 0.5 * shape.cotangent[previous];
      const double to_previous = 0.5 * shape.cotangent[next];
      add_to_column(v, triangles[size_t{3} * triangle + next], to_next, &column);
      add_to_column(v, triangles[size_t{3} * triangle + previous], to_previous, &column);
      diagonal += -to_next - to_previous;
    }
    column.sum[v] = diagonal;
    TRY(sparse::append_column(column.row.span().part(0, column.count), column.sum.span(),
                              laplacian));
    if (v % 8192 == 8191) TRY(context.checkpoint());
  }
  laplacian->start[vertices] = static_cast<uint32_t>(laplacian->row.size());
  return {};
}

}  // namespace wireskin::mesh
