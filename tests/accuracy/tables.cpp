// accuracy_tables [OUTPUT.md]: measures every method against surfaces that are known and writes the
// tables that the README quotes. Exit status 1 where a bound does not hold, 2 on a bad argument.
//
// Single tables: accuracy_tables OUTPUT.md closed convergence noise real.
// What the bounds need and nothing more, on standard output: accuracy_tables --bounds.
#include "accuracy/tables.h"

#include <algorithm>
#include <cstring>
#include <set>

namespace {

struct Part {
  const char* name;
  void (*write)(accuracy::Page&, accuracy::Bounds&);
};
const Part k_parts[] = {
    {"closed", accuracy::closed_form_tables},
    {"convergence", accuracy::convergence_table},
    {"noise", accuracy::noise_table},
    {"real", accuracy::real_table},
};

bool is_part(const std::string& word) {
  return std::any_of(std::begin(k_parts), std::end(k_parts),
                     [&](const Part& part) { return word == part.name; });
}

void write_verdict(accuracy::Page& page, const accuracy::Bounds& bounds) {
  page.heading("Bounds");
  page.paragraph(accuracy::text("%zu bounds, %zu broken.", bounds.asked(), bounds.broken().size()));
  for (const std::string& line : bounds.broken()) page.paragraph("- " + line);
}

}  // namespace

int main(int count, char** arguments) {
  for (int i = 1; i < count; ++i) {
    const std::string word = arguments[i];
    const bool known = i > 1 ? is_part(word) : word == "--bounds" || word[0] != '-';
    if (known) continue;
    std::fprintf(stderr, "%s: neither a table nor --bounds\n", arguments[i]);
    return 2;
  }
  const bool bounds_alone = count > 1 && std::strcmp(arguments[1], "--bounds") == 0;
  accuracy::Page page(count > 1 && !bounds_alone ? arguments[1] : nullptr);
  if (page.failed()) {
    std::fprintf(stderr, "%s: cannot be written\n", arguments[1]);
    return 2;
  }
  std::set<std::string> wanted(arguments + (count > 2 ? 2 : count), arguments + count);
  accuracy::Bounds bounds(bounds_alone);
  page.paragraph(
      "# Accuracy\n\nWritten by `accuracy_tables`. RMS and greatest distance are those of the free "
      "vertices to the surface that the curves were taken from, in the units of the surface; "
      "angles "
      "are in degrees, mean / greatest.");
  accuracy::published_table(page);
  for (const Part& part : k_parts) {
    if (wanted.empty() || wanted.count(part.name) != 0) part.write(page, bounds);
  }
  write_verdict(page, bounds);
  return bounds.broken().empty() ? 0 : 1;
}
