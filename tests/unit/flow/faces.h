// What is found of the flat faces of a net, step by step: each adds one to what it inherits.
#pragma once

#include <algorithm>

#include "flow/merge_cells.h"
#include "unit/flow/prisms.h"

namespace unit {

struct LinesOf : FlowOf {
  wireskin::flow::StraightLines lines{heap.context};
  const wireskin::flow::Drawing drawing{flow.complex, flow.samples, flow.curves, lines};

  explicit LinesOf(const flow_tests::Net& net) : FlowOf(net) {
    must(find_straight_lines(flow.complex, flow.samples, &lines));
  }
};

struct FacesOf : LinesOf {
  wireskin::flow::FlatFaces faces{heap.context};

  explicit FacesOf(const flow_tests::Net& net, double noise = 0.0) : LinesOf(net) {
    must(find_flat_faces(heap.context, drawing, noise, &faces));
  }
};

struct RimsOf : FacesOf {
  wireskin::flow::FaceRims rims{heap.context};

  explicit RimsOf(const flow_tests::Net& net) : FacesOf(net) {
    must(link_rims(faces, uint32_t(flow.samples.start.size() - 1), &rims));
  }
  size_t count(wireskin::flow::FaceState state) const {
    return size_t(std::count(rims.state.begin(), rims.state.end(), state));
  }
};

struct CellsOf : RimsOf {
  wireskin::flow::FaceCells cells{heap.context};

  explicit CellsOf(const flow_tests::Net& net) : RimsOf(net) {
    must(find_face_cells(flow.complex, faces, &rims, &cells));
  }
  void merge() { must(merge_cells(heap.context, drawing, faces, &rims, &cells)); }
};

}  // namespace unit
