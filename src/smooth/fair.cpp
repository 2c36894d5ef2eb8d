#include "smooth/fair.h"

#include "base/in_parts.h"
#include "mesh/care.h"
#include "mesh/curvature.h"
#include "smooth/displace.h"
#include "smooth/node_curvature.h"
#include "smooth/system.h"

namespace wireskin::smooth {

// A patch is given up when a vertex moves by more than this share of its size, or by more than the
// second share and half as much again as in the step before.
static constexpr double k_greatest_step = 0.25;
static constexpr double k_growing_step = 0.1;
static constexpr double k_growth = 1.5;
// Steps smaller than this share of every patch change nothing that one could see or measure.
static constexpr double k_small_step = 1e-4;

namespace {

// What the guard remembers.
struct Guard {
  Array<Vec3> position;  // after the last paper step
  Array<uint32_t> triangle;
  Array<double> area;     // of each patch
  Array<double> step;     // of each patch, last time; -1 before the first
  Array<uint8_t> frozen;  // patch
  Array<uint8_t> still;   // vertex: not to be moved any more
  Array<uint8_t> kept;    // vertex: not to be relaxed, on a curve or still

  explicit Guard(Context& context)
      : position(context),
        triangle(context),
        area(context),
        step(context),
        frozen(context),
        still(context),
        kept(context) {}
};

// Of each patch, the last state without folds, if there was one.
struct Unfolded {
  Array<Vec3> position;
  Array<uint32_t> triangle;
  Array<uint32_t> folds;  // of each patch, now
  Array<uint8_t> known;   // patch

  explicit Unfolded(Context& context)
      : position(context), triangle(context), folds(context), known(context) {}
};

// The mean curvature on held curves, as far as it is known, and its weight.
struct Foretold {
  Array<double> curvature, weight;

  explicit Foretold(Context& context) : curvature(context), weight(context) {}
};

}  // namespace

static Span<const uint8_t> kept_vertices(const FairMesh& mesh, const Guard& guard) {
  return guard.kept.empty() ? mesh.on_curve : guard.kept.span();
}

static void hold_back(const FairMesh& mesh, uint32_t patch, FairReport* report) {
  if (mesh.guarded[patch]) return;
  mesh.guarded[patch] = 1;
  ++report->guarded_patches;
}

// Takes folds out of what the last stage gave, and remembers the patches that have none.
static Status unfold(Context& context, const FairMesh& mesh, const Guard& guard, Unfolded* safe) {
  TRY(mesh::unfold(context, {mesh.position, mesh.triangle, mesh.patch, kept_vertices(mesh, guard)},
                   safe->folds.span()));
  return in_parts(context, mesh.triangle.size(), [&](size_t h) {
    const uint32_t v = mesh.triangle[h], p = mesh.patch[h / 3];
    if (safe->folds[p] > 0) return;
    safe->triangle[h] = v;
    safe->position[v] = mesh.position[v];
    safe->known[p] = 1;
  });
}

// Patches that end with folds go back to the last state that had none.
static Status put_back_folded(Context& context, const FairMesh& mesh, const Unfolded& safe,
                              FairReport* report) {
  for (uint32_t p = 0; p < safe.folds.size(); ++p) {
    if (safe.folds[p] == 0 || !safe.known[p]) continue;
    TRY(in_parts(context, mesh.triangle.size(), [&](size_t h) {
      if (mesh.patch[h / 3] != p) return;
      const uint32_t v = safe.triangle[h];
      mesh.triangle[h] = v;
      if (!mesh.on_curve[v]) mesh.position[v] = safe.position[v];
    }));
    hold_back(mesh, p, report);
  }
  return {};
}

static Status harmonic_start(Context& context, const FairMesh& mesh, double* residual) {
  TRY(context.enter(Stage::operators));
  const uint32_t n = static_cast<uint32_t>(mesh.position.size());
  sparse::Csc laplacian(context);
  System system(context);
  Array<double> weight(context);
  TRY(mesh::cotangent_laplacian(n, mesh.triangle, mesh.start_shape, &laplacian));
  TRY(assign_in_parts(n, 1.0, &weight));
  TRY(system.prepare(laplacian, mesh.on_curve, Order::one, mesh.places));  // soft curves move later
  TRY(system.factor(weight.span(), {}));
  return system.solve({}, {}, mesh.position, residual);
}

namespace {

// The paper's steps are linear in what the curves hold, so they flatten a patch whose normals
// cancel out. Vertices with a place of their own are held there meanwhile.
struct Placed {
  Array<uint8_t> on_curve, held;
  Array<Vec3> normal;

