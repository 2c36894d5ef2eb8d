#include "network/nearest_patch.h"

#include "mesh/nearest.h"
#include "network/patch_in_space.h"
#include "num/minmax.h"

namespace wireskin::network {

static constexpr uint32_t k_most_of_guess = 48;  // vertices of a loop
static constexpr uint32_t k_most_piece_probes = 48;

// Every so many-th vertex of each loop.
static Status thin_border(const Border& border, Border* thin) {
  TRY(thin->start.push(0));
  for (uint32_t l = 0; l < border.loops(); ++l) {
    const uint32_t first = border.start[l], n = border.start[l + 1] - first;
    const uint32_t count = n < k_most_of_guess ? n : k_most_of_guess;
    for (uint32_t k = 0; k < count; ++k) {
      const uint32_t i = first + static_cast<uint32_t>(uint64_t{k} * n / count);
      TRY(thin->vertex.push(border.vertex[i]));
      TRY(thin->position.push(border.position[i]));
      TRY(thin->normal.push(border.normal[i]));
    }
    TRY(thin->start.push(thin->size()));
  }
  return {};
}

static void measure_guess(Span<const Vec3> position, Span<const uint32_t> triangle,
                          PatchGuess* guess) {
  double area = 0.0;
  guess->low = guess->high = position[0];
  for (const Vec3& p : position) {
    Vec3 &low = guess->low, &high = guess->high;
    low = {smaller(low.x, p.x), smaller(low.y, p.y), smaller(low.z, p.z)};
    high = {larger(high.x, p.x), larger(high.y, p.y), larger(high.z, p.z)};
  }
  for (size_t t = 0; t < triangle.size(); t += 3) {
    const Vec3& a = position[triangle[t]];
    area += 0.5 * length(cross(position[triangle[t + 1]] - a, position[triangle[t + 2]] - a));
  }
  guess->size = std::sqrt(area);
}

Status add_guess(const Border& border, uint32_t number, PatchGuesses* guesses) {
  Context& context = border.vertex.context();
  Border thin(context);
  SpaceMesh mesh(context);
  TRY(thin_border(border, &thin));
  const double spacing = border_length(thin) / static_cast<double>(thin.size());
  const Status made = mesh_border_in_space(thin, spacing, &mesh);
  if (made.code == Code::patch_folded) return {};
  TRY(made);
  PatchGuess guess = {number,
                      static_cast<uint32_t>(guesses->position.size()),
                      static_cast<uint32_t>(guesses->triangle.size()),
                      static_cast<uint32_t>(mesh.triangle.size()),
                      thin.size(),
                      0.0,
                      Vec3{},
                      Vec3{}};
  measure_guess(mesh.position.span(), mesh.triangle.span(), &guess);
  for (const Vec3& p : mesh.position) TRY(guesses->position.push(p));
  for (uint32_t v : mesh.triangle) TRY(guesses->triangle.push(v));
  TRY(guesses->patch.push(guess));
  return context.checkpoint();
}

namespace {

// The place of a patch nearest to a point.
struct Foot {
  double distance = DBL_MAX;
  Vec3 normal;
  bool on_border = false;
};

}  // namespace

static Foot find_foot(const PatchGuesses& guesses, const PatchGuess& guess, const Vec3& p) {
  Foot foot;
  const Vec3* position = &guesses.position[guess.first_vertex];
  for (uint32_t t = 0; t < guess.triangles; t += 3) {
    const uint32_t* v = &guesses.triangle[guess.first_triangle + t];
    const Vec3 &a = position[v[0]], &b = position[v[1]], &c = position[v[2]];
    const Vec3 w = mesh::nearest_weights(p, a, b, c);
    const double distance = length(w.x * a + w.y * b + w.z * c - p);
    if (!(distance < foot.distance)) continue;
    foot = {distance, unit(cross(b - a, c - a)), mesh::is_on_border(w, v, guess.rim)};
  }
  return foot;
}

static bool meets_box(const PatchGuess& guess, const Vec3& p) {
  const double s = guess.size;
  return p.x > guess.low.x - s && p.x < guess.high.x + s && p.y > guess.low.y - s &&
         p.y < guess.high.y + s && p.z > guess.low.z - s && p.z < guess.high.z + s;
}

// The greatest distance of the piece from the patch, DBL_MAX where it does not lie on it.
static double distance_of_piece(const CurveVertices& vertices, const Piece& piece,
                                const PatchGuesses& guesses, const PatchGuess& guess) {
  const size_t n = piece.vertex.size();
  const size_t count = n < k_most_piece_probes ? n : k_most_piece_probes;
  double greatest = 0.0, facing = 0.0, known = 0.0;
  for (size_t k = 0; k < count; ++k) {
    const uint32_t v = piece.vertex[k * n / count];
    const Vec3& p = vertices.position[v];
    if (!meets_box(guess, p)) return DBL_MAX;
    const Foot foot = find_foot(guesses, guess, p);
    if (foot.on_border || !(foot.distance <= piece.farthest * guess.size)) return DBL_MAX;
    greatest = larger(greatest, foot.distance);
    facing += dot(vertices.normal[v], foot.normal);
    known += vertices.normal[v] != Vec3{} ? 1.0 : 0.0;
  }
  return facing < piece.least_facing * known ? DBL_MAX : greatest;
}

uint32_t nearest_patch(const CurveVertices& vertices, const Piece& piece,
                       const PatchGuesses& guesses) {
  uint32_t nearest = k_none;
  double least = DBL_MAX;
  for (uint32_t i = 0; i < guesses.patch.size(); ++i) {
    if (guesses.patch[i].number / 2 == piece.but) continue;
    const double distance = distance_of_piece(vertices, piece, guesses, guesses.patch[i]);
    if (!(distance < least)) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

}  // namespace wireskin::network
