// The sparse matrices of the peers' rig: files PREFIX.K.csc, PREFIX.xy.vec and PREFIX.patch.vec,
// and the programs that time other libraries on them.
//
// A .csc file holds int64 {magic, rows, columns, entries}, int32 column starts, int32 rows, double
// values, of a lower triangle; a .vec file int64 length and the numbers. Failures throw.
#pragma once

#include <string>
#include <vector>

#include "num/vec.h"
#include "sparse/csc.h"

namespace bench {

// Where each unknown stands, and its patch.
struct Places {
  std::vector<wireskin::Vec3> position;
  std::vector<uint32_t> patch;
};

struct RigMatrix : Places {
  wireskin::sparse::Csc lower;

  explicit RigMatrix(wireskin::Context& context) : lower(context) {}
};

void read_matrix(const std::string& prefix, const std::string& which, RigMatrix* matrix);
// As PREFIX.K.csc, PREFIX.xy.vec and PREFIX.patch.vec.
void write_matrix(const wireskin::sparse::Csc& lower, const Places& places,
                  const std::string& prefix);

// Runs `spsolve` of the rig, single-threaded; milliseconds, negative where it could not be run.
struct PeerTimes {
  double analyse = -1, factor = -1, solve = -1, refactor = -1;
  double nonzeros = 0, residual = 0;

  double sum() const { return analyse + factor + solve; }
};
PeerTimes run_peer(const std::string& folder, const std::string& prefix, const std::string& which,
                   const std::string& method);

}  // namespace bench
