#include "api/view.h"

namespace wireskin::api {

// Where the arrays of a surface's view stand in its block.
struct SurfaceLayout {
  size_t positions, normals, curvature, gaussian, constraint, vertex_curve, triangle, patch;
  size_t edges, edge_curve, guarded, sentences, statuses, ways, patch_start, patch_curve;
  size_t crease_corners, crease_normals, bytes;

  explicit SurfaceLayout(const Surface& surface) {
    const size_t n = surface.position.size(), triangles = surface.patch.size();
    const size_t listed = surface.patches.status.size();
    Layout layout(sizeof(wsk_surface));
    positions = layout.add_array<double>(3 * n);
    normals = layout.add_array<double>(3 * n);
    curvature = layout.add_array<double>(n);
    gaussian = layout.add_array<double>(n);
    constraint = layout.add_array<double>(3 * n);
    vertex_curve = layout.add_array<uint32_t>(n);
    triangle = layout.add_array<uint32_t>(3 * triangles);
    patch = layout.add_array<uint32_t>(triangles);
    edges = layout.add_array<uint32_t>(surface.curve_edge.size());
    edge_curve = layout.add_array<uint32_t>(surface.curve_edge_curve.size());
    guarded = layout.add_array<uint8_t>(has_guard(surface) ? surface.patch_guarded.size() : 0);
    sentences = layout.add_array<const char*>(listed);
    statuses = layout.add_array<wsk_status>(listed);
    ways = layout.add_array<uint8_t>(listed);
    patch_start = layout.add_array<uint32_t>(surface.patches.curve_start.size());
    patch_curve = layout.add_array<uint32_t>(surface.patches.curve.size());
    crease_corners = layout.add_array<uint32_t>(surface.crease_normals.corner.size());
    crease_normals = layout.add_array<double>(3 * surface.crease_normals.normal.size());
    bytes = layout.bytes();
  }

  static bool has_guard(const Surface& surface) {
    return !surface.patch_guarded.empty() && !surface.curve_edge.empty();
  }
};

static Status write_indices(const Array<uint32_t>& values, unsigned char* place,
                            const uint32_t** indices) {
  uint32_t* const out = reinterpret_cast<uint32_t*>(place);
  *indices = values.empty() ? nullptr : out;
  return in_parts<k_light_steps_per_checkpoint>(values.context(), values.size(),
                                                [&](size_t i) { out[i] = values[i]; });
}

static Status write_curvatures(Context& context, const Surface& surface,
                               const SurfaceLayout& layout, const Scale& curvatures,
                               unsigned char* block, wsk_surface_view* view) {
  double* h = reinterpret_cast<double*>(block + layout.curvature);
  double* k = reinterpret_cast<double*>(block + layout.gaussian);
  view->mean_curvature = h;
  view->gaussian_curvature = k;
  return in_parts(context, surface.position.size(), [&](size_t v) {
    h[v] = curvatures(surface.mean_curvature[v]);
    k[v] = curvatures(curvatures(surface.gaussian_curvature[v]));
  });
}

// Surfaces of meshes and of flows have patches that no list says more of.
static Status write_patch_list(const Surface& surface, const SurfaceLayout& layout,
                               unsigned char* block, wsk_surface_view* view) {
  const size_t listed = surface.patches.status.size();
  const char** sentence = reinterpret_cast<const char**>(block + layout.sentences);
  wsk_status* status = reinterpret_cast<wsk_status*>(block + layout.statuses);
  for (size_t p = 0; p < listed; ++p) {
    sentence[p] = surface.patches.status[p].sentence;
    status[p] = static_cast<wsk_status>(surface.patches.status[p].code);
    block[layout.ways + p] = surface.patches.way[p];
  }
  view->patch_sentence = listed > 0 ? sentence : nullptr;
  view->patch_status = listed > 0 ? status : nullptr;
  view->patch_way = listed > 0 ? block + layout.ways : nullptr;
  TRY(write_indices(surface.patches.curve_start, block + layout.patch_start,
                    &view->patch_curve_start));
  return write_indices(surface.patches.curve, block + layout.patch_curve, &view->patch_curves);
}

Status make_handle(Context& context, const Surface& surface, int exponent, wsk_surface** out) {
  const SurfaceLayout layout(surface);
  void* memory = nullptr;
  TRY(context.allocate(layout.bytes, 1, &memory));
  unsigned char* block = static_cast<unsigned char*>(memory);
  const Scale none(0), lengths(exponent), curvatures(-exponent);
  wsk_surface* handle = static_cast<wsk_surface*>(memory);
  handle->allocator = context.allocator();
  handle->bytes = layout.bytes;
  *out = handle;
  wsk_surface_view& view = handle->view;
  view = {};
  view.size = sizeof view;
  view.vertex_count = static_cast<uint32_t>(surface.position.size());
  view.triangle_count = static_cast<uint32_t>(surface.patch.size());
  view.patch_count = surface.counts.patches;
  view.curve_edge_count = static_cast<uint32_t>(surface.curve_edge_curve.size());
  TRY(write_vectors(context, surface.position.span(), lengths, block + layout.positions,
                    &view.positions));
  TRY(write_vectors(context, surface.normal.span(), none, block + layout.normals, &view.normals));
  TRY(write_vectors(context, surface.constraint_normal.span(), none, block + layout.constraint,
                    &view.constraint_normals));
  TRY(write_curvatures(context, surface, layout, curvatures, block, &view));
  TRY(write_indices(surface.vertex_curve, block + layout.vertex_curve, &view.vertex_curve));
  TRY(write_indices(surface.triangle, block + layout.triangle, &view.triangles));
  TRY(write_indices(surface.patch, block + layout.patch, &view.triangle_patch));
  TRY(write_indices(surface.curve_edge, block + layout.edges, &view.curve_edges));
  TRY(write_indices(surface.curve_edge_curve, block + layout.edge_curve, &view.curve_edge_curve));
  if (SurfaceLayout::has_guard(surface)) {
    std::memcpy(block + layout.guarded, surface.patch_guarded.data(), surface.patch_guarded.size());
    view.patch_guarded = block + layout.guarded;
  }
  TRY(write_patch_list(surface, layout, block, &view));
  view.crease_corner_count = static_cast<uint32_t>(surface.crease_normals.corner.size());
  TRY(write_indices(surface.crease_normals.corner, block + layout.crease_corners,
                    &view.crease_corners));
  if (view.crease_corner_count > 0) {
    TRY(write_vectors(context, surface.crease_normals.normal.span(), none,
                      block + layout.crease_normals, &view.crease_normals));
  }
  return context.progress(1.0);
}

}  // namespace wireskin::api
