#include "rig.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace bench {

static constexpr int64_t k_magic = 0x31435343;

template <typename T>
static void read_numbers(std::ifstream& file, T* to, size_t count) {
  file.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(count * sizeof(T)));
  if (!file) throw std::runtime_error("a file of the rig is too short");
}

static std::ifstream open_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  return file;
}

template <typename T>
static std::vector<T> read_vector(const std::string& path) {
  std::ifstream file = open_file(path);
  int64_t count = 0;
  read_numbers(file, &count, 1);
  std::vector<T> values(static_cast<size_t>(count));
  read_numbers(file, values.data(), values.size());
  return values;
}

static void must(const wireskin::Status& status) {
  if (!status.ok()) throw std::runtime_error(status.sentence);
}

void read_matrix(const std::string& prefix, const std::string& which, RigMatrix* matrix) {
  std::ifstream file = open_file(prefix + "." + which + ".csc");
  int64_t header[4];
  read_numbers(file, header, 4);
  if (header[0] != k_magic) throw std::runtime_error("not a matrix of the rig: " + prefix);
  wireskin::sparse::Csc& a = matrix->lower;
  a.rows = static_cast<uint32_t>(header[1]);
  a.cols = static_cast<uint32_t>(header[2]);
  must(a.start.resize(size_t{a.cols} + 1));
  must(a.row.resize(static_cast<size_t>(header[3])));
  must(a.value.resize(static_cast<size_t>(header[3])));
  read_numbers(file, a.start.data(), a.start.size());
  read_numbers(file, a.row.data(), a.row.size());
  read_numbers(file, a.value.data(), a.value.size());
  const std::vector<double> xy = read_vector<double>(prefix + ".xy.vec");
  for (size_t i = 0; i + 1 < xy.size(); i += 2) {
    matrix->position.push_back({xy[i], xy[i + 1], 0.0});
  }
  for (const int32_t p : read_vector<int32_t>(prefix + ".patch.vec")) {
    matrix->patch.push_back(static_cast<uint32_t>(p));
  }
}

template <typename T>
static void write_vector(const std::vector<T>& values, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  const int64_t count = static_cast<int64_t>(values.size());
  file.write(reinterpret_cast<const char*>(&count), sizeof count);
  file.write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(T)));
  if (!file) throw std::runtime_error("cannot write " + path);
}

void write_matrix(const wireskin::sparse::Csc& a, const Places& places, const std::string& prefix) {
  std::vector<double> xy;
  for (const wireskin::Vec3& p : places.position) xy.insert(xy.end(), {p.x, p.y});
  write_vector(xy, prefix + ".xy.vec");
  write_vector(places.patch, prefix + ".patch.vec");
  const std::string path = prefix + ".K.csc";
  std::ofstream file(path, std::ios::binary);
  const int64_t header[4] = {k_magic, a.rows, a.cols, static_cast<int64_t>(a.row.size())};
  const auto write = [&](const void* from, size_t bytes) {
    file.write(static_cast<const char*>(from), static_cast<std::streamsize>(bytes));
  };
  write(header, sizeof header);
  write(a.start.data(), a.start.size() * sizeof(uint32_t));
  write(a.row.data(), a.row.size() * sizeof(uint32_t));
  write(a.value.data(), a.value.size() * sizeof(double));
  if (!file) throw std::runtime_error("cannot write " + path);
}

static double number_after(const std::string& line, const std::string& key) {
  const size_t at = line.find("\"" + key + "\":");
  return at == std::string::npos ? -1.0 : std::atof(line.c_str() + at + key.size() + 3);
}

PeerTimes run_peer(const std::string& folder, const std::string& prefix, const std::string& which,
                   const std::string& method) {
  const std::string command = "OMP_THREAD_LIMIT=1 OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 '" +
                              folder + "/spsolve' '" + prefix + "' " + which + " " + method +
                              " 9 3";
  PeerTimes times;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return times;
  std::string line;
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) line += static_cast<char>(c);
  if (pclose(pipe) != 0 || line.empty()) return times;
  times.analyse = 1e3 * number_after(line, "analyse_s");
  times.factor = 1e3 * number_after(line, "factor_s");
  times.solve = 1e3 * number_after(line, "solve9_s");
  times.refactor = 1e3 * number_after(line, "refactor_s");
  times.nonzeros = number_after(line, "nnzL");
  times.residual = number_after(line, "relres");
  return times;
}

}  // namespace bench
