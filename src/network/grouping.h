// The state that the rules of network/group.h hand on: which cycles are one patch so far.
//
// In: a network every cycle of which is a patch of its own, and the curve vertices. `parent` and
// `next` are union-find with a ring through each set, so that the patches of a group are walked in
// the time of their number. A ring of boundary curves may be turned over (`reversed`). Joining is
// O(1) but for the search of the roots; asking whether two groups meet takes their corners.
#pragma once

#include "network/enclosure.h"

namespace wireskin::network {

struct Grouping {
  const CurveVertices& vertices;
  Network* network;
  Components components;
  Lists corner;                // of each patch: the vertices at the ends of its segments, ascending
  Lists at_corner;             // of each vertex: the patches that have it as corner
  Array<Enclosing> enclosing;  // of each component
  Array<uint32_t> component;   // of each patch
  Array<uint32_t> parent;      // of each patch
  Array<uint32_t> next;        // of each patch: another one of its group, all the way round
  Array<uint8_t> reversed;     // of each patch
  Array<uint8_t> told;         // of each patch: a ring whose side something inside it tells
  Array<uint32_t> holder;      // of each component that bounds nothing: its patch
  Array<uint32_t> doubtful;    // the same where another patch may be the right one
  Array<uint8_t> ambiguous;    // of each patch
  Array<uint8_t> settled;      // of each patch: a side of a ring that no other loop is to join
  Array<uint32_t> closed;      // of each component: how many patches, if it is one closed curve
                               // that meets no other, else k_none
  Array<uint8_t> passed;       // of each vertex, zero between questions

  Grouping(Context& context, const CurveVertices& of, Network* net);
  uint32_t root(uint32_t p) {
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
  }
  void join(uint32_t a, uint32_t b);
  bool is_alone(uint32_t p) const { return next[p] == p; }
};

Status take_components(Grouping* g);

// Whether two groups are one, or have loops that pass the same vertex: a patch that meets itself
// across a curve is never what normals ask for where another loop was nearer.
bool share_vertex(Grouping* g, uint32_t a, uint32_t b);

// The cosine between normals and axis in the mean over a border, and the area that it encloses.
double closing_cosine(const Border& border, double* area);

}  // namespace wireskin::network
