#include "arguments.h"

#include <cmath>
#include <filesystem>

#include "failure.h"
#include "files.h"
#include "scan.h"

namespace wireskin_cli {

namespace {

// In the order of the numbers of wsk_method.
constexpr const char* k_method_names[WSK_METHOD_COUNT] = {"stanko",  "biharmonic", "triharmonic",
                                                          "clamped", "iterated",   "fair"};

constexpr const char* k_help = R"(wireskin - a smooth surface through a network of curves

usage: wireskin [options] INPUT -o OUTPUT

INPUT is a network of curves, "-" for the standard input:
  .net      the number of vertices, a row x y z nx ny nz for each, the number of curves, and for
            each curve a line 0 or 1 (1: boundary) and a line of vertex indices from 0
  .obj      v, and vn for each v in the same order; l, each of which is one curve with any number
            of indices; curv, B-splines and Bezier curves of any degree, rational or not. Without
            any of these f with more than three corners are loops. Curves after a g or o whose name
            contains "boundary" (in upper or lower case), up to the next g or o, are boundary
            curves; "sharp" makes them creases, smooth on each side only. A vertex has one vn,
            creases have two normals: theirs are taken as unknown, and vn holds for the smooth
            curves that end there.
  .ply      text or binary: vertices with x y z nx ny nz, the element edge with vertex1, vertex2
            (and maybe boundary, sharp), or else faces as loops
  .csv .tsv .txt .dat .asc
            a row x y z or x y z nx ny nz for each sample, maybe followed by a number of the curve,
            or columns named in the first line: x y z nx ny nz curve boundary sharp. Columns stand
            between semicolons, tabs, commas or blanks; with the first two a comma may be the
            decimal point. Without a column "curve", blank lines or lines "CURVE name" separate
            curves. Samples whose coordinates are all equal are one point.
  .curves .curve .contour .curf
            polylines of CASSIE, of cycle discovery, of contours in planes, with tangents
  .rawnet   tangents measured along curves, as Stanko's sensors give them: positions are integrated
  .xyz      points, x y z or x y z nx ny nz; alone they span no surface
What a file is, is seen from its content where the extension cannot be true.
Curves meet where they share a vertex. A curve is closed if its last vertex repeats its first.
Boundary curves are those where the surface ends. Normals point to the outer side; where there are
none the curves alone give the surface (--topology flow).

OUTPUT is the surface; -o may be repeated:
  .obj   positions, normals, a group patch_K for each patch
  .ply   binary: positions, normals, mean curvature, the patch of each triangle
  .stl   binary: triangles

options:
  -o OUTPUT          where to write the surface
  --spacing LENGTH   distance of vertices along the curves, in the units of the input
                     (default: a hundredth of the diagonal of the bounding box)
  --method NAME      fair (default): mean curvature as smooth as can be, the normals kept
                     stanko: mean curvature follows the normals spread from the curves
                     iterated: the same, repeated on the surface itself
                     biharmonic, triharmonic: least square Laplacian, which lets the normals
                     order the curves but not shape the surface
                     clamped: biharmonic with curvature prescribed on the curves
  --smooth auto|0|SIGMA
                     noise of the samples: found and taken out (auto, the default of fair and of
                     --topology flow; samples without noise stay as they are), none, so that curves
                     are interpolated (0, the default of all other methods), or its standard
                     deviation in the units of the input
  --soft LENGTH      curves pull instead of holding: details of a curve shorter than LENGTH are
                     smoothed away
  --snap LENGTH|auto|off
                     curves that miss each other by no more than LENGTH are joined; auto (default)
                     takes the median distance of neighbouring samples, at most a hundredth of
                     the diagonal. What is connected stays as it is; the report lists every joint
  --orient           the signs of the normals are not to be trusted: make them agree
  --topology auto|normals|flow
                     how patches are found: from the order of the normals round each node
                     (normals), or from the curves alone, as the surface that they cage (flow);
                     auto takes flow where curves have no normals. With flow, normals shape the
                     surface where it is a manifold; without them it is left as remeshed
  --voids N          with flow: the number of voids to enclose (default: those that stand out)
  --open-walls       with flow: keep walls that end at other walls instead of at curves
  --partial          leave out patches that cannot be made, instead of failing; the report lists
                     them
  --report FILE      write a report in JSON: status, counts, quality, memory, times; it is
                     written too, with the place of the fault, if the input cannot be read or no
                     surface can be built from it
  --image FILE.png   write a shaded picture with isophote stripes and the curves
  --html FILE.html   write a page that shows the result in any browser: to be turned, lit, measured
  --curves           write the curves too: as l in .obj, as the element edge in .ply
  --up x|y|z         the axis that points up in picture and page (default: z)
  --quiet            no progress, no summary
  --help             print this
  --version          print the version

Errors are one line, "FILE:LINE: what is wrong" or "FILE: curve 3, sample 17: what is wrong".
Curves, samples, nodes and patches are numbered from 0 in messages and reports, lines from 1; a
node's number is the index of its vertex, from 0. Output files are complete or absent.

exit status: 0 done, 1 the files or the network are at fault, 2 wrong usage
)";

[[noreturn]] void wrong_usage(const std::string& what) {
  throw Failure("wireskin: " + what + " (see wireskin --help)", 2);
}

wsk_method method_of(const std::string& name) {
  std::string known;
  for (wsk_method method = 0; method < WSK_METHOD_COUNT; ++method) {
    if (name == k_method_names[method]) return method;
    known += (method == 0 ? "" : ", ") + std::string(k_method_names[method]);
  }
  wrong_usage("unknown method " + in_quotes(name) + ", known are " + known);
}

double length_of(const std::string& option, const std::string& text) {
  double length = 0.0;
  if (!parse_double(text, &length) || !(length > 0.0) || !std::isfinite(length)) {
    wrong_usage(option + " needs a length above zero, not " + in_quotes(text));
  }
  return length;
}

// auto, 0, or the standard deviation of the noise.
void read_smoothing(const std::string& text, Arguments* arguments) {
  arguments->smoothing = WSK_SMOOTHING_GIVEN;
  if (text == "auto") {
    arguments->smoothing = WSK_SMOOTHING_AUTO;
  } else if (!parse_double(text, &arguments->noise) || !(arguments->noise >= 0.0) ||
             !std::isfinite(arguments->noise)) {
    wrong_usage("--smooth needs auto, 0 or a length, not " + in_quotes(text));
  } else if (arguments->noise == 0.0) {
    arguments->smoothing = WSK_SMOOTHING_NONE;
  }
}

// auto, off, or a length.
double snap_of(const std::string& text) {
  if (text == "auto") return 0.0;
  if (text == "off") return -1.0;
  return length_of("--snap", text);
}

int axis_of(const std::string& name) {
  const std::string axes = "xyz";
  const size_t axis = name.size() == 1 ? axes.find(name) : std::string::npos;
  if (axis == std::string::npos) wrong_usage("--up needs x, y or z, not " + in_quotes(name));
  return static_cast<int>(axis);
}

TopologyChoice topology_of(const std::string& name) {
  if (name == "auto") return TopologyChoice::automatic;
  if (name == "normals") return TopologyChoice::normals;
  if (name == "flow") return TopologyChoice::flow;
  wrong_usage("--topology needs auto, normals or flow, not " + in_quotes(name));
}

int voids_of(const std::string& text) {
  int64_t voids = 0;
  if (!parse_integer(text, &voids) || voids < 0 || voids > 1000000) {
    wrong_usage("--voids needs a number from 0, not " + in_quotes(text));
  }
  return static_cast<int>(voids);
}

// Splits "--name=value"; takes the value from the next word otherwise.
class Words {
 public:
  explicit Words(const std::vector<std::string>& words) : words_(words) {}

