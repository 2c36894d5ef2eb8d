#include "flow/sheet.h"

namespace wireskin::flow {

Status start_sheet(const Complex& complex, Sheet* sheet) {
  TRY(sheet->in.assign(complex.triangle_count(), 0));
  TRY(sheet->degree.assign(complex.edge_count(), 0));
  // Within one removal degrees only fall, so an edge comes loose at most once.
  TRY(sheet->loose.reserve(complex.edge_count()));
  TRY(sheet->removed.reserve(complex.triangle_count()));
  sheet->loose.clear();
  sheet->removed.clear();
  return {};
}

Status copy_sheet(const Sheet& source, Sheet* sheet) {
  TRY(sheet->in.copy(source.in.span()));
  TRY(sheet->degree.copy(source.degree.span()));
  TRY(sheet->loose.reserve(source.degree.size()));
  TRY(sheet->removed.reserve(source.in.size()));
  sheet->loose.clear();
  sheet->removed.clear();
  return {};
}

void add_to_sheet(const Complex& complex, uint32_t triangle, Sheet* sheet) {
  if (sheet->in[triangle] != 0) return;
  sheet->in[triangle] = 1;
  for (uint32_t k = 0; k < 3; ++k) ++sheet->degree[complex.triangle_edge[3 * size_t{triangle} + k]];
}

void begin_removal(Sheet* sheet) {
  sheet->loose.clear();
  sheet->removed.clear();
  sheet->bared = false;
}

void remove_triangle(const Complex& complex, const CurveEdges& curves, uint32_t triangle,
                     Sheet* sheet) {
  if (sheet->in[triangle] == 0) return;
  sheet->in[triangle] = 0;
  sheet->removed.push_reserved(triangle);
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t e = complex.triangle_edge[3 * size_t{triangle} + k];
    const uint32_t left = --sheet->degree[e];
    if (left == 1) sheet->loose.push_reserved(e);
    if (left == 0 && curves.on_curve(e)) sheet->bared = true;
  }
}

// Until nothing is loose or, if wished, a curve has lost its last triangle.
static Status drain_loose(const Complex& complex, const CurveEdges& curves, Protect protect,
                          bool until_bared, Sheet* sheet) {
  while (!sheet->loose.empty() && !(until_bared && sheet->bared)) {
    TRY(sheet->pace.after());
    const uint32_t e = sheet->loose.back();
    sheet->loose.pop();
    if (sheet->degree[e] != 1) continue;
    if (protect == Protect::curves && curves.on_curve(e)) continue;
    for (const uint32_t t : complex.triangles_of(e)) {
      if (sheet->in[t] != 0) remove_triangle(complex, curves, t, sheet);
    }
  }
  return {};
}

Status peel_after(const Complex& complex, const CurveEdges& curves, Protect protect, Sheet* sheet) {
  return drain_loose(complex, curves, protect, false, sheet);
}

Status peel_unless_bared(const Complex& complex, const CurveEdges& curves, Sheet* sheet) {
  TRY(drain_loose(complex, curves, Protect::curves, true, sheet));
  if (sheet->bared) undo_removal(complex, sheet);
  return {};
}

Status peel(const Complex& complex, const CurveEdges& curves, Protect protect, Sheet* sheet) {
  begin_removal(sheet);
  for (uint32_t e = 0; e < sheet->degree.size(); ++e) {
    if (sheet->degree[e] == 1) sheet->loose.push_reserved(e);
  }
  TRY(peel_after(complex, curves, protect, sheet));
  begin_removal(sheet);
  return {};
}

void undo_removal(const Complex& complex, Sheet* sheet) {
  for (const uint32_t t : sheet->removed) add_to_sheet(complex, t, sheet);
  begin_removal(sheet);
}

Status flood_patch(const Complex& complex, const CurveEdges& curves, const Sheet& sheet,
                   uint32_t triangle, uint32_t value, Span<uint32_t> mark, Array<uint32_t>* patch) {
  Pace pace(patch->context());
  patch->clear();
  TRY(patch->push(triangle));
  mark[triangle] = value;
  for (size_t i = 0; i < patch->size(); ++i) {
    TRY(pace.after());
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t e = complex.triangle_edge[3 * size_t{(*patch)[i]} + k];
      if (sheet.degree[e] != 2 || curves.by_curve(e)) continue;
      for (const uint32_t t : complex.triangles_of(e)) {
        if (sheet.in[t] == 0 || mark[t] == value) continue;
        mark[t] = value;
        TRY(patch->push(t));
      }
    }
  }
  return {};
}

}  // namespace wireskin::flow
