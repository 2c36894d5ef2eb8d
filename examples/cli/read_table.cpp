// Tables: a row a sample, columns between commas, semicolons, tabs or blanks.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "read_network.h"
#include "scan.h"

namespace wireskin_cli {

namespace {

enum TableColumn { k_x, k_y, k_z, k_nx, k_ny, k_nz, k_curve, k_boundary, k_sharp, k_column_count };
constexpr size_t k_absent = ~size_t{0};

struct TableLayout {
  char separator = ' ';  // ' ' stands for any run of blanks
  bool known = false;
  size_t place[k_column_count];
  size_t columns = 0;  // the least that a row must have

  TableLayout() { std::fill_n(place, size_t{k_column_count}, k_absent); }
  bool has(TableColumn column) const { return place[column] != k_absent; }
};

std::string_view trimmed(std::string_view cell) {
  const size_t first = cell.find_first_not_of(" \t\f\v");
  if (first == std::string_view::npos) return {};
  cell = cell.substr(first, cell.find_last_not_of(" \t\f\v") + 1 - first);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
    cell = cell.substr(1, cell.size() - 2);
  }
  return cell;
}

char separator_of(std::string_view line) {
  for (const char separator : {';', '\t', ','}) {
    if (line.find(separator) != std::string_view::npos) return separator;
  }
  return ' ';
}

std::vector<std::string_view> cells_of(const LineScanner& scanner, char separator) {
  if (separator == ' ') return scanner.columns();
  std::vector<std::string_view> cells;
  std::string_view rest = scanner.text();
  // Tables of blanks and tabs mixed: a row without a tab has its columns between blanks.
  if (separator == '\t' && trimmed(rest).find('\t') == std::string_view::npos) {
    return scanner.columns();
  }
  for (size_t end = 0; end != std::string_view::npos;) {
    end = rest.find(separator);
    cells.push_back(trimmed(rest.substr(0, end)));
    if (end != std::string_view::npos) rest.remove_prefix(end + 1);
  }
  return cells;
}

// Those that tell how many columns the table has: a separator at the end of a row ends its last
// cell.
std::vector<std::string_view> counted_cells(const LineScanner& scanner, char separator) {
  std::vector<std::string_view> cells = cells_of(scanner, separator);
  if (cells.size() > 1 && cells.back().empty()) cells.pop_back();
  return cells;
}

// "Normal X [mm]" and "normal_x" are "normalx".
std::string plain_name(std::string_view cell) {
  std::string name;
  for (const char c : lower_case(cell.substr(0, cell.find_first_of("[(")))) {
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) name += c;
  }
  return name;
}

size_t column_named(std::string_view cell) {
  constexpr const char* k_names[k_column_count] = {
      " x px posx positionx pointsx points0 pointx xcoordinate coordx ",
      " y py posy positiony pointsy points1 pointy ycoordinate coordy ",
      " z pz posz positionz pointsz points2 pointz zcoordinate coordz ",
      " nx normalx normalsx normals0 xnormal ",
      " ny normaly normalsy normals1 ynormal ",
      " nz normalz normalsz normals2 znormal ",
      " curve curveid polyline polylineid stroke strokeid line lineid kurve courbe ",
      " boundary isboundary ",
      " sharp issharp crease ",
  };
  const std::string name = " " + plain_name(cell) + " ";
  if (name == "  ") return k_column_count;
  size_t column = 0;
  while (column < k_column_count &&
         std::string_view(k_names[column]).find(name) == std::string_view::npos) {
    ++column;
  }
  return column;
}

bool cell_number(std::string_view cell, char separator, double* value) {
  if (parse_double(cell, value)) return true;
  const size_t comma = cell.find(',');
  if (separator == ',' || comma == std::string_view::npos) return false;
  // A decimal comma, as spreadsheets write it under many locales.
  std::string with_point(cell);
  with_point[comma] = '.';
  return parse_double(with_point, value);
}

void take_header(const LineScanner& scanner, const std::vector<std::string_view>& cells,
                 TableLayout& layout, std::vector<std::string>& ignored) {
  for (size_t i = 0; i < cells.size(); ++i) {
    const size_t column = column_named(cells[i]);
    if (column == k_column_count) {
      ignored.emplace_back(cells[i]);
      continue;
    }
    if (layout.place[column] != k_absent) {
      scanner.fail("two columns of the header mean the same, the second is " + in_quotes(cells[i]));
    }
    layout.place[column] = i;
  }
  if (!layout.has(k_x) || !layout.has(k_y) || !layout.has(k_z)) {
    scanner.fail("the first line is neither numbers nor a header that names x, y and z: " +
                 in_quotes(trimmed(scanner.text())));
  }
  const bool some = layout.has(k_nx) || layout.has(k_ny) || layout.has(k_nz);
  if (some && !(layout.has(k_nx) && layout.has(k_ny) && layout.has(k_nz))) {
    scanner.fail("the header names some of nx, ny and nz, but not all");
  }
  // Of the tags alone a row may say nothing: one cut off before must not become a curve of its own.
  for (const TableColumn column : {k_x, k_y, k_z, k_nx, k_ny, k_nz, k_curve}) {
    if (layout.has(column)) layout.columns = std::max(layout.columns, layout.place[column] + 1);
  }
}

