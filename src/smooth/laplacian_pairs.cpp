#include "smooth/laplacian_pairs.h"

#include "base/in_parts.h"
#include "sparse/nested_dissection.h"

namespace wireskin::smooth {

Status shifted_laplacian(const sparse::Csc& laplacian, Span<const uint32_t> unknown,
                         uint32_t unknowns, double scale, Span<const double> shift,
                         sparse::Csc* part) {
  part->rows = part->cols = unknowns;
  TRY(part->start.resize(size_t{unknowns} + 1));
  TRY(part->row.reserve(laplacian.row.size()));
  TRY(part->value.reserve(laplacian.row.size()));
  part->row.clear();
  part->value.clear();
  uint32_t j = 0;
  TRY(in_parts(part->start.context(), laplacian.cols, [&](size_t column) {
    if (unknown[column] == k_none) return;
    part->start[j] = static_cast<uint32_t>(part->row.size());
    for (uint32_t p = laplacian.start[column]; p < laplacian.start[column + 1]; ++p) {
      const uint32_t i = unknown[laplacian.row[p]];
      if (i == k_none || i < j) continue;
      const double own = i == j && !shift.empty() ? shift[column] : 0.0;
      part->row.push_reserved(i);
      part->value.push_reserved(own - scale * laplacian.value[p]);
    }
    ++j;
  }));
  part->start[j] = static_cast<uint32_t>(part->row.size());
  return {};
}

// The vertices with a number are the block's unknowns, in the same order.
Status LaplacianPairs::factor_block(const FairingBlocks& blocks, Span<const uint32_t> numbers,
                                    double scale, Span<const double> shift, Block* block) {
  Context& context = block->unknown.context();
  sparse::Csc part(context);
  Array<uint32_t> own(context), order(context), vertex(context);
  const size_t n = numbers.size();
  TRY(own.resize(n));
  TRY(vertex.reserve(n));
  TRY(block->unknown.reserve(n));
  TRY(block->area.reserve(n));
  block->unknown.clear();
  block->area.clear();
  TRY(in_parts(context, n, [&](size_t v) {
    own[v] = numbers[v] == k_none ? k_none : static_cast<uint32_t>(block->unknown.size());
    if (own[v] == k_none) return;
    vertex.push_reserved(static_cast<uint32_t>(v));
    block->unknown.push_reserved(numbers[v]);
    block->area.push_reserved(blocks.area[v]);
  }));
  const uint32_t unknowns = static_cast<uint32_t>(vertex.size());
  TRY(block->value.resize(unknowns));
  if (unknowns == 0) return {};
  TRY(shifted_laplacian(blocks.laplacian, own.span(), unknowns, scale, shift, &part));
  TRY(sparse::nested_dissection(part, {vertex.span(), blocks.places.position, blocks.places.patch},
                                &order));
  TRY(block->factor.analyse(part, order.span()));
  order.free();
  TRY(block->factor.factor(part));
  block->factor.end_factoring();
  return {};
}

Status LaplacianPairs::build(const FairingBlocks& blocks) {
  Context& context = u_.unknown.context();
  Array<double> shift(context);
  const double length2 = blocks.smoothing_length * blocks.smoothing_length;
  TRY(shift.resize(blocks.area.size()));
  TRY(in_parts(context, blocks.spring.size(),
               [&](size_t v) { shift[v] = std::sqrt(blocks.spring[v] * blocks.area[v]); }));
  TRY(factor_block(blocks, blocks.displacement, 1.0,
                   blocks.spring.empty() ? Span<const double>{} : shift.span(), &u_));
  TRY(in_parts(context, shift.size(), [&](size_t v) { shift[v] = 2.0 * blocks.area[v]; }));
  return factor_block(blocks, blocks.curvature, length2, shift.span(), &h_);
}

// The block's part of y := (S - L)^-1 M (S - L)^-1 x.
Status LaplacianPairs::apply_block(Span<const double> x, Span<double> y, Block* block) {
  const Span<double> value = block->value.span();
  if (value.empty()) return {};
  Context& context = block->unknown.context();
  TRY(in_parts(context, value.size(), [&](size_t i) { value[i] = x[block->unknown[i]]; }));
  TRY(block->factor.solve(value, 1));
  TRY(in_parts(context, value.size(), [&](size_t i) { value[i] *= block->area[i]; }));
  TRY(block->factor.solve(value, 1));
  return in_parts(context, value.size(), [&](size_t i) { y[block->unknown[i]] = value[i]; });
}

Status LaplacianPairs::apply(void* self, Span<const double> x, Span<double> y) {
  LaplacianPairs& pairs = *static_cast<LaplacianPairs*>(self);
  TRY(apply_block(x, y, &pairs.u_));
  return apply_block(x, y, &pairs.h_);
}

}  // namespace wireskin::smooth
