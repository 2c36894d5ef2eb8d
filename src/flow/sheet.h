// A set of triangles of the complex, and the peeling of it from its free edges.
//
// Peeling removes a triangle as long as one has an edge that no other triangle of the set has and
// that is not protected. What is left does not depend on the order. Linear in what is removed.
// Source: the restricted collapse of B. Sadri, K. Singh, "Flow-Complex-Based Shape Reconstruction
// from 3D Curves", 2014, section 3.
#pragma once

#include "base/in_parts.h"
#include "flow/curve_edges.h"

namespace wireskin::flow {

struct Sheet {
  Array<uint8_t> in;       // of each triangle
  Array<uint32_t> degree;  // of each edge: its triangles in the set
  // Scratch of peel(); what the last removal took away, so that it can be undone.
  Array<uint32_t> loose;
  Array<uint32_t> removed;
  bool bared = false;  // the last removal took the last triangle from a curve
  Pace pace;           // of peeling: most removals are small, and many

  explicit Sheet(Context& context)
      : in(context), degree(context), loose(context), removed(context), pace(context) {}
};

enum class Protect { nothing, curves };

// The empty set, with room for all removals that may come.
Status start_sheet(const Complex& complex, Sheet* sheet);
Status copy_sheet(const Sheet& source, Sheet* sheet);
void add_to_sheet(const Complex& complex, uint32_t triangle, Sheet* sheet);

// Peels everything. Then `removed` is empty: this is not to be undone.
Status peel(const Complex& complex, const CurveEdges& curves, Protect protect, Sheet* sheet);

// Removes one triangle without peeling; several of these and one peel_after() make one removal.
void begin_removal(Sheet* sheet);
void remove_triangle(const Complex& complex, const CurveEdges& curves, uint32_t triangle,
                     Sheet* sheet);
Status peel_after(const Complex& complex, const CurveEdges& curves, Protect protect, Sheet* sheet);
// Likewise, the curves protected; where one would lose its last triangle, takes the whole removal
// back at once: then `removed` is empty.
Status peel_unless_bared(const Complex& complex, const CurveEdges& curves, Sheet* sheet);
void undo_removal(const Complex& complex, Sheet* sheet);

// The triangles that can be reached from one without crossing a curve, a chord, or an edge whose
// number of triangles is not two. `mark` of those becomes `value`; none has it before.
Status flood_patch(const Complex& complex, const CurveEdges& curves, const Sheet& sheet,
                   uint32_t triangle, uint32_t value, Span<uint32_t> mark, Array<uint32_t>* patch);

}  // namespace wireskin::flow
