// The C boundary of surfaces from curves alone: keeps the complex behind a handle, makes surfaces
// of it, and lists voids, patches and loops.
#include <new>

#include "api/boundary.h"
#include "base/in_parts.h"
#include "flow/critical.h"
#include "surface/flow_noise.h"
#include "surface/from_flow.h"

namespace wireskin::api {

// What the view of a flow points to.
struct FlowTables {
  Array<wsk_void> voids;
  Array<wsk_flow_patch> patches;
  Array<uint32_t> loop_first;
  Array<wsk_flow_run> runs;
  Array<uint32_t> arc_first, arc_vertices, bare_vertices;

  explicit FlowTables(Context& context)
      : voids(context),
        patches(context),
        loop_first(context),
        runs(context),
        arc_first(context),
        arc_vertices(context),
        bare_vertices(context) {}
};

}  // namespace wireskin::api

// The context comes first: the arrays behind it give their memory back through it.
struct wsk_flow {
  wireskin::Context context;
  wireskin::flow::Flow flow;
  wireskin::Array<wireskin::Vec3> given;   // the caller's samples before noise was taken out
  wireskin::Array<wireskin::Vec3> normal;  // of the caller's samples, or empty
  wireskin::network::SmoothingReport noise;
  uint32_t bare_curves = 0;  // without normals, where others have some
  wireskin::api::FlowTables tables;
  int exponent = 0;
  wsk_flow_view view = {};

  wsk_flow(const wireskin::Allocator& allocator, size_t cap, const wireskin::Callbacks& callbacks)
      : context(allocator, cap, callbacks),
        flow(context),
        given(context),
        normal(context),
        tables(context) {}
};

namespace wireskin::api {

static constexpr size_t k_flow_options_size = offsetof(wsk_flow_options, raw) + sizeof(int32_t);

static Status read_flow_options(const wsk_flow_options* given, wsk_flow_options* options) {
  wsk_flow_options_init(options, sizeof *options);
  TRY(read_struct(given, k_flow_options_size,
                  "the flow options are not initialised: call wsk_flow_options_init first",
                  options));
  if (!finite_and_not_negative(options->sampling)) {
    return fail(Code::bad_argument, "the sampling is negative or not finite");
  }
  if (!(options->jitter >= 0.0 && options->jitter <= 1e-3)) {
    return fail(Code::bad_argument, "the jitter is not between 0 and 0.001");
  }
  if (!finite_and_not_negative(options->thickness)) {
    return fail(Code::bad_argument, "the thickness is negative or not finite");
  }
  if (options->lids < 0 || options->lids >= WSK_LIDS_COUNT) {
    return fail(Code::bad_argument, "the lids are none of WSK_LIDS_...");
  }
  return {};
}

// ---- Building -----------------------------------------------------------------------------------

namespace {

struct FlowInput {
  Array<uint32_t> start, number;
  Array<Vec3> position;
  Array<uint8_t> closed;

