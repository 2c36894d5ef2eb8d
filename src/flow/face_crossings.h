// Which triangles in a plane a curve runs across: these are in no flat face.
//
// In: the complex and the curves in it; a plane and a triangle. Out: yes or no, kept for the next
// time. Beside a triangle or along its edges is not across; nor is a straight line that its own
// samples are as far off. Outermost layers of flat tetrahedra, of huge empty balls outside of the
// hull, reach across curves, as do slivers of samples in a row. Cost for a triangle: the straight
// lines in its plane, and the samples of others near it. Source: own.
#pragma once

#include "flow/point_grid.h"
#include "flow/straight_lines.h"

namespace wireskin::flow {

struct FacePlane {
  Vec3 at, normal;
  double flat;  // what is nearer lies in it
};

enum class Crossed : uint8_t { unknown, no, yes };

struct CurvesAcross {
  Array<Vec3> line_end;        // two of each line
  Array<double> line_bend;     // of each line: how far its samples are off it
  Array<uint32_t> plane_line;  // those in the plane of a seed
  uint32_t plane_line_of = k_none;
  PointGrid grid;
  Array<uint32_t> curved;            // samples of arcs that bend
  Array<uint32_t> next_start, next;  // of each vertex: those that segments join it to
  Array<Crossed> crossed;            // of each triangle
  Array<uint32_t> judged;            // those judged in the plane looked at
  size_t work = 0;                   // how much was looked at

  explicit CurvesAcross(Context& context)
      : line_end(context),
        line_bend(context),
        plane_line(context),
        grid(context),
        curved(context),
        next_start(context),
        next(context),
        crossed(context),
        judged(context) {}
  // As planes follow what is in them: those judged in a plane left behind are unknown again.
  void forget_judged() {
    for (const uint32_t t : judged) crossed[t] = Crossed::unknown;
    judged.clear();
  }
};

inline bool near_plane(const FacePlane& plane, const Vec3& p) {
  return std::fabs(dot(p - plane.at, plane.normal)) <= plane.flat;
}

Status find_curves_across(const Drawing& drawing, CurvesAcross* across);

// `seed` tells planes apart.
bool is_crossed(const Drawing& drawing, const FacePlane& plane, uint32_t seed, uint32_t t,
                CurvesAcross* across);

}  // namespace wireskin::flow
