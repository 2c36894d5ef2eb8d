// Which edges of the complex are pieces of the curves, and which cut a corner of one.
//
// In: the samples and their complex. Out: for each edge the segment it is (its place in
// Samples::at), or none; and for each other edge ab the sample m between, where a triangle a m b
// has two segments for its other edges: a chord. Sheets that meet at a chord are taken to meet at
// the curve. Segments that are no edges of the complex are counted. Linear.
// Source: B. Sadri, K. Singh, "Flow-Complex-Based Shape Reconstruction from 3D Curves", 2014,
// section 4.1 (segments as edges); chords and Gabriel edges: U. Bauer, H. Edelsbrunner, "The Morse
// Theory of Cech and Delaunay Complexes", 2017.
#pragma once

#include "flow/complex.h"
#include "flow/sample.h"

namespace wireskin::flow {

struct CurveEdges {
  Array<uint32_t> segment;       // of each edge: index in Samples::at of its begin, or k_none
  Array<uint32_t> chord_middle;  // of each edge: the sample that it passes over, or k_none
  Array<uint32_t> edge_of;       // of each place in Samples::at: its edge, k_none at ends of arcs
  uint32_t missing = 0;          // segments without an edge

  explicit CurveEdges(Context& context)
      : segment(context), chord_middle(context), edge_of(context) {}
  bool on_curve(uint32_t e) const { return segment[e] != k_none; }
  // On a curve, or as good as that.
  bool by_curve(uint32_t e) const { return segment[e] != k_none || chord_middle[e] != k_none; }
};

Status find_curve_edges(const Complex& complex, const Samples& samples, CurveEdges* curves);

}  // namespace wireskin::flow
