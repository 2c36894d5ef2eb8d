// Curves as strings of beads, on which places of theirs can be made one point.
//
// A bead is a sample, or a place between samples that became one; beads of samples have the
// sample's index. The beads of a curve are a list, those of a point a ring, and the set of a bead
// names its point. In: wires, and how many joints there will be at most: each has room for two new
// beads. No operation on them allocates; each costs the beads that it passes, and the logarithm of
// those made on its edge, for these are a search tree as well: one line may cross all others.
// Curves are made of them again by network/write_beads.h.
//
// Source of the tree: R. Seidel, C. R. Aragon, "Randomized Search Trees", 1996.
#pragma once

#include "network/approach.h"

namespace wireskin::network {

struct Bead {
  Vec3 position;
  double to_next = 0.0;  // along the chords
  double part = 0.0;     // of the edge after sample `edge`; zero for samples
  uint32_t edge = k_none;
  uint32_t previous = k_none, next = k_none;
  // The beads made on an edge are a tree by their parts: those of less part, those of more. It
  // hangs on the edge's sample as what is more.
  uint32_t lower = k_none, upper = k_none;
  uint32_t ring = k_none;
  uint32_t given = k_none;  // the point before any joint
  bool joined = false;      // that had more than one sample
};

// A place in the list: a bead, or that far behind it.
struct BeadPlace {
  uint32_t bead = k_none;
  double behind = 0.0;
};

struct Beads {
  const Wires& wires;
  Array<Bead> bead;
  Array<uint32_t> curve;   // of each sample
  Array<uint8_t> touched;  // of each bead that names a point: something came to it
  DisjointSets sets;

  explicit Beads(const Wires& given)
      : wires(given),
        bead(given.position.context()),
        curve(given.position.context()),
        touched(given.position.context()),
        sets(given.position.context()) {}

  // Strings the samples; `curve` is filled before.
  Status string_samples(size_t joints);

  Context& context() const { return wires.position.context(); }
  size_t room() const { return touched.size(); }
  double edge_length(uint32_t i) const {
    return length(wires.position[wires.next(curve[i], i)] - wires.position[i]);
  }
  bool is_end(uint32_t b) const {
    return bead[b].part == 0.0 && wires.is_end(curve[bead[b].edge], bead[b].edge);
  }
  bool is_free_end(uint32_t b) const { return bead[b].ring == b && is_end(b); }
  uint32_t curve_of(uint32_t b) const { return curve[bead[b].edge]; }
  WirePlace place_of(uint32_t b) const { return {bead[b].edge, bead[b].part}; }
  Vec3 point_at(const WirePlace& place) const {
    return point_of_place(wires, curve[place.edge], place);
  }
  Vec3 direction_at(
      const WirePlace& place) const;             // along the curve, of any length; of a point zero
  Vec3 normal_at(const WirePlace& place) const;  // not unit; zero where it is not known
  Origin origin_of(const WirePlace& place) const;

  BeadPlace locate(const WirePlace& place) const;
  // The nearest loose end of the curve, no farther along it than `to_end`, or joined bead, within
  // `to_node` as well.
  uint32_t special_near(const BeadPlace& place, double to_end, double to_node) const;
  // The place nearest to `target` on the same curve, within `reach` along it.
  WirePlace nearest_place(const WirePlace& near, const Vec3& target, double reach) const;
  // Puts a new bead into the tree of its edge.
  void plant(uint32_t b);
  // The bead at a place; a new one between beads.
  uint32_t make_bead(const WirePlace& place);
  // Makes the points of two beads one.
  void unite(uint32_t a, uint32_t b);
  // Makes points one that are no farther apart along a curve than `reach`, where something came to
  // one of them, as where many curves meet in about one point.
  Status unite_close(double reach);
};

}  // namespace wireskin::network
