// Loops that see each other bound a patch together: the ends of tubes, a hole and what is round it,
// limbs that leave a body; also where other curves connect them.
//
// In: what rule 1 of network/group.h has joined. Out: more groups joined. A disc inside a loop that
// hardly turns has a curvature of pi and more: such a loop asks every place what it sees
// (network/sight.h). A group of loops is joined to what it sees best, as long as the evidence
// lasts: the mean cosine at which it is seen, how little way that is against the spherical cap over
// the loop (area over length; 2 A / (1 + m) for a circle of area A and mean cosine m between
// normals and axis, times (2 / (1 + m))^2), the loop's own curvature, and the curvature that the
// joint patch is spared (by Gauss and Bonnet 4 pi less than the two alone). The weights are those
// of a logistic regression over the loops of random cuts of four meshes. O(n log^2 n) and a few
// rounds.
#pragma once

#include "network/grouping.h"

namespace wireskin::network {

Status join_in_sight(Grouping* g);

}  // namespace wireskin::network
