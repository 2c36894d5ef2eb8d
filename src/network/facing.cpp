#include "network/facing.h"

#include "num/minmax.h"

namespace wireskin::network {

// Loops whose normals agree with their axis better than this bound a patch by themselves, if no
// other loop needs them.
static constexpr double k_clearly_closed = 0.5;
// So many vertices of a loop at most are looked at.
static constexpr uint32_t k_most_probes = 64;

Status add_facing(const Border& border, uint32_t loop, uint32_t patch, bool reversed, double cosine,
                  double area, Array<Facing>* facing, Array<Probe>* probes) {
  const uint32_t start = border.start[loop], n = border.start[loop + 1] - start;
  const uint32_t count = n < k_most_probes ? n : k_most_probes;
  const double least = larger(1.0 + cosine, 1e-3);
  Facing f = {patch,
              reversed,
              static_cast<uint32_t>(probes->size()),
              count,
              cosine < k_clearly_closed,
              8.0 * area / (least * least * least),
              Vec3{},
              0.0};
  const double total = border_length(border);
  for (uint32_t k = 0; k < count; ++k) {
    const uint32_t i = static_cast<uint32_t>(uint64_t{k} * n / count);
    const Vec3& p = border.position[start + i];
    const Vec3& next = border.position[start + (i + 1 < n ? i + 1 : 0)];
    const Vec3& before = border.position[start + (i > 0 ? i - 1 : n - 1)];
    const Vec3 conormal = unit(cross(border.normal[start + i], next - before));
    TRY(probes->push({p, reversed ? -conormal : conormal, total / count}));
    f.centre += (1.0 / count) * p;
  }
  for (uint32_t k = 0; k < count; ++k) {
    f.radius = larger(f.radius, length((*probes)[f.first + k].position - f.centre));
  }
  return facing->push(f);
}

double half_band(const Facing& a, const Facing& b, Span<const Probe> probes, double least_cosine) {
  double area = 0.0, cosine = 0.0;
  for (const Probe& p : probes.part(a.first, a.count)) {
    Vec3 nearest;
    double least = DBL_MAX;
    for (const Probe& q : probes.part(b.first, b.count)) {
      const Vec3 way = q.position - p.position;
      if (dot(way, way) < least) {
        least = dot(way, way);
        nearest = way;
      }
    }
    if (least == 0.0) return -1.0;  // loops that touch
    area += 0.5 * p.share * std::sqrt(least);
    cosine += dot(p.conormal, unit(nearest)) / static_cast<double>(a.count);
  }
  return cosine < least_cosine ? -1.0 : area * 2.0 / (1.0 + cosine);
}

}  // namespace wireskin::network
