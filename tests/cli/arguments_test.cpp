#include "arguments.h"

#include <doctest/doctest.h>

#include "cli/support.h"

using namespace wireskin_cli;
using namespace cli_test;

static std::string complaint(const std::vector<std::string>& words) {
  const std::string line = failure_of([&] { parse_arguments(words); });
  if (!line.empty()) {
    CHECK(line.compare(0, 10, "wireskin: ") == 0);
    CHECK(line.find("(see wireskin --help)") != std::string::npos);
    CHECK(line.find('\n') == std::string::npos);
  }
  return line;
}

static bool complains_of(const std::vector<std::string>& words, const char* what) {
  return complaint(words).find(what) != std::string::npos;
}

TEST_CASE("everything given") {
  const Arguments arguments =
      parse_arguments({"--spacing", "0.5", "in.net", "-o", "out.PLY", "--method=triharmonic",
                       "--report=r.json", "--image", "i.png", "--quiet", "--up", "y", "--curves"});
  CHECK(arguments.input == "in.net");
  CHECK(arguments.outputs == std::vector<std::string>{"out.PLY"});
  CHECK(arguments.spacing == 0.5);
  CHECK(arguments.method == WSK_METHOD_TRIHARMONIC);
  CHECK(arguments.report == "r.json");
  CHECK(arguments.image == "i.png");
  CHECK(arguments.quiet);
  CHECK(arguments.up_axis == 1);
  CHECK(arguments.curves);
}

TEST_CASE("defaults") {
  const Arguments arguments = parse_arguments({"in.net", "-o", "out.obj"});
  CHECK(arguments.spacing == 0.0);
  CHECK(arguments.method == WSK_METHOD_FAIR);
  CHECK(arguments.report.empty());
  CHECK(arguments.image.empty());
  CHECK_FALSE(arguments.quiet);
  CHECK_FALSE(arguments.curves);
  CHECK(arguments.up_axis == 2);
}

TEST_CASE("snapping and orientation") {
  CHECK(parse_arguments({"in.net", "-o", "out.obj"}).snap == 0.0);
  CHECK_FALSE(parse_arguments({"in.net", "-o", "out.obj"}).orient);
  CHECK(parse_arguments({"in.net", "-o", "out.obj", "--snap", "auto"}).snap == 0.0);
  CHECK(parse_arguments({"in.net", "-o", "out.obj", "--snap=off"}).snap < 0.0);
  CHECK(parse_arguments({"in.net", "-o", "out.obj", "--snap", "0.5"}).snap == 0.5);
  CHECK(parse_arguments({"in.net", "-o", "out.obj", "--snap", "0"}).snap < 0.0);
  CHECK(parse_arguments({"in.net", "-o", "out.obj", "--snap", "0.0"}).snap < 0.0);
  CHECK(complains_of({"in.net", "-o", "out.obj", "--snap", "x"},
                     "--snap needs a length, auto or off, not \"x\""));
  CHECK(parse_arguments({"in.net", "-o", "out.obj", "--orient"}).orient);
  CHECK(complains_of({"in.net", "-o", "out.obj", "--snap", "-1"}, "--snap"));
  CHECK(complains_of({"in.net", "-o", "out.obj", "--snap", "x"}, "--snap"));
}

TEST_CASE("what contradicts the topology asked for is refused") {
  const auto with = [](std::vector<std::string> words) {
    words.insert(words.end(), {"in.net", "-o", "out.obj"});
    return words;
  };
  CHECK(complains_of(with({"--topology", "normals", "--voids", "2"}),
                     "--voids needs --topology flow"));
  CHECK(complains_of(with({"--topology", "normals", "--open-walls"}),
                     "--open-walls needs --topology flow"));
  CHECK(complains_of(with({"--topology", "normals", "--lids", "all"}),
                     "--lids needs --topology flow"));
  CHECK(complains_of(with({"--lids", "some"}), "--lids needs auto, all or none"));
  CHECK(parse_arguments(with({"--lids", "none"})).lids == WSK_LIDS_NONE);
  CHECK(complains_of(with({"--topology", "flow", "--partial"}),
                     "--partial does nothing with --topology flow"));
  CHECK(complains_of(with({"--topology", "flow", "--soft", "1"}),
                     "--soft does nothing with --topology flow"));
  CHECK(parse_arguments(with({"--topology", "flow", "--voids", "2"})).voids == 2);
  CHECK(parse_arguments(with({"--voids", "2"})).voids == 2);  // the file decides
  CHECK(parse_arguments(with({"--partial"})).given == std::vector<std::string>{"--partial", "-o"});
}

