// The wireskin command: a curve network in, a surface, a picture and a report out.
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <vector>

#include "arguments.h"
#include "build.h"
#include "failure.h"
#include "files.h"
#include "hints.h"
#include "picture.h"
#include "png.h"
#include "progress.h"
#include "read_network.h"
#include "report_json.h"
#include "scan.h"
#include "summary.h"
#include "write_mesh.h"
#include "write_page.h"

namespace wireskin_cli {

static std::string report_of(const Arguments& arguments, const Network& network,
                             const BuildResult& result, size_t line = 0) {
  wsk_surface_view surface;
  wsk_surface_get_view(result.surface.get(), &surface, sizeof surface);
  const wsk_network_view prepared = result.prepared_view();
  std::vector<std::string> idle;
  if (result.surface != nullptr) {
    for (const IdleOption& option : idle_options(arguments, network, result)) {
      idle.push_back(option.name);
    }
  }
  return report_json({arguments, result.report, &surface,
                      result.prepared == nullptr ? nullptr : &prepared, result.flow.get(), line,
                      idle});
}

// The report of what failed. What went wrong there is said before what goes wrong here.
static void write_failure_report(const Arguments& arguments, const std::string& json,
                                 const std::string& line) {
  if (arguments.report.empty()) return;
  try {
    OutputFiles files;
    files.add(arguments.report, json);
    files.commit();
  } catch (const Failure& failure) {
    throw Failure(line + "; " + failure.what());
  }
}

static Network read_input(const Arguments& arguments) {
  try {
    return read_network(arguments.input);
  } catch (const ReadFailure& failure) {
    write_failure_report(arguments, read_failure_json(arguments, failure), failure.what());
    throw;
  }
}

static void write_outputs(const Arguments& arguments, const Network& network,
                          const BuildResult& result) {
  wsk_surface_view surface;
  wsk_surface_get_view(result.surface.get(), &surface, sizeof surface);
  OutputFiles files;
  for (const std::string& output : arguments.outputs) {
    const std::string name = output == "-" ? "surface" + arguments.output_format : output;
    files.add(output, mesh_bytes(surface, name, arguments.curves));
  }
  if (!arguments.image.empty()) {
    files.add(arguments.image, png_bytes(draw_picture(surface, arguments.up_axis)));
  }
  const std::string json = report_of(arguments, network, result);
  if (!arguments.report.empty()) files.add(arguments.report, json);
  if (!arguments.html.empty()) {
    const std::string title = std::filesystem::path(arguments.input).filename().string();
    files.add(arguments.html, page_bytes({surface, result, title, json, arguments.up_axis}));
  }
  if (cancel_wanted()) throw Failure(arguments.input + ": cancelled");
  files.commit();
}

// Says what failed; what the library calls an argument is an option here, and no place in the file.
[[noreturn]] static void fail_building(const Arguments& arguments, const Network& network,
                                       BuildResult& result) {
  const std::string option = option_at_fault(arguments, result.report);
  if (!option.empty()) result.report.curve = WSK_NONE;
  const std::string subject = arguments.input + (option.empty() ? "" : ": " + option);
  const std::string line =
      failure_line(subject, network, result.report) + failure_hint(arguments, network, result);
  const size_t place = line_of(network, result.report);
  write_failure_report(arguments, report_of(arguments, network, result, place), line);
  throw Failure(line, option.empty() ? 1 : 2);
}

static void run(const Arguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const Network network = read_input(arguments);
  for (const std::string& output : arguments.outputs) OutputFiles::check_folder(output);
  OutputFiles::check_folder(arguments.image);
  OutputFiles::check_folder(arguments.html);
  catch_signals();  // from here on; while a pipe is read, a signal may simply end the command
  ProgressLine progress(!arguments.quiet);
  BuildResult result = build_surface(network, arguments, progress.callbacks());
  progress.clear();
  if (result.surface == nullptr) fail_building(arguments, network, result);
  write_outputs(arguments, network, result);
  if (arguments.quiet) return;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::fputs(summary(arguments, network, result, seconds.count()).c_str(),
             writes_standard_output(arguments) ? stderr : stdout);
}

static int run_words(const std::vector<std::string>& words) {
  try {
    const Arguments arguments = parse_arguments(words);
    if (arguments.help) {
      std::fputs(help_text(), stdout);
    } else if (arguments.version) {
      std::printf("wireskin %s\n", wsk_version_string());
    } else {
      run(arguments);
    }
    return 0;
  } catch (const Failure& failure) {
    // Names of files come from outside and may hold anything; the message is one line.
    std::fprintf(stderr, "%s\n", printable(failure.what()).c_str());
    return failure.exit_status();
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "wireskin: not enough memory\n");
  } catch (const std::exception& other) {
    std::fprintf(stderr, "wireskin: %s\n", other.what());
  }
  return 1;
}

}  // namespace wireskin_cli

int main(int argc, char** argv) {
  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) words.emplace_back(argv[i]);
  return wireskin_cli::run_words(words);
}
