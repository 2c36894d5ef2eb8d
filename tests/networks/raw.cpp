#include "raw.h"

#include <cstring>
#include <fstream>
#include <sstream>

namespace raw {

std::vector<wsk_curve> views_of(const Curves& curves) {
  std::vector<wsk_curve> views;
  for (const Curve& curve : curves) {
    wsk_curve view = {};
    view.sample_count = curve.size();
    view.positions = curve.positions.data();
    view.normals = curve.normals.empty() ? nullptr : curve.normals.data();
    view.nodes = curve.nodes.data();
    view.closed = curve.closed;
    view.boundary = curve.boundary;
    views.push_back(view);
  }
  return views;
}

Network connect(const Curves& curves, double snap, wsk_chain chain, bool orient) {
  wsk_connect_options options;
  wsk_connect_options_init(&options, sizeof options);
  options.snap = snap;
  options.chain = chain;
  options.orient = orient;
  wsk_report report;
  wsk_report_init(&report, sizeof report);
  const std::vector<wsk_curve> views = views_of(curves);
  wsk_network* network = nullptr;
  const wsk_status status = wsk_connect(views.data(), views.size(), &options, &network, &report);
  INFO(std::string(report.sentence));
  CHECK(status == WSK_OK);
  return Network(network);
}

wsk_network_view view_of(const Network& network) {
  wsk_network_view view;
  wsk_network_get_view(network.get(), &view, sizeof view);
  return view;
}

Curves read_obj_curves(const std::string& path) {
  std::ifstream file(path);
  REQUIRE(file.good());
  std::vector<double> positions;
  Curves curves;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "v") {
      double p[3];
      words >> p[0] >> p[1] >> p[2];
      positions.insert(positions.end(), p, p + 3);
    } else if (keyword == "l") {
      Curve curve;
      for (uint32_t index; words >> index;) curve.nodes.push_back(index - 1);
      curve.closed = curve.size() > 2 && curve.nodes.front() == curve.nodes.back();
      if (curve.closed) curve.nodes.pop_back();
      for (uint32_t v : curve.nodes) {
        curve.positions.insert(curve.positions.end(), &positions[3 * v], &positions[3 * v] + 3);
      }
      curves.push_back(curve);
    }
  }
  return curves;
}

Curves curves_of(const networks::Network& network) {
  Curves curves;
  for (const auto& given : network.curves) {
    Curve curve;
    curve.closed = given.closed;
    curve.boundary = given.boundary;
    curve.nodes = given.vertices;
    for (uint32_t v : given.vertices) {
      const auto &p = network.positions[v], &n = network.normals[v];
      curve.positions.insert(curve.positions.end(), p.begin(), p.end());
      curve.normals.insert(curve.normals.end(), n.begin(), n.end());
    }
    curves.push_back(curve);
  }
  return curves;
}

bool same_curves(const Curves& curves, const wsk_network_view& view) {
  if (view.curve_count != curves.size()) return false;
  for (size_t c = 0; c < curves.size(); ++c) {
    const wsk_curve& made = view.curves[c];
    const Curve& given = curves[c];
    if (made.sample_count != given.size() || (made.closed != 0) != given.closed) return false;
    const size_t bytes = 3 * sizeof(double) * given.size();
    if (std::memcmp(made.positions, given.positions.data(), bytes) != 0) return false;
    if (given.normals.empty() != (made.normals == nullptr)) return false;
    if (made.normals && std::memcmp(made.normals, given.normals.data(), bytes) != 0) return false;
    if (std::memcmp(made.nodes, given.nodes.data(), sizeof(uint32_t) * given.size()) != 0) {
      return false;
    }
  }
  return true;
}

}  // namespace raw
