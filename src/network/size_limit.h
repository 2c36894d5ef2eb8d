// Whether the surface of a network would have more vertices than the library makes, told before any
// of them is made.
//
// In: fitted curves, the cycles before they are grouped, the spacing. No surface over a cycle has
// less area than its vector area, and triangles of a size have 1.15 vertices a square: that, a
// fifth off for curves that bulge less than their knots, is what each cycle needs at the least.
// Where there are several components, what others enclose is taken off, since it may be a hole.
// Out: too_large with the patch that needs most and a curve of it, or else the curve that needs
// most. O(samples).
#pragma once

#include "network/border.h"

namespace wireskin::network {

// About a hundred GiB, and more than matrix factors with 32-bit indices can be made for.
inline constexpr uint32_t k_most_vertices = 1u << 26;
// What is done to a patch that no plane shows takes time in the square of this.
inline constexpr uint32_t k_longest_border_in_space = 1u << 16;
// With so many edges between two nodes a patch has room for few rows of triangles.
inline constexpr uint32_t k_most_edges_of_segment = 1u << 20;

Status check_vertex_count(const curves::Curves& curves, const Network& network, double spacing);

// The same of one patch that no plane shows, with its loops together; no place. What joins loops of
// vector areas V that are d apart has an area of V / 2 or d sqrt(2 pi V) at least: sections between
// them are as long as what they enclose demands, or enclose less than half of it.
Status check_border_size(const Border& border, double spacing);

}  // namespace wireskin::network
