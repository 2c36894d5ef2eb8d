// The check that every build ends with where assertions are compiled in: mesh/check.h with all that
// the network promises of its surface.
//
// In: the network as it was meshed, the surface, and positions for its vertices: those that the
// smoothing starts from, or its result. Out: ok, or no memory for the check; whatever else it finds
// is a fault of ours and stops the program. Releases do nothing here. Folds are not looked for: no
// surface avoids them where the curves themselves fold, and the guards of smooth/ report them.
// O(vertices + triangles).
#pragma once

#include "network/network.h"
#include "surface.h"

namespace wireskin {

Status verify_surface(Context& context, const network::Network& network, Span<const Vec3> position,
                      const Surface& surface);

// The same without a network, for a mesh of the caller's: a triangle may be as good as flat in the
// result if one was as it was given.
Status verify_triangles(Context& context, const TriangleSet& given, const Surface& surface);

}  // namespace wireskin
