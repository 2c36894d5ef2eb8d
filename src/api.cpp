// The C boundary: checks the caller's arrays, scales them, runs the pipeline, undoes the scaling
// and fills result and report. Only this file and those in api/ see both the public header and the
// inside.
#include <cstdlib>

#include "api/boundary.h"

namespace wireskin::api {

static_assert(k_none == WSK_NONE && k_stage_count == WSK_STAGE_COUNT);
static_assert(static_cast<int>(Code::not_positive_definite) == WSK_ERROR_NOT_POSITIVE_DEFINITE);
static_assert(static_cast<int>(Code::open_network) == WSK_ERROR_OPEN_NETWORK);
static_assert(static_cast<int>(Stage::result) == WSK_STAGE_RESULT);
static_assert(static_cast<int>(smooth::Method::fair) == WSK_METHOD_FAIR);

// ---- Options and report -------------------------------------------------------------------------

static void* allocate_by_malloc(size_t bytes, void*) {
  return std::malloc(bytes);
}
static void release_by_free(void* memory, size_t, void*) {
  std::free(memory);
}

Status read_options(const wsk_options* given, wsk_options* options) {
  wsk_options_init(options, sizeof *options);
  if (given == nullptr) return {};
  if (given->size < k_options_size) {
    return fail(Code::bad_argument, "the options are not initialised: call wsk_options_init first");
  }
  std::memcpy(options, given, least(given->size, sizeof *options));
  if (options->method < 0 || options->method >= WSK_METHOD_COUNT) {
    return fail(Code::bad_argument, "the options name an unknown method");
  }
  if (!(options->spacing >= 0.0 && options->spacing - options->spacing == 0.0)) {
    return fail(Code::bad_argument, "the spacing is negative or not finite");
  }
  if (options->smoothing < 0 || options->smoothing >= WSK_SMOOTHING_COUNT) {
    return fail(Code::bad_argument, "the options name an unknown smoothing");
  }
  if (!(options->noise >= 0.0 && options->noise - options->noise == 0.0)) {
    return fail(Code::bad_argument, "the noise is negative or not finite");
  }
  if (!(options->soft >= 0.0 && options->soft - options->soft == 0.0)) {
    return fail(Code::bad_argument, "the cutoff length is negative or not finite");
  }
  if ((options->allocate == nullptr) != (options->release == nullptr)) {
    return fail(Code::bad_argument, "the options have an allocate or a release without the other");
  }
  return {};
}

Allocator allocator_of(const wsk_options& options) {
  if (options.allocate == nullptr) return {allocate_by_malloc, release_by_free, nullptr};
  return {options.allocate, options.release, options.allocator_user};
}

Callbacks callbacks_of(const wsk_options& options) {
  return {options.cancel, options.cancel_user, options.progress,     options.progress_user,
          options.now,    options.now_user,    options.parallel_for, options.parallel_for_user};
}

static void report_status(const Status& status, wsk_report* report) {
  report->status = static_cast<wsk_status>(status.code);
  report->sentence = status.sentence;
  report->curve = status.place.curve;
  report->sample = status.place.sample;
  report->node = status.place.node;
  report->patch = status.place.patch;
  report->vertex = status.place.vertex;
  report->triangle = status.place.triangle;
}

void report_counts(const Counts& counts, const Scale& unscale, wsk_report* report) {
  report->curves = counts.curves;
  report->nodes = counts.nodes;
  report->segments = counts.segments;
  report->patches = counts.patches;
  report->vertices = counts.vertices;
  report->free_vertices = counts.free_vertices;
  report->triangles = counts.triangles;
  report->components = counts.components;
  report->boundary_loops = counts.boundary_loops;
  report->euler_characteristic = counts.euler_characteristic;
  report->spacing = unscale(counts.spacing);
  report->min_angle_deg = counts.least_angle;
  report->residual = counts.residual;
  report->noise_position = unscale(counts.noise.sigma_position);
  report->noise_normal = counts.noise.sigma_normal;
  report->cg_iterations = counts.iterations;
  report->minimal_area_patches = counts.minimal_area_patches;
  report->guarded_patches = counts.guarded_patches;
  report->constraint_distance_max = unscale(counts.greatest_distance);
  report->constraint_distance_rms = unscale(std::sqrt(counts.mean_square_distance));
  report->normal_deviation_mean_deg = counts.normal_deviation.mean;
  report->normal_deviation_max_deg = counts.normal_deviation.greatest;
  report->dihedral_mean_deg = counts.dihedral.mean;
  report->dihedral_max_deg = counts.dihedral.greatest;
  report->failed_patches = counts.failed_patches;
  report->ambiguous_patches = counts.ambiguous_patches;
  report->first_ambiguous_patch = counts.first_ambiguous_patch;
}

void report_costs(Context& context, wsk_report* report) {
  context.stop_clock();
  report->stage = static_cast<wsk_stage>(context.stage());
  report->peak_bytes = context.peak_bytes();
  report->factorisations = context.factorisations();
  report->cg_iterations += context.iterations();
  report->solver = context.is_iterative() ? WSK_SOLVER_ITERATIVE : WSK_SOLVER_DIRECT;
  for (int s = 0; s < WSK_STAGE_COUNT; ++s) {
    report->stage_ms[s] = context.milliseconds(s);
    report->total_ms += report->stage_ms[s];
  }
}

// Copies the report out, as much of it as the caller's version has.
wsk_status finish(const Status& status, wsk_report* report, wsk_report* out) {
  report_status(status, report);
  if (out != nullptr) {
    const size_t size = out->size;
    if (size < k_report_size) return WSK_ERROR_BAD_ARGUMENT;
    std::memcpy(out, report, least(size, sizeof *report));
    out->size = size;
  }
  return report->status;
}

// ---- Input --------------------------------------------------------------------------------------

static bool has_nan(const Vec3& a) {
  return a.x != a.x || a.y != a.y || a.z != a.z;
}
static bool finite(const Vec3& a) {
  return a.x - a.x == 0.0 && a.y - a.y == 0.0 && a.z - a.z == 0.0;
}

double greatest_component(const Vec3& a) {
  const double x = std::fabs(a.x), y = std::fabs(a.y), z = std::fabs(a.z);
  const double xy = x > y ? x : y;
  return xy > z ? xy : z;
}

static Status check_finite(const Vec3& a, const char* not_a_number, const char* infinite,
                           const Place& place) {
  if (has_nan(a)) return fail(Code::not_a_number, not_a_number, place);
  if (!finite(a)) return fail(Code::infinite, infinite, place);
  return {};
}

// One position and normal, checked; the normal comes out unit whatever its length was.
Status read_position(const Rows& rows, size_t i, const Place& place, Vec3* position) {
  *position = rows[i];
  return check_finite(*position, "the position is not a number", "the position is infinite", place);
}

Status read_normal(const Rows& rows, size_t i, const Place& place, Vec3* normal) {
  const Vec3 given = rows[i];
  TRY(check_finite(given, "the normal is not a number", "the normal is infinite", place));
  const double greatest = greatest_component(given);
  if (greatest == 0.0) return fail(Code::zero_normal, "the normal has zero length", place);
  // Near one first, or the squares of very long and very short normals overflow and underflow.
  *normal = unit(Scale(-binary_exponent(greatest))(given));
  return {};
}

// The power of two that brings the extent of the points to one half up to one.
Status find_scale(Span<const Vec3> points, int* exponent) {
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y, p.z < low.z ? p.z : low.z};
    high = {p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y, p.z > high.z ? p.z : high.z};
  }
  const Vec3 extent = high - low;
  if (!finite(extent)) {
    return fail(Code::infinite, "the positions span more than a double can hold");
  }
  // Points that are all one place have no extent; how far out they lie serves as well.
  double greatest = greatest_component(extent);
  if (greatest == 0.0) greatest = greatest_component(points[0]);
  *exponent = greatest > 0.0 ? binary_exponent(greatest) : 0;
  return {};
}

