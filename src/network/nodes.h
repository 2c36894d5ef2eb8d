// Nodes: the points that several curves share.
//
// In: for every sample the number the caller gave it (k_none: none). Numbers that occur at two
// samples or more are nodes, whichever curves those belong to. Out: the nodes in ascending order of
// their numbers and the node of each sample. A node has the position of its first sample (the
// others must agree with it) and the mean of its samples' normals. Where sharp curves pass, normals
// may differ: there the mean is that of the sharp curves' sides, or of all normals where some side
// is not known. O(s log s).
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::network {

struct Node {
  Vec3 position;
  Vec3 normal;                    // unit; zero where no normal is known yet
  uint32_t number;                // the caller's
  bool crease = false;            // sharp curves pass here
  bool certain = true;            // all normals here are known
  uint32_t point_curve = k_none;  // the least curve of one sample that lies here
};

// The samples of all curves one after the other; curve c has start[c] .. start[c + 1).
struct SampleNumbers {
  Span<const uint32_t> start;
  Span<const uint32_t> number;
  Span<const Vec3> position;
  Span<const Vec3> normal;         // unit
  Span<const uint8_t> sharp = {};  // of each curve; empty: none
  Span<const Vec3> right = {};     // unit, of sharp curves; normals may be zero there: unknown
};

// `tolerance`: how far samples of one node may lie apart. Fails with node_mismatch or
// inconsistent_normals, naming curve, sample and number.
Status find_nodes(const SampleNumbers& samples, double tolerance, Array<Node>* nodes,
                  Array<uint32_t>* node_of_sample);

// Ends of open curves that nothing else meets, and points (curves of one sample), become nodes too,
// without a number and behind all others; each node learns of its points. `closed`: of each curve.
Status add_loose_ends(const SampleNumbers& samples, Span<const uint8_t> closed, Array<Node>* nodes,
                      Span<uint32_t> node_of_sample);

}  // namespace wireskin::network
