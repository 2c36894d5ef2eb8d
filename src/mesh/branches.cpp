#include "mesh/branches.h"

#include "num/minmax.h"

namespace wireskin::mesh {

// The mean conormal of a loop that is the end of a tube has at least this length.
static constexpr double k_least_agreement = 0.7;
// Ends stay apart by so many radii of the lesser one, seen at so many places of each.
static constexpr double k_radii_apart = 0.75;
// Ends that are nearer to each other than that, side by side, may come no nearer.
static constexpr double k_as_far = 0.95;
static constexpr uint32_t k_probes_of_end = 32;
// Of the way to the middle of the others, and in such steps.
static constexpr double k_farthest_move = 0.9, k_step = 0.05;

namespace {

struct BranchEnd {
  Vec3 centre;
  Vec3 way;  // to the middle of the others, along the conormals
  double radius;
};

}  // namespace

static Vec3 mean_conormal(const Loops& loops, uint32_t l) {
  Vec3 sum;
  for (uint32_t v = loops.start[l]; v < loops.start[l + 1]; ++v) {
    const Vec3 along = loops.position[loops.next(l, v)] - loops.position[loops.previous(l, v)];
    sum += unit(cross(loops.normal[v], along));
  }
  return (1.0 / (loops.start[l + 1] - loops.start[l])) * sum;
}

static Status take_ends(const Loops& loops, Array<BranchEnd>* ends) {
  Vec3 all;
  for (uint32_t l = 0; l < loops.count(); ++l) {
    BranchEnd end = {{}, {}, 0.0};
    const uint32_t n = loops.start[l + 1] - loops.start[l];
    for (uint32_t v = loops.start[l]; v < loops.start[l + 1]; ++v) {
      end.centre += (1.0 / n) * loops.position[v];
    }
    for (uint32_t v = loops.start[l]; v < loops.start[l + 1]; ++v) {
      end.radius += length(loops.position[v] - end.centre) / n;
    }
    all += end.centre;
    TRY(ends->push(end));
  }
  for (uint32_t l = 0; l < loops.count(); ++l) {
    BranchEnd* end = &(*ends)[l];
    const Vec3 conormal = mean_conormal(loops, l);
    const Vec3 others = (1.0 / (loops.count() - 1)) * (all - end->centre);
    const double far = dot(others - end->centre, unit(conormal));
    if (length(conormal) > k_least_agreement && far > 0.0) end->way = far * unit(conormal);
  }
  return {};
}

// Whether two ends keep their distance when moved by a part of their ways.
static bool are_apart(const Loops& loops, Span<const BranchEnd> ends, uint32_t a, uint32_t b,
                      double part) {
  const double least = k_radii_apart * smaller(ends[a].radius, ends[b].radius);
  const Vec3 move = part * (ends[b].way - ends[a].way);
  const uint32_t n = loops.start[a + 1] - loops.start[a], m = loops.start[b + 1] - loops.start[b];
  bool apart = true;
  for (uint32_t i = 0; apart && i < k_probes_of_end; ++i) {
    const uint32_t v = loops.start[a] + static_cast<uint32_t>(uint64_t{i} * n / k_probes_of_end);
    for (uint32_t j = 0; apart && j < k_probes_of_end; ++j) {
      const uint32_t w = loops.start[b] + static_cast<uint32_t>(uint64_t{j} * m / k_probes_of_end);
      const Vec3 before = loops.position[w] - loops.position[v];
      const double now = length(before + move);
      apart = now > least || now > k_as_far * length(before);
    }
  }
  return apart;
}

// How far all ends may move before the first two of them come too near.
static Status find_part(Context& context, const Loops& loops, Span<const BranchEnd> ends,
                        double* part) {
  *part = k_farthest_move;
  for (uint32_t a = 0; a < loops.count(); ++a) {
    for (uint32_t b = a + 1; b < loops.count(); ++b) {
      double clear = 0.0;
      while (clear < *part && are_apart(loops, ends, a, b, clear + k_step)) clear += k_step;
      *part = smaller(*part, clear);
      TRY(context.checkpoint());
    }
  }
  return {};
}

// Of each vertex of the loops the one at the end of its tube.
static Status move_ends(const Loops& loops, Span<const BranchEnd> ends, double part,
                        Array<Vec3>* moved) {
  TRY(moved->copy(loops.position));
  for (uint32_t l = 0; l < loops.count(); ++l) {
    for (uint32_t v = loops.start[l]; v < loops.start[l + 1]; ++v) {
      (*moved)[v] += part * ends[l].way;
    }
  }
  return {};
}

static bool has_tube(const BranchEnd& end) {
  return end.way != Vec3{};
}

// Puts the tubes before what is between their ends. The vertices of a loop that has no tube are
// those of its end.
static Status add_tubes(const Loops& loops, Span<const BranchEnd> ends, Span<const Vec3> moved,
                        LoopMesh* core, LoopMesh* mesh) {
  const uint32_t rim = static_cast<uint32_t>(loops.position.size());
  Array<uint32_t> name(core->inner.context());
  TRY(name.resize(rim));
  uint32_t next = rim;
  for (uint32_t l = 0; l < loops.count(); ++l) {
    for (uint32_t v = loops.start[l]; v < loops.start[l + 1]; ++v) {
      name[v] = has_tube(ends[l]) ? next++ : v;
      if (has_tube(ends[l])) TRY(mesh->inner.push(moved[v]));
    }
  }
  for (const Vec3& p : core->inner) TRY(mesh->inner.push(p));
  for (uint32_t v : core->triangle) TRY(mesh->triangle.push(v < rim ? name[v] : next + (v - rim)));
  for (uint32_t l = 0; l < loops.count(); ++l) {
    for (uint32_t v = loops.start[l]; has_tube(ends[l]) && v < loops.start[l + 1]; ++v) {
      const uint32_t w = loops.next(l, v);
      const uint32_t added[] = {v, w, name[v], w, name[w], name[v]};
      for (uint32_t corner : added) TRY(mesh->triangle.push(corner));
    }
  }
  return {};
}

Status mesh_branches(Context& context, const Loops& loops, double spacing, LoopMesh* mesh) {
  Array<BranchEnd> ends(context);
  Array<Vec3> moved(context);
  LoopMesh core(context), made(context);
  double part = 0.0;
  TRY(take_ends(loops, &ends));
  TRY(find_part(context, loops, ends.span(), &part));
  if (part == 0.0) return mesh_loops(context, loops, spacing, mesh);
  TRY(move_ends(loops, ends.span(), part, &moved));
  const Status status =
      mesh_loops(context, {loops.start, moved.span(), loops.normal}, spacing, &core);
  if (status.code == Code::patch_folded) return mesh_loops(context, loops, spacing, mesh);
  TRY(status);
  TRY(add_tubes(loops, ends.span(), moved.span(), &core, &made));
  mesh->inner = static_cast<Array<Vec3>&&>(made.inner);
  mesh->triangle = static_cast<Array<uint32_t>&&>(made.triangle);
  mesh->coarse = core.coarse;
  return {};
}

}  // namespace wireskin::mesh
