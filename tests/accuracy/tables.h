// The tables of accuracy, one function each, and the bounds that they are held to.
#pragma once

#include <string>
#include <vector>

#include "accuracy/markdown.h"
#include "accuracy/measure.h"

namespace accuracy {

// What was asked for and not reached; the tables say it at the end.
class Bounds {
 public:
  explicit Bounds(bool alone) : alone_(alone) {}

  // Rows that no bound refers to are left out.
  bool alone() const { return alone_; }
  void at_most(const std::string& what, double value, double bound) {
    ++asked_;
    if (!(value <= bound)) broken_.push_back(what + text(": %.3g, bound %.3g", value, bound));
  }
  void built(const std::string& what, const Result& result) {
    ++asked_;
    if (result.status == WSK_OK) return;
    broken_.push_back(what + ": " + wsk_status_name(result.status) + ", " + result.report.sentence);
  }
  size_t asked() const { return asked_; }
  const std::vector<std::string>& broken() const { return broken_; }

 private:
  bool alone_;
  size_t asked_ = 0;
  std::vector<std::string> broken_;
};

struct Method {
  wsk_method method;
  const char* name;
};
inline const Method k_methods[] = {
    {WSK_METHOD_BIHARMONIC, "biharmonic"}, {WSK_METHOD_TRIHARMONIC, "triharmonic"},
    {WSK_METHOD_CLAMPED, "clamped"},       {WSK_METHOD_STANKO, "stanko"},
    {WSK_METHOD_ITERATED, "iterated"},     {WSK_METHOD_FAIR, "fair"},
};

void published_table(Page& page);
void closed_form_tables(Page& page, Bounds& bounds);
void convergence_table(Page& page, Bounds& bounds);
void noise_table(Page& page, Bounds& bounds);
void real_table(Page& page, Bounds& bounds);

}  // namespace accuracy
