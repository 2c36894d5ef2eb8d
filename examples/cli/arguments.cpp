#include "arguments.h"

#include <algorithm>
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

// auto, off, or a length; nothing is nearer than 0.
double snap_of(const std::string& text) {
  double length = 0.0;
  if (text == "auto") return 0.0;
  if (text == "off" || (parse_double(text, &length) && length == 0.0)) return -1.0;
  if (!parse_double(text, &length) || !(length > 0.0) || !std::isfinite(length)) {
    wrong_usage("--snap needs a length, auto or off, not " + in_quotes(text));
  }
  return length;
}

// 0 or a length.
double soft_of(const std::string& text) {
  double length = 0.0;
  if (parse_double(text, &length) && length == 0.0) return 0.0;
  return length_of("--soft", text);
}

std::string format_of_standard_output(const std::string& name) {
  if (name == "obj" || name == "ply" || name == "stl") return "." + name;
  wrong_usage("--format needs obj, ply or stl, not " + in_quotes(name));
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
    wrong_usage("--voids needs a whole number from 0 to 1000000, not " + in_quotes(text));
  }
  return static_cast<int>(voids);
}

int lids_of(const std::string& name) {
  if (name == "auto") return WSK_LIDS_SINGLE;
  if (name == "all") return WSK_LIDS_ALL;
  if (name == "none") return WSK_LIDS_NONE;
  wrong_usage("--lids needs auto, all or none, not " + in_quotes(name));
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
  const std::string& name() const { return name_; }
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
  } else if (words.is_flag("--find-borders")) {
    arguments.find_borders = true;
  } else if (words.is("-o")) {
    arguments.outputs.push_back(words.value());
  } else if (words.is("--spacing")) {
    arguments.spacing = length_of("--spacing", words.value());
  } else if (words.is("--smooth")) {
    read_smoothing(words.value(), &arguments);
  } else if (words.is("--soft")) {
    arguments.soft = soft_of(words.value());
  } else if (words.is("--format")) {
    arguments.output_format = format_of_standard_output(words.value());
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
  } else if (words.is("--lids")) {
    arguments.lids = lids_of(words.value());
  } else if (words.is("--report")) {
    arguments.report = words.value();
  } else if (words.is("--image")) {
    arguments.image = words.value();
  } else if (words.is("--html")) {
    arguments.html = words.value();
  } else {
    return false;
  }
  arguments.given.push_back(words.name());
  return true;
}

bool same_file(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error) return true;
  return fs::path(a).lexically_normal() == fs::path(b).lexically_normal();
}

// "-" has no extension: its format is given apart.
void check_formats(const Arguments& arguments) {
  bool holds_curves = false;
  for (const std::string& output : arguments.outputs) {
    const std::string extension = output == "-" ? arguments.output_format : extension_of(output);
    if (extension != ".obj" && extension != ".ply" && extension != ".stl") {
      wrong_usage("unknown output format " + in_quotes(extension) +
                  ", known are .obj, .ply and .stl");
    }
    holds_curves = holds_curves || extension != ".stl";
  }
  if (arguments.curves && !holds_curves) {
    wrong_usage("--curves needs .obj or .ply, an STL file holds triangles only");
  }
  const auto fits = [](const std::string& file, const char* extension) {
    return file.empty() || file == "-" || extension_of(file) == extension;
  };
  if (!fits(arguments.image, ".png")) {
    wrong_usage("--image writes PNG, the name must end in .png");
  }
  if (!fits(arguments.html, ".html")) {
    wrong_usage("--html writes a page, the name must end in .html");
  }
}

void check_files(const Arguments& arguments) {
  if (arguments.input.empty()) wrong_usage("no input file");
  if (arguments.outputs.empty()) wrong_usage("no output file, give one with -o");
  check_formats(arguments);
  std::vector<std::string> files = {arguments.report, arguments.image, arguments.html};
  files.insert(files.end(), arguments.outputs.begin(), arguments.outputs.end());
  if (std::count(files.begin(), files.end(), "-") > 1) {
    wrong_usage("only one of the results can go to the standard output");
  }
  if (arguments.input != "-") files.push_back(arguments.input);
  for (size_t i = 0; i < files.size(); ++i) {
    for (size_t k = i + 1; k < files.size(); ++k) {
      if (files[i].empty() || files[k].empty() || !same_file(files[i], files[k])) continue;
      wrong_usage("two of the files are the same: " + in_quotes(files[k]));
    }
  }
}

// What contradicts itself; where the topology is chosen by the file, idle.h says what did nothing.
void check_topology(const Arguments& arguments) {
  const bool flow = arguments.topology == TopologyChoice::flow;
  if (arguments.topology == TopologyChoice::automatic) return;
  for (const char* option : {"--voids", "--open-walls", "--lids"}) {
    if (flow || !has_option(arguments, option)) continue;
    wrong_usage(std::string(option) + " needs --topology flow");
  }
  for (const char* option : {"--soft", "--partial", "--find-borders"}) {
    if (!flow || !has_option(arguments, option)) continue;
    wrong_usage(std::string(option) + " does nothing with --topology flow");
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
  check_topology(arguments);
  return arguments;
}

bool has_option(const Arguments& arguments, const std::string& name) {
  return std::count(arguments.given.begin(), arguments.given.end(), name) != 0;
}

bool writes_standard_output(const Arguments& arguments) {
  bool any = arguments.report == "-" || arguments.image == "-" || arguments.html == "-";
  for (const std::string& output : arguments.outputs) any = any || output == "-";
  return any;
}

const char* method_name(wsk_method method) {
  return k_method_names[method];
}

}  // namespace wireskin_cli
