// Points on B-spline and Bezier curves of any degree up to 25, as OBJ files give them.
//
// A rational curve is one of (w x, w y, w z, w): the caller multiplies and divides. Evaluation is
// that of C. de Boor, "On Calculating with B-splines", 1972: degree squared operations a point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace wireskin_cli {

constexpr size_t k_max_degree = 25;
constexpr uint32_t k_no_control = 0xffffffffu;

struct Spline {
  size_t degree = 0;
  size_t dimension = 0;          // numbers a control point
  std::vector<double> knots;     // not decreasing; control points + degree + 1
  std::vector<double> controls;  // `dimension` each

  size_t control_count() const { return controls.size() / dimension; }
};

// Knots that make pieces of a Bezier curve a B-spline: each break as often as the degree says, the
// first and last once more.
std::vector<double> bezier_knots(size_t degree, const std::vector<double>& breaks);

// Null if the knots are usable, else what is wrong with them.
const char* fault_of_knots(const Spline& spline);

// Where to sample the part from `first` to `last` (clipped to where the spline is defined, which is
// not empty): every knot, and between two knots evenly, denser where knots are few. `control` is
// the control point that the curve passes through there because the knot is as multiple as the
// degree, or k_no_control.
struct SplineSample {
  double parameter;
  uint32_t control;
};
std::vector<SplineSample> spline_samples(const Spline& spline, double first, double last);

void spline_point(const Spline& spline, double parameter, double* point);

}  // namespace wireskin_cli
