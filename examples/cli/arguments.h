// The command line: parsing, the text of --help, the names of the methods.
//
// Wrong usage is a Failure of one line with exit status 2 that points to --help.
#pragma once

#include <string>
#include <vector>

#include "wireskin.h"

namespace wireskin_cli {

// How the patches are found.
enum class TopologyChoice { automatic, normals, flow };

struct Arguments {
  std::vector<std::string> given;  // the names of the options, as they came
  std::string input;
  std::vector<std::string> outputs;    // at least one; "-" is the standard output, here and below
  std::string output_format = ".ply";  // of the standard output
  std::string report;                  // "" for none, like image
  std::string image;
  std::string html;
  double spacing = 0.0;  // 0: the library's default
  wsk_smoothing smoothing = WSK_SMOOTHING_DEFAULT;
  double noise = 0.0;
  double soft = 0.0;
  wsk_method method = WSK_METHOD_FAIR;
  int up_axis = 2;  // of picture and page: 0, 1, 2 for x, y, z
  bool quiet = false;
  bool help = false;
  bool version = false;
  bool curves = false;  // write the curves beside the mesh
  double snap = 0.0;    // the tolerance; 0: automatic, negative: off
  bool orient = false;
  TopologyChoice topology = TopologyChoice::automatic;
  int voids = WSK_VOIDS_AUTO;
  bool open_walls = false;
  bool partial = false;
  bool find_borders = false;
  int lids = WSK_LIDS_SINGLE;
};

// `words` without the name of the command. With --help or --version the rest is not looked at.
Arguments parse_arguments(const std::vector<std::string>& words);

// Whether the option was given.
bool has_option(const Arguments& arguments, const std::string& name);

// Whether the standard output carries one of the results.
bool writes_standard_output(const Arguments& arguments);

const char* help_text();
const char* method_name(wsk_method method);

}  // namespace wireskin_cli
