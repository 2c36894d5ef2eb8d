// How far the samples that the caller gave lie from the curves of a surface made of a flow.
//
// In: the samples as given, before noise was taken out, and the finished surface. Out: the greatest
// and the root mean square distance, in the counts of the surface. A sample is compared with the
// edges of its own arc next to it, so that other curves nearby do not count; isolated points are
// vertices. O(samples).
#pragma once

#include "flow/flow.h"
#include "surface.h"

namespace wireskin {

// `vertex_of`: of each sample of the flow.
Status measure_given(const flow::Flow& flow, Span<const Vec3> given, Span<const uint32_t> vertex_of,
                     Surface* surface);

}  // namespace wireskin