  explicit FlowInput(Context& context)
      : start(context), number(context), position(context), closed(context) {}
};

}  // namespace

// `bare`: curves that have no normals, points aside; all of them counts as none of them.
static Status count_flow_samples(const wsk_curve* curves, size_t count, size_t* total,
                                 uint32_t* bare) {
  uint32_t lines = 0;
  *total = 0;
  *bare = 0;
  for (size_t c = 0; c < count; ++c) {
    Place place;
    place.curve = static_cast<uint32_t>(c);
    if (curves[c].sample_count == 0) {
      return fail(Code::too_few_samples, "the curve has no samples", place);
    }
    if (curves[c].sample_count >= k_none / 4 - *total) {
      return fail(Code::too_large, "too many samples for 32-bit indices", place);
    }
    if (curves[c].positions == nullptr) {
      return fail(Code::bad_argument, "the curve has no positions", place);
    }
    if (curves[c].soft > 0.0) {
      return fail(Code::bad_argument, "a surface from curves alone cannot have soft curves", place);
    }
    *total += curves[c].sample_count;
    if (curves[c].sample_count == 1) continue;
    ++lines;
    *bare += curves[c].normals == nullptr || curves[c].sharp != 0;
  }
  if (*bare == lines) *bare = k_none;
  return {};
}

static Status read_flow_curves(const wsk_curve* curves, size_t count, FlowInput* input,
                               Array<Vec3>* normal, uint32_t* bare) {
  size_t total = 0;
  if (count == 0) return fail(Code::empty, "there are no curves");
  if (curves == nullptr) return fail(Code::bad_argument, "the curves are null");
  if (count >= k_none / 4) return fail(Code::too_large, "too many curves for 32-bit indices");
  TRY(count_flow_samples(curves, count, &total, bare));
  const bool normals = *bare == 0;
  TRY(input->start.reserve(count + 1));
  TRY(input->closed.reserve(count));
  TRY(input->position.reserve(total));
  TRY(input->number.reserve(total));
  if (normals) TRY(normal->reserve(total));
  input->start.push_reserved(0);
  Pace pace(input->position.context());
  for (size_t c = 0; c < count; ++c) {
    const wsk_curve& curve = curves[c];
    for (size_t i = 0; i < curve.sample_count; ++i) {
      TRY(pace.after());
      Place place;
      place.curve = static_cast<uint32_t>(c);
      place.sample = static_cast<uint32_t>(i);
      Vec3 value;
      TRY(read_position({curve.positions, curve.position_stride}, i, place, &value));
      input->position.push_reserved(value);
      input->number.push_reserved(curve.nodes == nullptr ? k_none : curve.nodes[i]);
      if (!normals) continue;
      value = {};
      if (curve.normals != nullptr) {
        TRY(read_normal({curve.normals, curve.normal_stride}, i, place, &value));
      }
      normal->push_reserved(value);
    }
    input->closed.push_reserved(curve.closed != 0);
    input->start.push_reserved(static_cast<uint32_t>(input->position.size()));
  }
  return {};
}

// Without noise the samples keep their bits, so looking for it is no risk.
static network::SmoothingOptions flow_smoothing_of(const wsk_options& options, const Scale& scale) {
  const bool given = options.smoothing == WSK_SMOOTHING_GIVEN;
  if (options.smoothing == WSK_SMOOTHING_NONE || (given && options.noise == 0.0)) {
    return {network::Noise::none, 0.0};
  }
  if (given) return {network::Noise::given, scale(options.noise)};
  return {network::Noise::estimate, 0.0};
}

static Status list_voids(const flow::Persistence& persistence, const Scale& unscale,
                         Array<wsk_void>* voids) {
  TRY(voids->reserve(persistence.voids.size()));
  for (const flow::Void& v : persistence.voids) {
    voids->push_reserved({unscale(v.creation), unscale(v.filling), v.ratio, 0});
  }
  return {};
}

static Status fill_flow(const wsk_curve* curves, size_t count, const wsk_options& options,
                        const wsk_flow_options& flow_options, wsk_flow* made) {
  Context& context = made->context;
  FlowInput input(context);
  TRY(context.enter(Stage::input));
  TRY(read_flow_curves(curves, count, &input, &made->normal, &made->bare_curves));
  TRY(find_scale(input.position.span(), &made->exponent));
  const Scale scale(-made->exponent);
  TRY(in_parts(context, input.position.size(),
               [&](size_t i) { input.position[i] = scale(input.position[i]); }));
  flow::FlowOptions inside;
  inside.sampling = scale(flow_options.sampling);
  inside.spacing = scale(options.spacing);
  if ((inside.sampling == 0.0 && flow_options.sampling > 0.0) ||
      (inside.spacing == 0.0 && options.spacing > 0.0)) {
    return fail(Code::too_large, "the spacing is too small for the network");
  }
  if (flow_options.jitter > 0.0) inside.complex.jitter = flow_options.jitter;
  if (flow_options.most_tetrahedra > 0) inside.complex.most_tets = flow_options.most_tetrahedra;
  inside.complex.seed = flow_options.seed;
  inside.bend = !made->normal.empty();
  inside.lids = static_cast<flow::Lids>(flow_options.lids);
  const flow::Polylines polylines = {input.start.span(), input.position.span(), input.number.span(),
                                     input.closed.span()};
  TRY(copy_in_parts(input.position.span(), &made->given));
  TRY(context.enter(Stage::curves));
  TRY(smooth_polylines(context, polylines, flow_smoothing_of(options, scale), input.position.span(),
                       made->normal.span(), &made->noise));
  inside.noise = made->noise.sigma_position;
  const Status status = flow::build_flow(context, polylines, inside, &made->flow);
  TRY(explain_rounding(status, made->given.span(), made->flow.step));
  TRY(list_voids(made->flow.persistence, Scale(made->exponent), &made->tables.voids));
  wsk_flow_view& view = made->view;
  view.sample_count = static_cast<uint32_t>(made->flow.samples.position.size());
  view.tetrahedron_count = made->flow.complex.tet_count();
  view.split_count = made->flow.samples.splits;
  view.crowded_count = made->flow.samples.too_short;
  view.missing_count = made->flow.curves.missing;
  view.void_count = static_cast<uint32_t>(made->tables.voids.size());
  view.voids = made->tables.voids.data();
  view.normals_sentence = "";
  view.sampling = Scale(made->exponent)(made->flow.step);
  view.faces_skipped = made->flow.cells.given_up;
  flow::CriticalPoints critical(context);
  TRY(flow::find_critical_points(made->flow.complex, &critical));
  view.critical_count[0] = critical.points;
  view.critical_count[1] = static_cast<uint32_t>(critical.edge.size());
  view.critical_count[2] = static_cast<uint32_t>(critical.triangle.size());
  view.critical_count[3] = static_cast<uint32_t>(critical.tet.size());
  return context.progress(1.0);
}

// ---- Surfaces -----------------------------------------------------------------------------------

static Status list_patches(const flow::Patches& patches, const flow::Samples& samples,
                           Span<const uint32_t> vertex_of, const Scale& unscale,
                           FlowTables* tables) {
  TRY(tables->patches.reserve(patches.size()));
  TRY(tables->runs.reserve(patches.run.size()));
  TRY(tables->loop_first.copy(patches.run_start.span()));
  for (uint32_t p = 0; p < patches.size(); ++p) {
    const flow::PatchFacts& facts = patches.facts[p];
    wsk_flow_patch patch = {};
    patch.first_loop = patches.loop_start[p];
    patch.loop_count = facts.loops;
    patch.euler_characteristic = facts.euler_characteristic;
    patch.open = facts.open;
    patch.front = facts.front;
    patch.back = facts.back;
    patch.area = unscale(unscale(facts.area));
    patch.radius = unscale(facts.greatest);
    tables->patches.push_reserved(patch);
  }
  for (const flow::LoopRun& r : patches.run) {
    if (r.arc == k_none) {
      tables->runs.push_reserved({WSK_NONE, vertex_of[r.from], vertex_of[r.to]});
    } else {
      const uint32_t first = samples.start[r.arc];
      tables->runs.push_reserved({r.arc, r.from - first, r.to - first});
    }
  }
  return {};
}

static Status list_arcs(const flow::Samples& samples, Span<const uint32_t> bare,
                        Span<const uint32_t> vertex_of, FlowTables* tables) {
  TRY(tables->arc_first.copy(samples.start.span()));
  TRY(tables->arc_vertices.reserve(samples.at.size()));
  for (const uint32_t s : samples.at) tables->arc_vertices.push_reserved(vertex_of[s]);
  TRY(tables->bare_vertices.reserve(2 * bare.size()));
  for (const uint32_t i : bare) {
    tables->bare_vertices.push_reserved(vertex_of[samples.at[i]]);
    tables->bare_vertices.push_reserved(vertex_of[samples.at[i + 1]]);
  }
  return {};
}

static const char* normals_sentence(NormalsUse use) {
  switch (use) {
    case NormalsUse::none:
    case NormalsUse::used:
      return "";
    case NormalsUse::incomplete:
      return "some curves have no normals, or are sharp";
    case NormalsUse::not_manifold:
      return "the surface is no manifold with two sides: patches branch, touch in points or cannot "
             "be turned alike";
    case NormalsUse::free_border:
      return "part of the surface's border is no curve";
    case NormalsUse::contradicting:
      return "normals contradict each other or the surface";
    case NormalsUse::crossing:
      return "the surface they give would cross itself";
    case NormalsUse::too_thin:
      return "triangles are too thin to be smoothed";
  }
  return "";
}

static void fill_flow_view(const flow::Reconstruction& reconstruction, const FlowOutcome& outcome,
                           const FlowTables& tables, wsk_flow_view* view) {
  for (int k = 0; k < 3; ++k) view->betti[k] = reconstruction.betti[k];
  view->voids = tables.voids.data();
  view->patch_count = reconstruction.patches.size();
  view->open_patch_count = reconstruction.open_patches;
  view->bare_count = static_cast<uint32_t>(reconstruction.bare.size());
  view->branch_count = reconstruction.crowded_edges;
  view->held_count = outcome.held_back;
  view->crossing_count = outcome.crossings;
  view->manifold = outcome.manifold;
  view->smoothed = outcome.normals == NormalsUse::used;
  view->normals = static_cast<wsk_flow_normals>(outcome.normals);
  view->normals_places = outcome.normals_places;
  view->normals_sentence = normals_sentence(outcome.normals);
  view->caged_count = static_cast<uint32_t>(reconstruction.topology.chosen.size());
  view->open_lid_count = reconstruction.open_lids;
  view->untried_count = reconstruction.topology.untried;
  view->patches = tables.patches.data();
  view->loop_count = static_cast<uint32_t>(tables.loop_first.size() - 1);
  view->loop_first = tables.loop_first.data();
  view->runs = tables.runs.data();
  view->arc_count = static_cast<uint32_t>(tables.arc_first.size() - 1);
  view->arc_first = tables.arc_first.data();
  view->arc_vertices = tables.arc_vertices.data();
  view->bare_vertices = tables.bare_vertices.data();
}

// Everything that the handle will show is made before any of it changes.
static Status make_flow_surface(Context& context, const wsk_options& options,
                                const wsk_flow_options& flow_options, wsk_flow* flow,
                                wsk_report* report, wsk_surface** out) {
  const Scale scale(-flow->exponent), unscale(flow->exponent);
  flow::Reconstruction reconstruction(context);
  Surface surface(context);
  FlowOutcome outcome(context);
  FlowTables tables(flow->context);
  flow::ReconstructionOptions inside;
  inside.topology.voids = flow_options.voids < 0 ? flow::k_automatic_voids : flow_options.voids;
  inside.topology.open_walls = flow_options.open_walls != 0;
  inside.thicken.reach = flow_options.thickness;
  FlowSettings settings;
  settings.method = static_cast<smooth::Method>(options.method);
  settings.normal = flow->normal.span();
  settings.given = flow->given.span();
  settings.bare_curves = flow->bare_curves;
  if (flow_options.raw == 0) {
    settings.spacing = options.spacing > 0.0 ? scale(options.spacing) : flow->flow.step;
    if (options.spacing > 0.0 && settings.spacing == 0.0) {
      return fail(Code::too_large, "the spacing is too small for the network");
    }
  }
  TRY(flow::reconstruct(context, flow->flow, inside, &reconstruction));
  const Status status =
      surface_from_flow(context, flow->flow, reconstruction, settings, &surface, &outcome);
  surface.counts.noise = flow->noise;
  report_counts(surface.counts, unscale, report);
  TRY(explain_rounding(status, flow->given.span(), settings.spacing));
  TRY(tables.voids.copy(flow->tables.voids.span()));
  for (wsk_void& v : tables.voids) v.chosen = 0;
  for (const uint32_t v : reconstruction.topology.chosen) tables.voids[v].chosen = 1;
  TRY(list_patches(reconstruction.patches, flow->flow.samples, outcome.vertex_of.span(), unscale,
                   &tables));
  TRY(list_arcs(flow->flow.samples, reconstruction.bare.span(), outcome.vertex_of.span(), &tables));
  TRY(make_handle(context, surface, flow->exponent, out));
  flow->tables = static_cast<FlowTables&&>(tables);
  fill_flow_view(reconstruction, outcome, flow->tables, &flow->view);
  return {};
}

static void destroy_flow(wsk_flow* flow) {
  const Allocator allocator = flow->context.allocator();
  flow->~wsk_flow();
  allocator.release(flow, sizeof *flow, allocator.user);
}

// The context in which all is done stays in the handle.
static Status start_flow(const wsk_options& options, wsk_flow** out) {
  const Allocator allocator = allocator_of(options);
  const Callbacks callbacks = callbacks_of(options);
  Context context(allocator, options.memory_cap, callbacks);
  void* memory = nullptr;
  TRY(context.allocate(1, sizeof(wsk_flow), &memory));
  *out = new (memory) wsk_flow(allocator, options.memory_cap, callbacks);
  return {};
}

static void report_flow(wsk_flow* made, size_t curves, wsk_report* report) {
  report->curves = static_cast<uint32_t>(curves);
  report->segments = made->flow.arcs.size();
  for (const uint8_t node : made->flow.arcs.is_node) report->nodes += node;
  report->noise_position = Scale(made->exponent)(made->noise.sigma_position);
  report->noise_normal = made->noise.sigma_normal;
  report_costs(made->context, report);
}

// What both calls read; a surface from curves alone holds on to all of them.
static Status read_both_options(const wsk_options* options, const wsk_flow_options* flow_options,
                                wsk_options* checked, wsk_flow_options* flow_checked) {
  TRY(read_options(options, checked));
  if (checked->soft > 0.0) {
    return fail(Code::bad_argument, "soft is not for surfaces from curves alone");
  }
  return read_flow_options(flow_options, flow_checked);
}

}  // namespace wireskin::api