struct CurveStorage {
  Array<uint32_t> start;
  Array<Vec3> position, normal;
  Array<uint32_t> number;
  Array<uint8_t> closed, boundary;
  Array<double> soft;
  Array<uint8_t> sharp;  // empty where no curve is
  Array<Vec3> right;

  explicit CurveStorage(Context& context)
      : start(context),
        position(context),
        normal(context),
        number(context),
        closed(context),
        boundary(context),
        soft(context),
        sharp(context),
        right(context) {}
};

static Status count_samples(const wsk_curve* curves, size_t count, size_t* total, bool* sharp) {
  *total = 0;
  *sharp = false;
  for (size_t c = 0; c < count; ++c) {
    Place place;
    place.curve = static_cast<uint32_t>(c);
    const wsk_curve& curve = curves[c];
    if (curve.sample_count == 0) {
      return fail(Code::too_few_samples, "the curve has no samples", place);
    }
    if (curve.sample_count >= k_none - *total) {
      return fail(Code::too_large, "too many samples for 32-bit indices", place);
    }
    if (curve.positions == nullptr) {
      return fail(Code::bad_argument, "the curve has no positions", place);
    }
    *sharp = *sharp || curve.sharp != 0;
    if (curve.normals == nullptr && curve.sharp == 0 && curve.sample_count != 1) {
      return fail(Code::missing_normals, "the curve has no normals", place);
    }
    if (curve.soft - curve.soft != 0.0) {
      return fail(Code::bad_argument, "the cutoff length of the curve is not finite", place);
    }
    *total += curve.sample_count;
  }
  return {};
}

