// Every network of the data folder becomes what its shape says: Betti numbers, patches, annuli, no
// bare segment, no open patch, no crossing, Euler's relation; turned, in another order, with other
// draws of the jitter.
#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <iostream>

#include "flow/run.h"

using namespace flow_tests;

namespace {

struct Row {
  std::string file, note;
  uint32_t betti[3], patches, annuli;
  int32_t voids;
  bool known, sensitive;
};

std::string data_folder() {
  const char* given = std::getenv("WIRESKIN_TEST_DATA");
  const std::string root = given != nullptr ? given : WIRESKIN_TEST_DATA;
  return root.empty() ? "" : root + "/flow-tests/";
}

// Fields are separated by commas that are not within quotes.
std::vector<std::string> split_fields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

std::vector<Row> read_rows() {
  std::vector<Row> rows;
  std::ifstream in(data_folder() + "expected.csv");
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const std::vector<std::string> f = split_fields(line);
    if (f.size() < 8) continue;
    Row row;
    row.file = f[0];
    row.note = f[7];
    for (size_t k = 0; k < 3; ++k) row.betti[k] = uint32_t(std::atoi(f[k + 1].c_str()));
    row.patches = uint32_t(std::atoi(f[4].c_str()));
    row.annuli = uint32_t(std::atoi(f[5].c_str()));
    row.voids = f[6] == "auto" ? -1 : std::atoi(f[6].c_str());
    row.known = row.note.find("KNOWN") != std::string::npos;
    row.sensitive = row.note.find("SENSITIVE") != std::string::npos;
    rows.push_back(row);
  }
  return rows;
}

bool have_data() {
  if (!data_folder().empty() && !read_rows().empty()) return true;
  std::cout << "skipped: no test data, set WIRESKIN_TEST_DATA\n";
  return false;
}

void check_run(const Row& row, const Run& r) {
  for (int k = 0; k < 3; ++k) CHECK(r.betti[k] == row.betti[k]);
  CHECK(r.patches == row.patches);
  CHECK(r.annuli == row.annuli);
  CHECK(r.bare == 0);
  CHECK(r.open == 0);
  CHECK(r.missing == 0);
  CHECK(r.crossings == 0);
  CHECK(r.euler == 1);
}

}  // namespace

TEST_CASE("Networks of the data folder come out as their shapes say") {
  if (!have_data()) return;
  for (const Row& row : read_rows()) {
    CAPTURE(row.file);
    const Run r = run(read_obj(data_folder() + row.file), {0.02, 0, row.voids, false, true});
    CHECK(r.crossings == 0);
    CHECK(r.euler == 1);
    const Betti own = {r.betti[0], r.betti[1], r.betti[2]};
    CHECK((betti_of(r, r.raw_triangle) == own));
    if (row.known) continue;
    check_run(row, r);
    if (r.triangle.size() < 12000) {
      CHECK((betti_of(r, r.triangle) == own));
      CHECK(count_crossings(r.position, r.triangle) == 0);
    }
    CHECK(count_crossings(r.raw_position, r.raw_triangle) == 0);
  }
}

TEST_CASE("Turned, reordered and with another jitter they come out the same") {
  if (!have_data()) return;
  for (const Row& row : read_rows()) {
    if (row.known) continue;
    CAPTURE(row.file);
    const Net net = read_obj(data_folder() + row.file);
    const RunOptions plain = {0.02, 0, row.voids, false, false};
    for (int turn = 1; turn <= 3; ++turn) {
      CAPTURE(turn);
      check_run(row, run(turned(net, turn), plain));
    }
    check_run(row, run(reordered(net, 5), plain));
    for (uint64_t seed = 7; seed <= 9; ++seed) {
      CAPTURE(seed);
      check_run(row, run(net, {0.02, seed, row.voids, false, false}));
    }
  }
}

TEST_CASE("Twice as fine they come out the same") {
  if (!have_data()) return;
  for (const Row& row : read_rows()) {
    if (row.known || row.sensitive || row.file == "torus_dense.obj") continue;
    CAPTURE(row.file);
    check_run(row, run(read_obj(data_folder() + row.file), {0.01, 0, row.voids, false, false}));
  }
}

TEST_CASE("Areas and ratios are those that can be calculated") {
  if (!have_data()) return;
  const auto result = [](const char* file) { return run(read_obj(data_folder() + file)); };
  CHECK(result("cube.obj").area == doctest::Approx(6.0).epsilon(1e-6));
  CHECK(result("two_cubes.obj").area == doctest::Approx(12.0).epsilon(1e-6));
  CHECK(result("carbox.obj").area == doctest::Approx(10.0).epsilon(1e-6));
  CHECK(result("car_cabin.obj").area == doctest::Approx(15.834354).epsilon(1e-6));
  CHECK(result("cube.obj").ratio == doctest::Approx(std::sqrt(2.0)).epsilon(0.005));
  CHECK(result("tetra.obj").ratio == doctest::Approx(1.22474).epsilon(0.005));
  CHECK(result("coax_short.obj").ratio == doctest::Approx(1.0198).epsilon(0.005));
  CHECK(result("coax_mid.obj").ratio == doctest::Approx(1.1662).epsilon(0.005));
}