  explicit Placed(Context& context) : on_curve(context), held(context), normal(context) {}
};

}  // namespace

static Status put_in_place(Context& context, const FairMesh& mesh, Placed* placed,
                           FairMesh* fixed) {
  *fixed = mesh;
  if (mesh.placed.empty()) return {};
  TRY(placed->on_curve.copy(mesh.on_curve));
  TRY(placed->held.copy(mesh.held));
  TRY(placed->normal.resize(mesh.position.size()));
  TRY(in_parts(context, mesh.placed.size(), [&](size_t v) {
    if (mesh.placed[v]) mesh.position[v] = mesh.start[v];
  }));
  TRY(mesh::vertex_normals(context, mesh.position, mesh.triangle, placed->normal.span()));
  TRY(in_parts(context, mesh.placed.size(), [&](size_t v) {
    if (!mesh.placed[v]) return;
    placed->on_curve[v] = placed->held[v] = 1;
    mesh.normal[v] = placed->normal[v];
  }));
  fixed->on_curve = placed->on_curve.span();
  fixed->held = placed->held.span();
  return {};
}

static Status paper_step(Context& context, const FairMesh& mesh, Array<mesh::TriangleShape>* shapes,
                         FairReport* report) {
  uint32_t flips = 0;
  TRY(context.enter(Stage::operators));
  TRY(mesh::care(context, {mesh.position, mesh.triangle, mesh.patch, mesh.on_curve}, &flips));
  report->flips += flips;
  TRY(mesh::triangle_shapes(mesh.position, mesh.triangle, shapes));
  const Domain domain = {mesh.triangle, shapes->span(), mesh.on_curve, mesh.held,  mesh.on_border,
                         Metric::space, mesh.soft,      mesh.bare,     mesh.places};
  return smooth(context, domain, Method::stanko, {mesh.position, mesh.normal}, &report->residual);
}

static Status prepare_guard(Context& context, const FairMesh& mesh, uint32_t patches,
                            Guard* guard) {
  TRY(copy_in_parts(mesh.position, &guard->position));
  TRY(context.checkpoint());
  TRY(copy_in_parts(mesh.triangle, &guard->triangle));
  TRY(guard->area.assign(patches, 0.0));
  TRY(guard->step.assign(patches, -1.0));
  TRY(guard->frozen.assign(patches, 0));
  TRY(guard->still.copy(mesh.held));
  TRY(guard->kept.copy(mesh.on_curve));
  return in_parts(context, mesh.patch.size(), [&](size_t t) {
    const uint32_t* v = &mesh.triangle[3 * t];
    const Vec3& a = mesh.position[v[0]];
    guard->area[mesh.patch[t]] +=
        0.5 * length(cross(mesh.position[v[1]] - a, mesh.position[v[2]] - a));
  });
}

// Puts a patch back: flips stay within a patch, so its triangles still stand in the same places.
static Status freeze(Context& context, const FairMesh& mesh, uint32_t patch, Guard* guard) {
  guard->frozen[patch] = 1;
  return in_parts(context, mesh.triangle.size(), [&](size_t h) {
    if (mesh.patch[h / 3] != patch) return;
    const uint32_t v = guard->triangle[h];
    mesh.triangle[h] = v;
    mesh.position[v] = guard->position[v];
    guard->still[v] = guard->kept[v] = 1;
  });
}

// Puts all patches back that are not frozen.
static Status freeze_all(Context& context, const FairMesh& mesh, Guard* guard, FairReport* report) {
  TRY(in_parts(context, mesh.triangle.size(), [&](size_t h) {
    const uint32_t patch = mesh.patch[h / 3];
    if (guard->frozen[patch]) return;
    const uint32_t v = guard->triangle[h];
    mesh.triangle[h] = v;
    mesh.position[v] = guard->position[v];
    guard->still[v] = guard->kept[v] = 1;
    hold_back(mesh, patch, report);
  }));
  for (uint8_t& frozen : guard->frozen) frozen = 1;
  return {};
}

// Compares the displacements of each patch with its size, before they are applied.
static Status watch(Context& context, const FairMesh& mesh, Span<const double> step, Guard* guard,
                    FairReport* report) {
  Array<double> greatest(context);
  TRY(greatest.assign(guard->area.size(), 0.0));
  TRY(in_parts(context, mesh.triangle.size(), [&](size_t h) {
    const double u = std::fabs(step[mesh.triangle[h]]);
    double& most = greatest[mesh.patch[h / 3]];
    if (most == most && !(u <= most)) most = u;  // not a number stays
  }));
  for (uint32_t p = 0; p < greatest.size(); ++p) {
    if (guard->frozen[p]) continue;
    const double share = greatest[p] / std::sqrt(guard->area[p]);
    const bool first = guard->step[p] < 0.0;
    const bool grows = !first && share > k_growth * guard->step[p] && share > k_growing_step;
    if (first && share > report->greatest_step) report->greatest_step = share;
    guard->step[p] = share;
    if (share <= k_greatest_step && !grows) continue;
    TRY(freeze(context, mesh, p, guard));
    hold_back(mesh, p, report);
  }
  return {};
}

static Status foretell(Context& context, const FairMesh& mesh, Span<const Vec3> curve_normal,
                       Foretold* foretold) {
  Array<uint8_t> given(context);
  TRY(given.copy(mesh.held));
  TRY(in_parts(context, mesh.bare.size(), [&](size_t v) { given[v] = given[v] && !mesh.bare[v]; }));
  return foretell_curvature(context,
                            {mesh.position, curve_normal, mesh.triangle, mesh.patch, given.span()},
                            &foretold->curvature, &foretold->weight);
}

static double mean_patch_size(const Guard& guard) {
  double sum = 0.0;
  for (double area : guard.area) sum += area;
  return std::sqrt(sum / static_cast<double>(guard.area.size()));
}

static Status displacement_step(Context& context, const FairMesh& mesh, double smoothing_length,
                                Span<const Vec3> curve_normal, const Foretold& foretold,
                                MinimumVariation* solver, Guard* guard, FairReport* report) {
  const size_t n = mesh.position.size();
  Array<Vec3> direction(context);
  Array<double> step(context);
  uint32_t flips = 0;
  TRY(context.enter(Stage::operators));
  TRY(mesh::care(context, {mesh.position, mesh.triangle, mesh.patch, guard->kept.span()}, &flips));
  report->flips += flips;
  TRY(direction.resize(n));
  TRY(step.resize(n));
  const DisplaceInput input = {mesh.position,
                               curve_normal,
                               mesh.triangle,
                               mesh.patch,
                               mesh.on_curve,
                               mesh.held,
                               mesh.on_border,
                               smoothing_length,
                               mesh.soft,
                               mesh.bare,
                               foretold.curvature.span(),
                               foretold.weight.span(),
                               mesh.inner_edge};
  TRY(solver->solve(input, direction.span(), step.span()));
  TRY(watch(context, mesh, step.span(), guard, report));
  return in_parts(context, n, [&](size_t v) {
    if (!guard->still[v]) mesh.position[v] += step[v] * direction[v];
  });
}

Status fair(Context& context, const FairMesh& mesh, uint32_t patches, const FairOptions& options,
            FairReport* report) {
  Array<mesh::TriangleShape> shapes(context);
  Array<Vec3> curve_normal(context);
  Placed placed(context);
  FairMesh fixed;
  Guard guard(context);
  Unfolded safe(context);
  TRY(copy_in_parts(mesh.position, &safe.position));
  TRY(context.checkpoint());
  TRY(copy_in_parts(mesh.triangle, &safe.triangle));
  TRY(safe.folds.assign(patches, 0));
  TRY(safe.known.assign(patches, 0));
  if (!mesh.start_shape.empty()) TRY(harmonic_start(context, mesh, &report->residual));
  TRY(put_in_place(context, mesh, &placed, &fixed));
  TRY(unfold(context, mesh, guard, &safe));
  for (int k = 0; k < options.paper_steps; ++k) {
    TRY(paper_step(context, fixed, &shapes, report));
    TRY(unfold(context, mesh, guard, &safe));
  }
  // Soft curves take the normals that the last step smoothed; held ones have those given.
  TRY(copy_in_parts(mesh.normal, &curve_normal));
  TRY(prepare_guard(context, mesh, patches, &guard));
  Foretold foretold(context);
  if (options.displacement_steps > 0) {
    TRY(foretell(context, mesh, curve_normal.span(), &foretold));
  }
  MinimumVariation solver(context);
  const double smoothing_length = options.smoothness * mean_patch_size(guard);
  for (int k = 0; k < options.displacement_steps; ++k) {
    const Status moved = displacement_step(context, mesh, smoothing_length, curve_normal.span(),
                                           foretold, &solver, &guard, report);
    // Triangles too thin for a system of this order may do for those before.
    const bool singular = moved.code == Code::not_positive_definite;
    if (singular) {
      TRY(freeze_all(context, mesh, &guard, report));
    } else {
      TRY(moved);
      report->residual = solver.residual();
    }
    TRY(unfold(context, mesh, guard, &safe));
    if (singular) break;
    double greatest = 0.0;
    for (size_t p = 0; p < guard.step.size(); ++p) {
      if (!guard.frozen[p] && guard.step[p] > greatest) greatest = guard.step[p];
    }
    if (greatest < k_small_step) break;
  }
  TRY(put_back_folded(context, mesh, safe, report));
  report->factorisations = solver.factorisations();
  report->iterations = solver.iterations();
  return {};
}

}  // namespace wireskin::smooth