// How a column would do as the number of the curve: a name or a whole number in every row, the same
// ones again and again.
class CurveColumn {
 public:
  void take(std::string_view cell, char separator) {
    double value = 0.0;
    whole_ = whole_ && (!cell_number(cell, separator, &value) || value == std::floor(value));
    changes_ += rows_ > 0 && cell != last_;
    names_.insert(std::string(cell));
    last_ = cell;
    ++rows_;
  }
  bool whole() const { return whole_; }
  size_t names() const { return names_.size(); }
  bool repeats() const { return whole_ && names_.size() < rows_; }
  // The rows of each curve stand together.
  bool in_runs() const { return repeats() && changes_ + 1 == names_.size(); }

 private:
  bool whole_ = true;
  size_t rows_ = 0, changes_ = 0;
  std::set<std::string> names_;
  std::string last_;
};

// Which of `count` columns holds the number of the curve where no header says so: the last, or the
// first where the last does not look like one.
size_t curve_column(const LineScanner& at_first_row, std::string_view text, char separator,
                    size_t count) {
  CurveColumn first, last;
  LineScanner scanner(at_first_row.file(), text, false);
  while (scanner.next('#')) {
    const std::vector<std::string_view> cells = counted_cells(scanner, separator);
    if (cells.size() < count) continue;  // titles, empty rows, or a fault that is found later
    first.take(cells[0], separator);
    last.take(cells[count - 1], separator);
  }
  // A last column that is all one number may as well be the z of curves in a plane.
  const bool flat = last.names() == 1 && first.names() > 1 && first.in_runs();
  if (last.whole() && !flat) return count - 1;
  if (first.repeats()) return 0;
  at_first_row.fail(std::to_string(count) +
                    " columns without a header, neither the first nor the "
                    "last of which numbers the curves: a first line with names, as x,y,z,curve, "
                    "tells what they are");
}

// Without a header: x y z or x y z nx ny nz, and a number of the curve behind or in front of them.
void take_count(const LineScanner& scanner, std::string_view text, size_t count,
                TableLayout& layout) {
  if (count != 3 && count != 4 && count != 6 && count != 7) {
    scanner.fail(std::to_string(count) +
                 " columns where 3 (x y z), 6 (x y z nx ny nz) or one more (a number of the curve) "
                 "are needed; a first line with names can say otherwise");
  }
  const bool numbered = count == 4 || count == 7;
  if (numbered) layout.place[k_curve] = curve_column(scanner, text, layout.separator, count);
  const size_t skipped = numbered && layout.place[k_curve] == 0 ? 1 : 0;
  for (size_t k = 0; k < (count >= 6 ? 6u : 3u); ++k) layout.place[k] = skipped + k;
  layout.columns = count;
}

// True if the line was a header.
bool take_layout(const LineScanner& scanner, std::string_view text, TableLayout& layout,
                 std::vector<std::string>& ignored) {
  layout.known = true;
  layout.separator = separator_of(trimmed(scanner.text()));
  const std::vector<std::string_view> cells = counted_cells(scanner, layout.separator);
  double number = 0.0;
  const bool header = std::none_of(cells.begin(), cells.end(), [&](std::string_view cell) {
    return cell_number(cell, layout.separator, &number);
  });
  if (header) {
    take_header(scanner, cells, layout, ignored);
  } else {
    take_count(scanner, text, cells.size(), layout);
  }
  return header;
}

class TableReader {
 public:
  TableReader(const std::string& file, std::string_view text)
      : text_(text), scanner_(file, text, false) {}

  Network read(bool as_points) {
    while (scanner_.next('#')) {
      if (take_title()) continue;
      if (!layout_.known && take_layout(scanner_, text_, layout_, network_.ignored_columns))
        continue;
      take_row();
    }
    if (network_.positions.empty()) {
      throw ReadFailure(k_malformed, scanner_.file(), 0, "no row of numbers in this file");
    }
    drop_useless_normals();
    if (as_points) {
      network_.curves.clear();
      for (uint32_t v = 0; v < network_.vertex_count(); ++v) network_.points.push_back(v);
    } else {
      identify_equal_positions(network_);
    }
    return std::move(network_);
  }

