#include "num/predicates.h"

#include "num/expansion.h"

namespace wireskin {

struct ExactVec2 {
  Expansion<2> x, y;
};

static ExactVec2 exact_vector(Vec2 from, Vec2 to) {
  return {exact_difference(to.x, from.x), exact_difference(to.y, from.y)};
}

static Expansion<16> exact_cross(const ExactVec2& a, const ExactVec2& b) {
  return a.x * b.y - a.y * b.x;
}

static Expansion<16> exact_square(const ExactVec2& a) { return a.x * a.x + a.y * a.y; }

double orient2d_exact(Vec2 a, Vec2 b, Vec2 c) {
  return exact_cross(exact_vector(c, a), exact_vector(c, b)).leading();
}

// Differences of neighbouring points are mostly exact in one double, so the expansions stay far
// shorter than their room.
double incircle_exact(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const ExactVec2 ad = exact_vector(d, a);
  const ExactVec2 bd = exact_vector(d, b);
  const ExactVec2 cd = exact_vector(d, c);
  const Expansion<512> a_term = exact_cross(bd, cd) * exact_square(ad);
  const Expansion<512> b_term = exact_cross(cd, ad) * exact_square(bd);
  const Expansion<512> c_term = exact_cross(ad, bd) * exact_square(cd);
  return (a_term + b_term + c_term).leading();
}

}  // namespace wireskin
