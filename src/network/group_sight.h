// Loops that see each other bound a patch together: the ends of tubes, a hole and what is round it,
// limbs that leave a body; also where other curves connect them.
//
// In: what rules 1 and 2 of network/group.h have joined. Out: more groups joined, none that rule 2
// has settled. A disc inside a loop that hardly turns has a curvature of pi and more: such a loop
// asks every place what it sees (network/sight.h). Groups are joined to what they see best while
// the evidence lasts: the mean cosine at which it is seen, how little way that is against the cap
// over the loop (area over length; 2 A / (1 + m) for a circle of area A and mean cosine m between
// normals and axis, times (2 / (1 + m))^2), the loop's curvature, and the one that the joint patch
// is spared (by Gauss and Bonnet 4 pi less than the two alone). The weights are of a logistic
// regression over the loops of random cuts of four meshes. O(n log^2 n) and a few rounds.
#pragma once

#include "network/grouping.h"

namespace wireskin::network {

Status join_in_sight(Grouping* g);

}  // namespace wireskin::network