// A normal of one side of a sharp curve; zero where the side has none.
static Status read_side_normal(const double* data, size_t stride, size_t i, const Place& place,
                               Vec3* normal) {
  *normal = Vec3{};
  return data == nullptr ? Status{} : read_normal({data, stride}, i, place, normal);
}

static Status read_curve(const wsk_curve& curve, uint32_t index, CurveStorage* storage) {
  const Rows positions = {curve.positions, curve.position_stride};
  for (size_t i = 0; i < curve.sample_count; ++i) {
    Place place;
    place.curve = index;
    place.sample = static_cast<uint32_t>(i);
    Vec3 position, normal;
    TRY(read_position(positions, i, place, &position));
    TRY(read_side_normal(curve.normals, curve.normal_stride, i, place, &normal));
    storage->position.push_reserved(position);
    storage->normal.push_reserved(normal);
    storage->number.push_reserved(curve.nodes == nullptr ? k_none : curve.nodes[i]);
    if (storage->sharp.empty()) continue;
    const double* right = curve.sharp != 0 ? curve.normals_right : nullptr;
    TRY(read_side_normal(right, curve.normal_right_stride, i, place, &normal));
    storage->right.push_reserved(normal);
  }
  storage->closed.push_reserved(curve.closed != 0);
  storage->boundary.push_reserved(curve.boundary != 0);
  storage->soft.push_reserved(curve.soft);
  storage->start.push_reserved(static_cast<uint32_t>(storage->position.size()));
  return {};
}

static Status read_curves(const wsk_curve* curves, size_t count, CurveStorage* storage) {
  size_t total = 0;
  if (count == 0) return fail(Code::empty, "there are no curves");
  if (curves == nullptr) return fail(Code::bad_argument, "the curves are null");
  if (count >= k_none) return fail(Code::too_large, "too many curves for 32-bit indices");
  bool sharp = false;
  TRY(count_samples(curves, count, &total, &sharp));
  TRY(storage->start.reserve(count + 1));
  TRY(storage->closed.reserve(count));
  TRY(storage->boundary.reserve(count));
  TRY(storage->soft.reserve(count));
  TRY(storage->position.reserve(total));
  TRY(storage->normal.reserve(total));
  TRY(storage->number.reserve(total));
  if (sharp) {
    TRY(storage->sharp.resize(count));
    TRY(storage->right.reserve(total));
    for (size_t c = 0; c < count; ++c) storage->sharp[c] = curves[c].sharp != 0;
  }
  storage->start.push_reserved(0);
  for (size_t c = 0; c < count; ++c) {
    TRY(read_curve(curves[c], static_cast<uint32_t>(c), storage));
  }
  return {};
}

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
  if (mesh.normals != nullptr) TRY(storage->normal.assign(mesh.vertex_count, Vec3{}));
  for (size_t v = 0; v < mesh.vertex_count; ++v) {
    Place place;
    place.vertex = static_cast<uint32_t>(v);
    storage->held[v] = mesh.constrained[v] != 0;
    TRY(read_position({mesh.positions, mesh.position_stride}, v, place, &storage->position[v]));
    if (mesh.normals != nullptr && storage->held[v]) {
      TRY(read_normal({mesh.normals, mesh.normal_stride}, v, place, &storage->normal[v]));
    }
  }
  return {};
}

// ---- Output -------------------------------------------------------------------------------------

