#include "smooth/smooth.h"

#include "base/in_parts.h"
#include "mesh/curvature.h"

namespace wireskin::smooth {

// How much a held vertex's row weighs against a free one's in the clamped method: the constraint is
// a penalty, as in "smoothing with the Laplacian prescribed on the curves".
static constexpr double k_clamp_penalty = 1e5;

// Adds to each border vertex its outer conormal, integrated over half of each of its border edges.
static Status add_conormals(Context& context, const Domain& domain, const Field& field,
                            Span<Vec3> conormal) {
  Array<uint32_t> twins(context);
  const uint32_t n = static_cast<uint32_t>(field.position.size());
  TRY(mesh::find_twins(n, domain.triangle, &twins));
  return in_parts(context, twins.size(), [&](size_t h) {
    if (twins[h] != k_none) return;
    const uint32_t next = mesh::next_half_edge(static_cast<uint32_t>(h));
    const uint32_t a = domain.triangle[h], b = domain.triangle[next];
    const Vec3 edge = field.position[b] - field.position[a];
    const Vec3 half = 0.5 * cross(edge, unit(field.normal[a] + field.normal[b]));
    conormal[a] += half;
    conormal[b] += half;
  });
}

// The inverse mixed Voronoi areas; zero for rows that are left out.
static Status row_weights(Context& context, const Domain& domain, bool border_rows,
                          Span<const double> area, Span<double> weight) {
  return in_parts(context, weight.size(), [&](size_t v) {
    const bool bare = !domain.bare.empty() && domain.bare[v];
    weight[v] = bare || (domain.on_border[v] && !border_rows) ? 0.0 : 1.0 / area[v];
  });
}

namespace {

// The steps of the methods that use normals share these.
struct Guided {
  System system;
  Array<double> area, weight, curvature;
  Array<Vec3> conormal, target;