  bool next() {
    if (at_ == words_.size()) return false;
    word_ = words_[at_++];
    name_ = word_;
    const size_t equals = name_.compare(0, 2, "--") == 0 ? name_.find('=') : std::string::npos;
    has_value_ = equals != std::string::npos;
    if (has_value_) {
      value_ = name_.substr(equals + 1);
      name_.resize(equals);
    }
    return true;
  }
  const std::string& word() const { return word_; }
  bool is(const char* name) const { return name_ == name; }
  bool is_flag(const char* name) const {
    if (!is(name)) return false;
    if (has_value_) wrong_usage(name_ + " takes no value");
    return true;
  }
  std::string value() {
    if (!has_value_) {
      if (at_ == words_.size()) wrong_usage(name_ + " needs a value");
      value_ = words_[at_++];
    }
    if (value_.empty()) wrong_usage(name_ + " needs a value");
    return value_;
  }

 private:
  const std::vector<std::string>& words_;
  size_t at_ = 0;
  std::string word_;
  std::string name_;
  std::string value_;
  bool has_value_ = false;
};

void take_input(const std::string& word, Arguments& arguments) {
  if (word.empty()) wrong_usage("the name of the input is empty");
  if (!arguments.input.empty()) wrong_usage("more than one input: " + in_quotes(word));
  arguments.input = word;
}

// True if the word was an option.
bool take_option(Words& words, Arguments& arguments) {
  if (words.is_flag("--help") || words.is_flag("-h")) {
    arguments.help = true;
  } else if (words.is_flag("--version")) {
    arguments.version = true;
  } else if (words.is_flag("--quiet")) {
    arguments.quiet = true;
  } else if (words.is_flag("--curves")) {
    arguments.curves = true;
  } else if (words.is_flag("--partial")) {
    arguments.partial = true;
  } else if (words.is("-o")) {
    arguments.outputs.push_back(words.value());
  } else if (words.is("--spacing")) {
    arguments.spacing = length_of("--spacing", words.value());
  } else if (words.is("--smooth")) {
    read_smoothing(words.value(), &arguments);
  } else if (words.is("--soft")) {
    const std::string text = words.value();
    arguments.soft = text == "0" ? 0.0 : length_of("--soft", text);
  } else if (words.is("--snap")) {
    arguments.snap = snap_of(words.value());
  } else if (words.is_flag("--orient")) {
    arguments.orient = true;
  } else if (words.is("--method")) {
    arguments.method = method_of(words.value());
  } else if (words.is("--up")) {
    arguments.up_axis = axis_of(words.value());
  } else if (words.is("--topology")) {
    arguments.topology = topology_of(words.value());
  } else if (words.is("--voids")) {
    arguments.voids = voids_of(words.value());
  } else if (words.is_flag("--open-walls")) {
    arguments.open_walls = true;
  } else if (words.is("--report")) {
    arguments.report = words.value();
  } else if (words.is("--image")) {
    arguments.image = words.value();
  } else if (words.is("--html")) {
    arguments.html = words.value();
  } else {
    return false;
  }
  return true;
}

bool same_file(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error) return true;
  return fs::path(a).lexically_normal() == fs::path(b).lexically_normal();
}