TEST_CASE("the standard output") {
  const Arguments arguments = parse_arguments({"-", "-o", "-", "--format=stl"});
  CHECK(arguments.input == "-");
  CHECK(arguments.output_format == ".stl");
  CHECK(writes_standard_output(arguments));
  CHECK(parse_arguments({"a.net", "-o", "-"}).output_format == ".ply");
  CHECK(writes_standard_output(parse_arguments({"a.net", "-o", "a.ply", "--report", "-"})));
  CHECK_FALSE(writes_standard_output(parse_arguments({"-", "-o", "a.ply"})));
  CHECK(complains_of({"a.net", "-o", "-", "-o", "-"}, "only one of the results"));
  CHECK(complains_of({"a.net", "-o", "-", "--report", "-"}, "only one of the results"));
  CHECK(complains_of({"a.net", "-o", "-", "--format", "dae"}, "--format needs obj, ply or stl"));
  CHECK(complains_of({"a.net", "-o", "-", "--format", "stl", "--curves"}, "--curves needs"));
}

TEST_CASE("each method by its name") {
  for (wsk_method method = 0; method < WSK_METHOD_COUNT; ++method) {
    const char* name = method_name(method);
    CHECK(parse_arguments({"in.net", "-o", "out.obj", "--method", name}).method == method);
    CHECK(std::string(help_text()).find(name) != std::string::npos);
  }
}

TEST_CASE("help and version need nothing else") {
  CHECK(parse_arguments({"--help"}).help);
  CHECK(parse_arguments({"in.net", "--version", "--nonsense"}).version);
}

TEST_CASE("after -- everything is a file") {
  CHECK(parse_arguments({"-o", "out.obj", "--", "--a=b.net"}).input == "--a=b.net");
}

TEST_CASE("wrong usage") {
  CHECK(complains_of({}, "no input file"));
  CHECK(complains_of({"in.net"}, "no output file"));
  CHECK(complains_of({"in.net", "-o"}, "-o needs a value"));
  CHECK(complains_of({"in.net", "-o", ""}, "-o needs a value"));
  CHECK(complains_of({"in.net", "--report=", "-o", "a.obj"}, "--report needs a value"));
  CHECK(complains_of({"a.net", "b.net", "-o", "out.obj"}, "more than one input"));
  CHECK(complains_of({"a.net", "-o", "out.obj", "--fast"}, "unknown option \"--fast\""));
  CHECK(complains_of({"a.net", "-o", "out.obj", "--quiet=1"}, "--quiet takes no value"));
  CHECK(complains_of({"a.net", "-o", "out.stl", "--curves"}, "--curves needs .obj or .ply"));
  CHECK(complains_of({"a.net", "-o", "out.dae"}, "unknown output format \".dae\""));
  CHECK(complains_of({"a.net", "-o", "out"}, "unknown output format"));
  CHECK(complains_of({"a.net", "-o", "out.obj", "--image", "x.jpg"}, "must end in .png"));
  CHECK(complains_of({"a.net", "-o", "out.obj", "--method", "magic"},
                     "unknown method \"magic\", known are stanko, biharmonic"));
  CHECK(complains_of({"a.net", "-o", "out.obj", "--up", "w"}, "--up needs x, y or z"));
  CHECK(complains_of({"a.net", "-o", "out.obj", "--up", "xy"}, "--up needs x, y or z"));
  for (const char* spacing : {"0", "-1", "nan", "inf", "1cm", ""}) {
    CAPTURE(spacing);
    CHECK(complains_of({"a.net", "-o", "out.obj", "--spacing", spacing}, "--spacing needs"));
  }
}

TEST_CASE("no file is written over another") {
  CHECK(complains_of({"a.obj", "-o", "a.obj"}, "two of the files are the same"));
  CHECK(complains_of({"a.obj", "-o", "./x/../a.obj"}, "two of the files are the same"));
  CHECK(complains_of({"a.net", "-o", "b.obj", "--report", "b.obj"}, "two of the files"));
  const ScratchFolder scratch("arguments");
  write_file(scratch / "a.obj", "x");
  fs::create_hard_link(scratch / "a.obj", scratch / "b.obj");
  CHECK(complains_of({scratch / "a.obj", "-o", scratch / "b.obj"}, "two of the files"));
}

TEST_CASE("wrong usage has exit status 2") {
  try {
    parse_arguments({"--nonsense"});
    FAIL("no failure");
  } catch (const Failure& failure) {
    CHECK(failure.exit_status() == 2);
  }
}