extern "C" {

void wsk_flow_options_init(wsk_flow_options* options, size_t size) {
  if (options == nullptr || size < wireskin::api::k_flow_options_size) return;
  wsk_flow_options defaults;
  std::memset(&defaults, 0, sizeof defaults);
  defaults.voids = WSK_VOIDS_AUTO;
  defaults.thickness = 1.2;
  wireskin::api::write_defaults(defaults, size, options);
}

wsk_status wsk_flow_build(const wsk_curve* curves, size_t curve_count, const wsk_options* options,
                          const wsk_flow_options* flow_options, wsk_flow** flow, wsk_report* out) {
  using namespace wireskin;
  wsk_report report;
  wsk_options checked;
  wsk_flow_options flow_checked;
  wsk_report_init(&report, sizeof report);
  if (out != nullptr && out->size < api::k_report_size) return WSK_ERROR_BAD_ARGUMENT;
  if (flow == nullptr) {
    return api::finish(fail(Code::bad_argument, "there is no place for the flow"), &report, out);
  }
  Status status = api::read_both_options(options, flow_options, &checked, &flow_checked);
  if (!status.ok()) return api::finish(status, &report, out);
  wsk_flow* made = nullptr;
  status = api::start_flow(checked, &made);
  if (!status.ok()) return api::finish(status, &report, out);
  status = api::fill_flow(curves, curve_count, checked, flow_checked, made);
  api::report_flow(made, curve_count, &report);
  if (status.ok()) {
    made->context.forget_callbacks();
    *flow = made;
  } else {
    api::destroy_flow(made);
  }
  return api::finish(status, &report, out);
}

wsk_status wsk_flow_surface(wsk_flow* flow, const wsk_options* options,
                            const wsk_flow_options* flow_options, wsk_surface** surface,
                            wsk_report* report) {
  using namespace wireskin;
  wsk_options checked;
  wsk_flow_options flow_checked;
  Status status;
  if (flow == nullptr) status = fail(Code::bad_argument, "the flow is null");
  if (status.ok()) {
    status = api::read_both_options(options, flow_options, &checked, &flow_checked);
  }
  return api::run_call(
      status, status.ok() ? &checked : nullptr, api::to_surface(surface), report,
      [&](Context& context, const wsk_options& read, wsk_report* filled, wsk_surface** made) {
        return api::make_flow_surface(context, read, flow_checked, flow, filled, made);
      });
}

void wsk_flow_get_view(const wsk_flow* flow, wsk_flow_view* view, size_t size) {
  wireskin::api::fill_view(flow, view, size);
}

void wsk_flow_free(wsk_flow* flow) {
  if (flow != nullptr) wireskin::api::destroy_flow(flow);
}

}  // extern "C"