static const uint32_t* write_indices(unsigned char* block, size_t offset,
                                     const Array<uint32_t>& values) {
  if (values.empty()) return nullptr;
  std::memcpy(block + offset, values.data(), values.size() * sizeof(uint32_t));
  return reinterpret_cast<const uint32_t*>(block + offset);
}

Status make_handle(Context& context, const Surface& surface, int exponent, wsk_surface** out) {
  const size_t n = surface.position.size(), triangles = surface.patch.size();
  Layout layout(sizeof(wsk_surface));
  const size_t positions = layout.add_array<double>(3 * n);
  const size_t normals = layout.add_array<double>(3 * n);
  const size_t curvature = layout.add_array<double>(n);
  const size_t gaussian = layout.add_array<double>(n);
  const size_t constraint = layout.add_array<double>(3 * n);
  const size_t vertex_curve = layout.add_array<uint32_t>(n);
  const size_t triangle = layout.add_array<uint32_t>(3 * triangles);
  const size_t patch = layout.add_array<uint32_t>(triangles);
  const size_t edges = layout.add_array<uint32_t>(surface.curve_edge.size());
  const size_t edge_curve = layout.add_array<uint32_t>(surface.curve_edge_curve.size());
  const bool has_guard = !surface.patch_guarded.empty() && !surface.curve_edge.empty();
  const size_t guarded = layout.add_array<uint8_t>(has_guard ? surface.patch_guarded.size() : 0);
  const size_t listed = surface.patches.status.size();
  const size_t sentences = layout.add_array<const char*>(listed);
  const size_t statuses = layout.add_array<wsk_status>(listed);
  const size_t ways = layout.add_array<uint8_t>(listed);
  const size_t patch_start = layout.add_array<uint32_t>(surface.patches.curve_start.size());
  const size_t patch_curve = layout.add_array<uint32_t>(surface.patches.curve.size());
  void* memory = nullptr;
  TRY(context.allocate(layout.bytes(), 1, &memory));
  unsigned char* block = static_cast<unsigned char*>(memory);
  const Scale none(0), lengths(exponent), curvatures(-exponent);
  wsk_surface* handle = static_cast<wsk_surface*>(memory);
  handle->allocator = context.allocator();
  handle->bytes = layout.bytes();
  wsk_surface_view& view = handle->view;
  view.size = sizeof view;
  view.vertex_count = static_cast<uint32_t>(n);
  view.triangle_count = static_cast<uint32_t>(triangles);
  view.patch_count = surface.counts.patches;
  view.curve_edge_count = static_cast<uint32_t>(surface.curve_edge_curve.size());
  view.positions = write_vectors(block, positions, surface.position.span(), lengths);
  view.normals = write_vectors(block, normals, surface.normal.span(), none);
  view.constraint_normals =
      write_vectors(block, constraint, surface.constraint_normal.span(), none);
  double* h = reinterpret_cast<double*>(block + curvature);
  for (size_t v = 0; v < n; ++v) h[v] = curvatures(surface.mean_curvature[v]);
  view.mean_curvature = h;
  double* k = reinterpret_cast<double*>(block + gaussian);
  for (size_t v = 0; v < n; ++v) k[v] = curvatures(curvatures(surface.gaussian_curvature[v]));
  view.gaussian_curvature = k;
  view.vertex_curve = write_indices(block, vertex_curve, surface.vertex_curve);
  view.triangles = write_indices(block, triangle, surface.triangle);
  view.triangle_patch = write_indices(block, patch, surface.patch);
  view.curve_edges = write_indices(block, edges, surface.curve_edge);
  view.curve_edge_curve = write_indices(block, edge_curve, surface.curve_edge_curve);
  view.patch_guarded = nullptr;
  if (has_guard) {
    std::memcpy(block + guarded, surface.patch_guarded.data(), surface.patch_guarded.size());
    view.patch_guarded = block + guarded;
  }
  const char** sentence = reinterpret_cast<const char**>(block + sentences);
  wsk_status* status = reinterpret_cast<wsk_status*>(block + statuses);
  for (size_t p = 0; p < listed; ++p) {
    sentence[p] = surface.patches.status[p].sentence;
    status[p] = static_cast<wsk_status>(surface.patches.status[p].code);
    block[ways + p] = surface.patches.way[p];
  }
  // Surfaces of meshes and of flows have patches that no list says more of.
  view.patch_sentence = listed > 0 ? sentence : nullptr;
  view.patch_status = listed > 0 ? status : nullptr;
  view.patch_way = listed > 0 ? block + ways : nullptr;
  view.patch_curve_start = write_indices(block, patch_start, surface.patches.curve_start);
  view.patch_curves = write_indices(block, patch_curve, surface.patches.curve);
  *out = handle;
  return context.progress(1.0);
}

