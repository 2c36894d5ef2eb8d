// Raw curves on their way to a network: the one structure that welding, chaining, snapping and the
// work on normals hand to each other.
//
// Curve c has the samples start[c] .. start[c + 1). Samples with the same `point` are one point of
// space, whichever curves they belong to; a point with more than one sample is a node. Every sample
// remembers where the caller gave it, every edge (from a sample to the next one of its curve) the
// caller's edge that it lies on. Normals are unit, or zero where they are not known.
#pragma once

#include "base/array.h"
#include "num/vec.h"

namespace wireskin::network {

// A place on the caller's curves: a sample, or that part of the way to the next one.
struct Origin {
  uint32_t curve = k_none;
  uint32_t sample = k_none;
  double part = 0.0;
};

// The caller's edge after `sample`, passed in his direction or backwards.
struct EdgeOrigin {
  uint32_t curve = k_none;
  uint32_t sample = k_none;
  uint32_t backwards = 0;
};

struct Wires {
  Array<uint32_t> start;
  Array<Vec3> position, normal;
  Array<Vec3> right;        // normals on the right of sharp curves; empty where no curve is sharp
  Array<uint32_t> point;    // of each sample, below `points`
  Array<uint32_t> number;   // the caller's node number of each sample, k_none where it has none
  Array<Origin> origin;     // of each sample
  Array<EdgeOrigin> along;  // of the edge after each sample; empty once samples were inserted
  Array<uint8_t> closed, boundary, sharp;
  Array<double> soft;
  uint32_t points = 0;

  explicit Wires(Context& context)
      : start(context),
        position(context),
        normal(context),
        right(context),
        point(context),
        number(context),
        origin(context),
        along(context),
        closed(context),
        boundary(context),
        sharp(context),
        soft(context) {}

  uint32_t curves() const { return static_cast<uint32_t>(closed.size()); }
  uint32_t samples() const { return static_cast<uint32_t>(position.size()); }
  uint32_t size(uint32_t c) const { return start[c + 1] - start[c]; }
  // The neighbours of sample i of curve c; k_none beyond the ends of an open curve.
  uint32_t next(uint32_t c, uint32_t i) const {
    if (i + 1 < start[c + 1]) return i + 1;
    return closed[c] ? start[c] : k_none;
  }
  uint32_t previous(uint32_t c, uint32_t i) const {
    if (i > start[c]) return i - 1;
    return closed[c] ? start[c + 1] - 1 : k_none;
  }
  bool is_end(uint32_t c, uint32_t i) const {
    return !closed[c] && (i == start[c] || i + 1 == start[c + 1]);
  }
};

// Sets of indices that only ever grow together; a set is named by its least member.
class DisjointSets {
 public:
  explicit DisjointSets(Context& context) : parent_(context) {}
  Status reset(uint32_t size);
  uint32_t find(uint32_t i);
  // Whether they were apart.
  bool unite(uint32_t a, uint32_t b);

 private:
  Array<uint32_t> parent_;
};

struct WireCounts {
  uint32_t curves = 0;
  uint32_t samples = 0;
  uint32_t nodes = 0;       // points with more than one sample
  uint32_t dangling = 0;    // ends of open curves at which nothing else is
  uint32_t components = 0;  // connected ones
};

Status curve_of_samples(const Wires& wires, Array<uint32_t>* curve);

// Makes room for one more curve of `samples` samples, whose right normals are stored if `sharp`.
Status reserve_wires(uint32_t curves, uint32_t samples, bool sharp, Wires* wires);

// Gives every sample its point: samples with the same number are one, and so are samples at the
// same place. O(s log s).
Status weld(Wires* wires);

// The steps of it: unites the samples whose caller's numbers agree; numbers the points that united
// samples are.
Status unite_numbers(const Wires& wires, DisjointSets* sets);
Status number_points(DisjointSets* sets, Wires* wires);

// The samples of each point: those of point p are member[first[p] .. first[p + 1]), ascending.
struct PointMembers {
  Array<uint32_t> first, member;
  explicit PointMembers(Context& context) : first(context), member(context) {}
  Span<const uint32_t> operator[](uint32_t p) const {
    return member.span().part(first[p], first[p + 1] - first[p]);
  }
};
Status list_members(const Wires& wires, PointMembers* members);

// `component` of each curve is numbered from zero in the order of the curves.
Status count_wires(const Wires& wires, Array<uint32_t>* component, WireCounts* counts);

// What curves that are to meet may miss each other by: the median edge, which is about what strokes
// do, but at most 1/100 of the diagonal of the bounding box.
Status automatic_tolerance(const Wires& wires, double diagonal, double* tolerance);

}  // namespace wireskin::network