 private:
  // "CURVE 3" before the rows of a curve.
  bool take_title() {
    const std::vector<std::string_view>& columns = scanner_.columns();
    if (columns.size() > 2 || lower_case(columns[0]) != "curve") return false;
    begin_curve(std::string(columns.size() == 2 ? columns[1] : ""));
    return true;
  }

  void begin_curve(std::string name) {
    NetworkCurve curve;
    curve.line = scanner_.line();
    curve.name = std::move(name);
    network_.curves.push_back(std::move(curve));
    begun_ = true;
  }

  double number(std::string_view cell) const {
    double value = 0.0;
    if (cell_number(cell, layout_.separator, &value)) return value;
    const char* what = cell.empty()         ? "an empty cell where a number is needed"
                       : is_too_large(cell) ? " is too large a number"
                                            : " is not a number";
    if (cell.empty()) scanner_.fail(what);
    const bool blanks = layout_.separator == ',' && cell.find(' ') != std::string_view::npos;
    scanner_.fail(in_quotes(cell) + what +
                  (blanks ? " (decimal commas need semicolons or tabs between the columns)" : ""));
  }

  void take_row() {
    const std::vector<std::string_view> cells = cells_of(scanner_, layout_.separator);
    // How spreadsheets write an empty line.
    after_empty_row_ = after_empty_row_ || scanner_.after_blank();
    if (std::all_of(cells.begin(), cells.end(), [](std::string_view c) { return c.empty(); })) {
      after_empty_row_ = true;
      return;
    }
    if (cells.size() < layout_.columns) {
      scanner_.fail(std::to_string(cells.size()) + " columns where " +
                    std::to_string(layout_.columns) + " are needed");
    }
    const auto cell = [&](TableColumn column) {
      const size_t place = layout_.place[column];
      return place < cells.size() ? cells[place] : std::string_view();
    };
    const uint32_t vertex = static_cast<uint32_t>(network_.vertex_count());
    for (const TableColumn column : {k_x, k_y, k_z}) {
      network_.positions.push_back(number(cell(column)));
    }
    take_normal({cell(k_nx), cell(k_ny), cell(k_nz)});
    network_.vertex_lines.push_back(scanner_.line());
    NetworkCurve& curve = curve_of_row(cell(k_curve));
    if (curve.vertices.empty()) {
      curve.line = scanner_.line();
      curve.boundary = flag(cell(k_boundary));
      curve.sharp = flag(cell(k_sharp));
    }
    curve.vertices.push_back(vertex);
    after_empty_row_ = false;
  }

  // Three empty cells, or three "nan", say that the normal is not known here.
  void take_normal(const std::vector<std::string_view>& cells) {
    const bool missing = std::all_of(cells.begin(), cells.end(), [](std::string_view cell) {
      return cell.empty() || lower_case(cell) == "nan";
    });
    for (const std::string_view cell : cells) {
      network_.normals.push_back(missing ? 0.0 : number(cell));
    }
    network_.has_normal.push_back(missing ? 0 : 1);
  }

  bool flag(std::string_view cell) const {
    const std::string text = lower_case(cell);
    if (text.empty() || text == "0" || text == "false" || text == "no") return false;
    if (text == "1" || text == "true" || text == "yes") return true;
    scanner_.fail(in_quotes(cell) + " is not 0 or 1");
  }

  // Rows of the same curve column belong together; without one, rows between blank lines.
  NetworkCurve& curve_of_row(std::string_view id) {
    if (!layout_.has(k_curve)) {
      if (!begun_ || (after_empty_row_ && !network_.curves.back().vertices.empty())) {
        begin_curve("");
      }
      return network_.curves.back();
    }
    if (id.empty()) scanner_.fail("the cell that says which curve this row is of is empty");
    const auto found = curve_of_id_.emplace(std::string(id), network_.curves.size());
    if (found.second) begin_curve(std::string(id));
    return network_.curves[found.first->second];
  }

  void drop_useless_normals() {
    std::vector<uint8_t>& known = network_.has_normal;
    if (std::count(known.begin(), known.end(), uint8_t{0}) == 0) known.clear();
    if (std::count(known.begin(), known.end(), uint8_t{1}) != 0 || known.empty()) return;
    known.clear();
    network_.normals.clear();
  }

  std::string_view text_;
  LineScanner scanner_;
  TableLayout layout_;
  Network network_;
  std::map<std::string, size_t> curve_of_id_;
  bool begun_ = false;
  bool after_empty_row_ = false;
};

}  // namespace

Network read_table(const std::string& file, std::string_view text) {
  return TableReader(file, text).read(false);
}

Network read_points(const std::string& file, std::string_view text) {
  return TableReader(file, text).read(true);
}

}  // namespace wireskin_cli
