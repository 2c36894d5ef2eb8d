#include "io.h"

#include <charconv>
#include <fstream>
#include <locale>
#include <sstream>
#include <stdexcept>

namespace networks {

static void append_number(std::string& text, double value) {
  char digits[32];
  // Adding zero turns -0 into 0.
  const auto end = std::to_chars(digits, digits + sizeof digits, value + 0.0).ptr;
  text.append(digits, end);
}

static void append_point(std::string& text, const Point& p) {
  for (size_t k = 0; k < 3; ++k) {
    if (k != 0) text += ' ';
    append_number(text, p[k]);
  }
}

static void append_indices(std::string& text, const Network::Curve& curve, uint32_t base) {
  const char* separator = "";
  for (uint32_t v : curve.vertices) {
    text += separator + std::to_string(v + base);
    separator = " ";
  }
  if (curve.closed) text += ' ' + std::to_string(curve.vertices.front() + base);
  text += '\n';
}

std::string to_net(const Network& network) {
  std::string text = std::to_string(network.positions.size()) + '\n';
  for (size_t i = 0; i < network.positions.size(); ++i) {
    append_point(text, network.positions[i]);
    text += ' ';
    append_point(text, network.normals[i]);
    text += '\n';
  }
  text += std::to_string(network.curves.size()) + '\n';
  for (const Network::Curve& curve : network.curves) {
    text += curve.boundary ? "1\n" : "0\n";
    append_indices(text, curve, 0);
  }
  return text;
}

std::string to_obj(const Network& network) {
  std::string text;
  for (const Point& p : network.positions) {
    text += "v ";
    append_point(text, p);
    text += '\n';
  }
  for (const Point& n : network.normals) {
    text += "vn ";
    append_point(text, n);
    text += '\n';
  }
  for (size_t k = 0; k < network.curves.size(); ++k) {
    const Network::Curve& curve = network.curves[k];
    text += (curve.boundary ? "g boundary_" : "g curve_") + std::to_string(k) + "\nl ";
    append_indices(text, curve, 1);
  }
  return text;
}

static Network::Curve curve_from(const std::string& line, uint32_t base, size_t vertex_count) {
  std::istringstream words(line);
  words.imbue(std::locale::classic());
  Network::Curve curve;
  for (uint32_t v; words >> v;) {
    if (v - base >= vertex_count) throw std::runtime_error("a curve names no vertex: " + line);
    curve.vertices.push_back(v - base);
  }
  if (curve.vertices.size() < 2) throw std::runtime_error("a curve without two vertices: " + line);
  if (curve.vertices.front() == curve.vertices.back()) {
    curve.closed = true;
    curve.vertices.pop_back();
  }
  return curve;
}

Network from_net(const std::string& text) {
  std::istringstream lines(text);
  lines.imbue(std::locale::classic());
  Network network;
  size_t vertex_count = 0;
  size_t curve_count = 0;
  lines >> vertex_count;
  for (size_t i = 0; i < vertex_count && lines; ++i) {
    Point p, n;
    lines >> p[0] >> p[1] >> p[2] >> n[0] >> n[1] >> n[2];
    network.positions.push_back(p);
    network.normals.push_back(n);
  }
  lines >> curve_count;
  for (size_t k = 0; k < curve_count && lines; ++k) {
    int boundary = 0;
    std::string line;
    lines >> boundary >> std::ws;
    std::getline(lines, line);
    network.curves.push_back(curve_from(line, 0, vertex_count));
    network.curves.back().boundary = boundary != 0;
  }
  if (!lines) throw std::runtime_error("a .net file that is cut off or holds no numbers");
  return network;
}

Network from_obj(const std::string& text) {
  std::istringstream lines(text);
  Network network;
  bool boundary = false;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::string word;
    words >> word;
    if (word == "v" || word == "vn") {
      Point p;
      if (!(words >> p[0] >> p[1] >> p[2])) throw std::runtime_error("a bad line: " + line);
      (word == "v" ? network.positions : network.normals).push_back(p);
    } else if (word == "g") {
      words >> word;
      boundary = word.rfind("boundary", 0) == 0;
    } else if (word == "l") {
      network.curves.push_back(curve_from(line.substr(1), 1, network.positions.size()));
      network.curves.back().boundary = boundary;
    }
  }
  if (network.normals.size() != network.positions.size()) {
    throw std::runtime_error("an OBJ file without a normal for each vertex");
  }
  return network;
}

static bool ends_in_obj(const std::string& path) {
  return path.size() >= 4 && path.compare(path.size() - 4, 4, ".obj") == 0;
}

void write_network(const std::string& path, const Network& network) {
  std::ofstream file(path, std::ios::binary);
  file << (ends_in_obj(path) ? to_obj(network) : to_net(network));
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

Network read_network(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be opened");
  std::ostringstream text;
  text << file.rdbuf();
  return ends_in_obj(path) ? from_obj(text.str()) : from_net(text.str());
}

}  // namespace networks
