// The C boundary of surfaces: checks the caller's arrays, scales them, runs the pipeline, undoes
// the scaling and fills result and report. Only this file and those in api/ see both the public
// header and the inside.
#include "api/boundary.h"
#include "api/curves.h"
#include "base/in_parts.h"
#include "surface/from_triangles.h"

namespace wireskin::api {

static_assert(k_none == WSK_NONE && k_stage_count == WSK_STAGE_COUNT);
static_assert(static_cast<int>(Code::not_positive_definite) == WSK_ERROR_NOT_POSITIVE_DEFINITE);
static_assert(static_cast<int>(Code::open_network) == WSK_ERROR_OPEN_NETWORK);
static_assert(static_cast<int>(Stage::result) == WSK_STAGE_RESULT);
static_assert(static_cast<int>(smooth::Method::fair) == WSK_METHOD_FAIR);

struct MeshStorage {
  Array<Vec3> position, normal;
  Array<uint8_t> held;

  explicit MeshStorage(Context& context) : position(context), normal(context), held(context) {}
};

static Status read_mesh(const wsk_mesh& mesh, bool needs_normals, MeshStorage* storage) {
  if (mesh.vertex_count == 0 || mesh.triangle_count == 0) {
    return fail(Code::empty, "the mesh has no vertices or no triangles");
  }
  if (mesh.positions == nullptr || mesh.triangles == nullptr || mesh.constrained == nullptr) {
    return fail(Code::bad_argument, "the mesh lacks positions, triangles or constrained flags");
  }
  if (needs_normals && mesh.normals == nullptr) {
    return fail(Code::missing_normals, "the mesh has no normals and the method needs them");
  }
  if (mesh.vertex_count >= k_none / 2 || mesh.triangle_count >= k_none / 6) {
    return fail(Code::too_large, "the mesh is too large for 32-bit indices");
  }
  TRY(storage->position.resize(mesh.vertex_count));
  TRY(storage->held.resize(mesh.vertex_count));
  if (mesh.normals != nullptr) TRY(assign_in_parts(mesh.vertex_count, Vec3{}, &storage->normal));
  Pace pace(storage->held.context());
  for (size_t v = 0; v < mesh.vertex_count; ++v) {
    Place place;
    place.vertex = static_cast<uint32_t>(v);
    storage->held[v] = mesh.constrained[v] != 0;
    TRY(pace.after());
    TRY(read_position({mesh.positions, mesh.position_stride}, v, place, &storage->position[v]));
    if (mesh.normals != nullptr && storage->held[v]) {
      TRY(read_normal({mesh.normals, mesh.normal_stride}, v, place, &storage->normal[v]));
    }
  }
  return {};
}

static Status build(Context& context, const wsk_curve* curves, size_t count,
                    const wsk_options& options, wsk_report* report, wsk_surface** out) {
  CurveStorage storage(context);
  Surface surface(context);
  int exponent = 0;
  TRY(context.enter(Stage::input));
  TRY(read_curves(curves, count, &storage));
  TRY(find_scale(storage.position.span(), &exponent));
  const Scale scale(-exponent);
  for (Vec3& p : storage.position) p = scale(p);
  for (double& cutoff : storage.soft) {  // zero: as the options say; negative: not soft at all
    cutoff = cutoff < 0.0 ? 0.0 : scale(cutoff > 0.0 ? cutoff : options.soft);
  }
  const CurveSet set = {storage.start.span(),  storage.position.span(), storage.normal.span(),
                        storage.number.span(), storage.closed.span(),   storage.boundary.span(),
                        storage.soft.span(),   storage.sharp.span(),    storage.right.span()};
  const Settings settings = {static_cast<smooth::Method>(options.method), scale(options.spacing),
                             smoothing_of(options, scale), options.partial != 0,
                             options.find_borders != 0};
  if (settings.spacing == 0.0 && options.spacing > 0.0) {  // zero would mean the default
    return fail(Code::too_large, "the spacing is too small for the network");
  }
  const Status status = surface_curves(context, set, settings, &surface);
  report_counts(surface.counts, Scale(exponent), report);
  TRY(explain_rounding(status, storage.position.span(), surface.counts.spacing));
  return make_handle(context, surface, exponent, out);
}

static Status smooth_mesh(Context& context, const wsk_mesh& mesh, const wsk_options& options,
                          wsk_report* report, wsk_surface** out) {
  MeshStorage storage(context);
  Surface surface(context);
  int exponent = 0;
  TRY(context.enter(Stage::input));
  const bool needs_normals =
      options.method != WSK_METHOD_BIHARMONIC && options.method != WSK_METHOD_TRIHARMONIC;
  TRY(read_mesh(mesh, needs_normals, &storage));
  TRY(find_scale(storage.position.span(), &exponent));
  const Scale scale(-exponent);
  TRY(in_parts(context, storage.position.size(),
               [&](size_t v) { storage.position[v] = scale(storage.position[v]); }));
  const TriangleSet set = {storage.position.span(),
                           storage.normal.span(),
                           storage.held.span(),
                           {mesh.triangles, 3 * mesh.triangle_count},
                           scale(options.soft)};
  const Settings settings = {static_cast<smooth::Method>(options.method), 0.0, {}};
  const Status status = surface_triangles(context, set, settings, &surface);
  report_counts(surface.counts, Scale(exponent), report);
  TRY(status);
  return make_handle(context, surface, exponent, out);
}

}  // namespace wireskin::api

