// The free-form curves of OBJ files: cstype, deg, curv, parm, end.
//
// B-splines and Bezier curves, rational or not, become polylines (see spline.h); degree 1 keeps its
// vertices. Where such a curve passes through a control point, that vertex is the sample, so that
// curves that share end points meet. Normals of control points are blended as the points are.
// Surfaces, trimming curves and what belongs to them are passed over; other kinds of curves are
// refused by name.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "network.h"
#include "scan.h"

namespace wireskin_cli {

struct FreeformCurve {
  NetworkCurve controls;  // indices of the control points
  std::string type;
  bool rational = false;
  size_t degree = 0;
  double first = 0.0;
  double last = 0.0;
  std::vector<double> parameters;
};

class FreeformReader {
 public:
  // One for each vertex of the file.
  void add_weight(double weight) { weights_.push_back(weight); }

  // A line that begins with curv.
  void begin_curve(const LineScanner& scanner, NetworkCurve&& controls);

  // Any line that is none of v, vn, l, f, p, g, o, curv; what does not concern curves is passed
  // over.
  void read_statement(const LineScanner& scanner);

  void check(const std::function<void(const std::vector<NetworkCurve>&)>& check_indices) const;

  // Appends the curves, and vertices for them, to the network.
  void sample_all(const LineScanner& scanner, Network& network) const;

 private:
  std::vector<double> weights_;
  std::vector<FreeformCurve> curves_;
  std::string type_;
  bool rational_ = false;
  size_t degree_ = 0;
  bool in_curve_ = false;
};

}  // namespace wireskin_cli
