// Distance from points to a triangle mesh, and the triangle that is nearest.
//
// A tree of bounding boxes over the triangles, split at the median of the longest side; a query
// descends into the nearer child first and leaves out boxes farther than the best triangle so far.
// Cost: O(n log n) to build, about O(log n) a query near the mesh.
#pragma once

#include "cut.h"

namespace accuracy {

double distance_to_triangle(const networks::Point& p, const networks::Point& a,
                            const networks::Point& b, const networks::Point& c);

class MeshDistance {
 public:
  explicit MeshDistance(const networks::Mesh& mesh);

  struct Nearest {
    double distance;
    uint32_t triangle;
  };
  Nearest nearest(const networks::Point& p) const;

  networks::Point triangle_normal(uint32_t triangle) const;
  double diagonal() const;

 private:
  struct Box {
    networks::Point low, high;
    uint32_t first, count;  // of order_, in a leaf
    uint32_t second;        // the right child; the left one follows its parent
  };
  uint32_t split(uint32_t first, uint32_t count);
  void search(uint32_t box, const networks::Point& p, Nearest& best) const;

  networks::Mesh mesh_;
  std::vector<uint32_t> order_;
  std::vector<Box> boxes_;
};

}  // namespace accuracy