// ---- The two tasks ------------------------------------------------------------------------------

// fair looks for noise unless told otherwise; the other methods take the samples as they are.
static network::SmoothingOptions smoothing_of(const wsk_options& options, const Scale& scale) {
  const bool automatic =
      options.smoothing == WSK_SMOOTHING_AUTO ||
      (options.smoothing == WSK_SMOOTHING_DEFAULT && options.method == WSK_METHOD_FAIR);
  if (automatic) return {network::Noise::estimate, 0.0};
  if (options.smoothing == WSK_SMOOTHING_GIVEN && options.noise > 0.0) {
    return {network::Noise::given, scale(options.noise)};
  }
  return {network::Noise::none, 0.0};
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
                             smoothing_of(options, scale), options.partial != 0};
  if (settings.spacing == 0.0 && options.spacing > 0.0) {  // zero would mean the default
    return fail(Code::too_large, "the spacing is too small for the network");
  }
  const Status status = surface_curves(context, set, settings, &surface);
  report_counts(surface.counts, Scale(exponent), report);
  TRY(status);
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
  for (Vec3& p : storage.position) p = scale(p);
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

// What both calls share: options, context, report; `task` does the work.
template <typename Task>
static wsk_status run(const wsk_options* given, wsk_surface** surface, wsk_report* out,
                      const Task& task) {
  wsk_report report;
  wsk_report_init(&report, sizeof report);
  if (out != nullptr && out->size < k_report_size) return WSK_ERROR_BAD_ARGUMENT;
  if (surface == nullptr) {
    return finish(fail(Code::bad_argument, "there is no place for the surface"), &report, out);
  }
  wsk_options options;
  const Status checked = read_options(given, &options);
  if (!checked.ok()) return finish(checked, &report, out);
  Context context(allocator_of(options), options.memory_cap, callbacks_of(options));
  wsk_surface* made = nullptr;
  Status status = task(context, options, &report, &made);
  if (!status.ok() && made != nullptr) {
    wsk_surface_free(made);  // cancelled at the very end
    made = nullptr;
  }
  report_costs(context, &report);
  if (status.ok()) *surface = made;
  return finish(status, &report, out);
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
  std::memset(options, 0, size);
  defaults.size = size;
  defaults.method = WSK_METHOD_FAIR;
  std::memcpy(options, &defaults, wireskin::api::least(size, sizeof defaults));
}

void wsk_report_init(wsk_report* report, size_t size) {
  if (report == nullptr || size < wireskin::api::k_report_size) return;
  wsk_report defaults;
  std::memset(&defaults, 0, sizeof defaults);
  std::memset(report, 0, size);
  defaults.size = size;
  defaults.sentence = "";
  defaults.curve = defaults.sample = defaults.node = WSK_NONE;
  defaults.patch = defaults.vertex = defaults.triangle = WSK_NONE;
  defaults.first_ambiguous_patch = WSK_NONE;
  std::memcpy(report, &defaults, wireskin::api::least(size, sizeof defaults));
}

wsk_status wsk_build(const wsk_curve* curves, size_t curve_count, const wsk_options* options,
                     wsk_surface** surface, wsk_report* report) {
  return wireskin::api::run(options, surface, report,
                            [&](wireskin::Context& context, const wsk_options& checked,
                                wsk_report* filled, wsk_surface** made) {
                              return wireskin::api::build(context, curves, curve_count, checked,
                                                          filled, made);
                            });
}

wsk_status wsk_smooth_mesh(const wsk_mesh* mesh, const wsk_options* options, wsk_surface** surface,
                           wsk_report* report) {
  return wireskin::api::run(
      options, surface, report,
      [&](wireskin::Context& context, const wsk_options& checked, wsk_report* filled,
          wsk_surface** made) -> wireskin::Status {
        if (mesh == nullptr) {
          return wireskin::fail(wireskin::Code::bad_argument, "the mesh is null");
        }
        return wireskin::api::smooth_mesh(context, *mesh, checked, filled, made);
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