extern "C" {

const char* wsk_status_name(wsk_status status) {
  static const char* const names[] = {
      "ok",
      "bad_argument",
      "out_of_memory",
      "memory_cap",
      "cancelled",
      "too_large",
      "empty",
      "too_few_samples",
      "not_a_number",
      "infinite",
      "zero_length_curve",
      "duplicate_samples",
      "zero_normal",
      "missing_normals",
      "index_out_of_range",
      "node_mismatch",
      "open_network",
      "inconsistent_normals",
      "tangent_normal",
      "patch_without_plane",
      "patch_folded",
      "patch_several_loops",
      "bad_mesh",
      "unconstrained",
      "not_positive_definite",
  };
  const int32_t count = static_cast<int32_t>(sizeof names / sizeof names[0]);
  return status >= 0 && status < count ? names[status] : "unknown";
}

const char* wsk_stage_name(wsk_stage stage) {
  static const char* const names[] = {"input",     "curves", "network", "patches",
                                      "operators", "factor", "solve",   "result"};
  return stage >= 0 && stage < WSK_STAGE_COUNT ? names[stage] : "unknown";
}

const char* wsk_version_string(void) {
  return WIRESKIN_VERSION_STRING;
}

void wsk_options_init(wsk_options* options, size_t size) {
  if (options == nullptr || size < wireskin::api::k_options_size) return;
  wsk_options defaults;
  std::memset(&defaults, 0, sizeof defaults);
  defaults.method = WSK_METHOD_FAIR;
  wireskin::api::write_defaults(defaults, size, options);
}

void wsk_report_init(wsk_report* report, size_t size) {
  if (report == nullptr || size < wireskin::api::k_report_size) return;
  wsk_report defaults;
  std::memset(&defaults, 0, sizeof defaults);
  defaults.sentence = "";
  defaults.curve = defaults.sample = defaults.node = WSK_NONE;
  defaults.patch = defaults.vertex = defaults.triangle = WSK_NONE;
  defaults.first_ambiguous_patch = WSK_NONE;
  defaults.first_inverted_patch = WSK_NONE;
  defaults.first_coarse_patch = WSK_NONE;
  wireskin::api::write_defaults(defaults, size, report);
}

wsk_status wsk_build(const wsk_curve* curves, size_t curve_count, const wsk_options* options,
                     wsk_surface** surface, wsk_report* report) {
  using namespace wireskin;
  return api::run_call(
      {}, options, api::to_surface(surface), report,
      [&](Context& context, const wsk_options& checked, wsk_report* filled, wsk_surface** made) {
        return api::build(context, curves, curve_count, checked, filled, made);
      });
}

wsk_status wsk_smooth_mesh(const wsk_mesh* mesh, const wsk_options* options, wsk_surface** surface,
                           wsk_report* report) {
  using namespace wireskin;
  return api::run_call({}, options, api::to_surface(surface), report,
                       [&](Context& context, const wsk_options& checked, wsk_report* filled,
                           wsk_surface** made) -> Status {
                         if (mesh == nullptr) return fail(Code::bad_argument, "the mesh is null");
                         return api::smooth_mesh(context, *mesh, checked, filled, made);
                       });
}

void wsk_surface_get_view(const wsk_surface* surface, wsk_surface_view* view, size_t size) {
  wireskin::api::fill_view(surface, view, size);
}

void wsk_surface_free(wsk_surface* surface) {
  if (surface == nullptr) return;
  const wireskin::Allocator allocator = surface->allocator;
  allocator.release(surface, surface->bytes, allocator.user);
}

}  // extern "C"