void check_files(const Arguments& arguments) {
  if (arguments.input.empty()) wrong_usage("no input file");
  if (arguments.outputs.empty()) wrong_usage("no output file, give one with -o");
  bool holds_curves = false;
  for (const std::string& output : arguments.outputs) {
    const std::string extension = extension_of(output);
    if (extension != ".obj" && extension != ".ply" && extension != ".stl") {
      wrong_usage("unknown output format " + in_quotes(extension) +
                  ", known are .obj, .ply and .stl");
    }
    holds_curves = holds_curves || extension != ".stl";
  }
  if (arguments.curves && !holds_curves) {
    wrong_usage("--curves needs .obj or .ply, an STL file holds triangles only");
  }
  if (!arguments.image.empty() && extension_of(arguments.image) != ".png") {
    wrong_usage("--image writes PNG, the name must end in .png");
  }
  if (!arguments.html.empty() && extension_of(arguments.html) != ".html") {
    wrong_usage("--html writes a page, the name must end in .html");
  }
  std::vector<std::string> files = {arguments.input, arguments.report, arguments.image,
                                    arguments.html};
  files.insert(files.end(), arguments.outputs.begin(), arguments.outputs.end());
  for (size_t i = 0; i < files.size(); ++i) {
    for (size_t k = i + 1; k < files.size(); ++k) {
      if (files[i].empty() || files[k].empty() || !same_file(files[i], files[k])) continue;
      wrong_usage("two of the files are the same: " + in_quotes(files[k]));
    }
  }
}

}  // namespace

Arguments parse_arguments(const std::vector<std::string>& list) {
  Arguments arguments;
  Words words(list);
  bool options_end = false;
  while (words.next()) {
    if (options_end) {
      take_input(words.word(), arguments);
    } else if (words.is("--")) {
      options_end = true;
    } else if (!take_option(words, arguments)) {
      const bool dashed = words.word().size() > 1 && words.word()[0] == '-';
      if (dashed) wrong_usage("unknown option " + in_quotes(words.word()));
      take_input(words.word(), arguments);
    }
    if (arguments.help || arguments.version) return arguments;
  }
  check_files(arguments);
  return arguments;
}

const char* help_text() {
  return k_help;
}

const char* method_name(wsk_method method) {
  return k_method_names[method];
}

}  // namespace wireskin_cli