  explicit Guided(Context& context)
      : system(context),
        area(context),
        weight(context),
        curvature(context),
        conormal(context),
        target(context) {}
};

}  // namespace

// The penalties of soft vertices, for positions or for normals.
static Status penalties(const Domain& domain, int order, bool normals, Array<double>* penalty) {
  const Soft& soft = domain.soft;
  TRY(assign_in_parts(soft.cutoff.size(), 0.0, penalty));
  return in_parts(penalty->context(), penalty->size(), [&](size_t v) {
    if (soft.cutoff[v] == 0.0) return;
    const double cutoff = normals ? soft.normal_cutoff(v) : soft.cutoff[v];
    (*penalty)[v] = spring(soft.share[v], cutoff, order);
  });
}

// Bare vertices take the normal that the surface has there by itself: the current one in space, the
// biharmonic one over the planes.
static Status estimate_bare_normals(Context& context, const Domain& domain, const Field& field,
                                    Guided* guided, double* residual) {
  Array<Vec3> normal(context);
  Array<double> penalty(context);
  TRY(normal.resize(field.normal.size()));
  if (domain.metric == Metric::planes) {
    TRY(penalties(domain, 2, false, &penalty));
    TRY(guided->system.factor(guided->weight.span(), penalty.span()));
    TRY(guided->system.solve({}, domain.soft.position, field.position, residual));
  }
  TRY(mesh::vertex_normals(context, field.position, domain.triangle, normal.span()));
  return in_parts(context, normal.size(), [&](size_t v) {
    if (domain.bare[v]) field.normal[v] = normal[v];
  });
}

static Status make_unit(Context& context, const Domain& domain, const Field& field) {
  return in_parts(context, domain.held.size(), [&](size_t v) {
    if (!domain.held[v]) field.normal[v] = unit(field.normal[v]);
  });
}

// Open borders: in the planes of the patches the Laplacian of a border vertex means nothing, its
// row is left out, and there is nothing to aim at. In space it is known up to the outer conormal c
// of the border (L v + c = -2 h m n), so the row stays, with c taken from the positions and normals
// given on the border; where none is given there is no c, and the row is left out.
static Status aim_at_conormals(Context& context, const Domain& domain, const Field& field,
                               Guided* guided) {
  if (domain.metric == Metric::planes) return {};
  const size_t n = field.position.size();
  TRY(assign_in_parts(n, Vec3{}, &guided->conormal));
  TRY(guided->target.resize(n));
  TRY(add_conormals(context, domain, field, guided->conormal.span()));
  return in_parts(context, n, [&](size_t v) { guided->target[v] = -guided->conormal[v]; });
}

// Normals and positions spread from the curves: N* (unit) and V*. Without soft vertices one factor
// and one sweep serve both; soft ones pull normals and positions by springs of their own.
static Status propagate(Context& context, const Domain& domain, Method method, const Field& field,
                        Guided* guided, double* residual) {
  Array<double> penalty(context);
  if (!domain.bare.empty()) {
    TRY(estimate_bare_normals(context, domain, field, guided, residual));
  }
  TRY(penalties(domain, 2, true, &penalty));
  const bool last = !domain.soft.any() && method == Method::stanko;
  TRY(guided->system.factor(guided->weight.span(), penalty.span(), last));
  const Field3 normals = {{}, domain.soft.normal, field.normal};
  if (!domain.soft.any()) {  // the normals along borders are known
    TRY(aim_at_conormals(context, domain, field, guided));
    const Field3 both[] = {normals, {guided->target.span(), {}, field.position}};
    TRY(guided->system.solve({both, 2}, residual));
    return make_unit(context, domain, field);
  }
  TRY(guided->system.solve({&normals, 1}, residual));
  TRY(make_unit(context, domain, field));
  TRY(aim_at_conormals(context, domain, field, guided));
  TRY(penalties(domain, 2, false, &penalty));
  TRY(guided->system.factor(guided->weight.span(), penalty.span()));
  return guided->system.solve(guided->target.span(), domain.soft.position, field.position,
                              residual);
}

// The final fit: Laplacians of the propagated curvature as targets, everywhere (the paper's method)
// or on the held vertices alone (the clamped one).
static Status fit(Context& context, const Domain& domain, Method method, const Field& field,
                  Guided* guided, double* residual) {
  const bool clamped = method == Method::clamped;
  const bool has_conormals = !guided->conormal.empty();
  TRY(guided->target.resize(field.position.size()));
  TRY(in_parts(context, field.position.size(), [&](size_t v) {
    const bool guides = !clamped || domain.on_curve[v];
    const double scale = guides ? -2.0 * guided->area[v] * guided->curvature[v] : 0.0;
    guided->target[v] = scale * field.normal[v];
    if (has_conormals) guided->target[v] -= guided->conormal[v];
    if (clamped && domain.on_curve[v]) guided->weight[v] *= k_clamp_penalty;
  }));
  if (clamped) {
    Array<double> penalty(context);
    TRY(penalties(domain, 2, false, &penalty));
    TRY(guided->system.factor(guided->weight.span(), penalty.span()));
  }
  return guided->system.solve(guided->target.span(), domain.soft.position, field.position,
                              residual);
}

Status smooth(Context& context, const Domain& domain, Method method, const Field& field,
              double* residual) {
  TRY(context.enter(Stage::operators));
  const uint32_t n = static_cast<uint32_t>(field.position.size());
  const bool uses_normals = method == Method::stanko || method == Method::clamped;
  sparse::Csc laplacian(context);
  Guided guided(context);
  TRY(mesh::cotangent_laplacian(n, domain.triangle, domain.shape, &laplacian));
  TRY(guided.area.resize(n));
  TRY(guided.weight.resize(n));
  TRY(mesh::mixed_voronoi_areas(context, domain.triangle, domain.shape, guided.area.span()));
  if (domain.spent != nullptr) domain.spent->free();
  TRY(row_weights(context, domain, uses_normals && domain.metric == Metric::space,
                  guided.area.span(), guided.weight.span()));
  const Order order = method == Method::triharmonic ? Order::three : Order::two;
  TRY(guided.system.prepare(laplacian, domain.held, order, domain.places));
  if (!uses_normals) {
    Array<double> penalty(context);
    TRY(penalties(domain, static_cast<int>(order), false, &penalty));
    TRY(guided.system.factor(guided.weight.span(), penalty.span(), true));
    return guided.system.solve({}, domain.soft.position, field.position, residual);
  }
  TRY(propagate(context, domain, method, field, &guided, residual));
  TRY(context.enter(Stage::operators));
  TRY(mesh::mean_curvature(field.position, field.normal, domain.triangle, domain.on_border,
                           &guided.curvature));
  return fit(context, domain, method, field, &guided, residual);
}

}  // namespace wireskin::smooth
