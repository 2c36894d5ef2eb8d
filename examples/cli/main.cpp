// The wireskin command: a curve network in, a surface, a picture and a report out.
#include <chrono>
#include <cstdio>
#include <exception>
#include <new>
#include <vector>

#include "arguments.h"
#include "build.h"
#include "failure.h"
#include "files.h"
#include "picture.h"
#include "png.h"
#include "progress.h"
#include "read_network.h"
#include "report_json.h"
#include "write_mesh.h"

namespace wireskin_cli {

// The report of a build that failed. What went wrong there is said before what goes wrong here.
static void write_failure_report(const Arguments& arguments, const wsk_report& report,
                                 const std::string& line) {
  if (arguments.report.empty()) return;
  try {
    OutputFiles files;
    files.add(arguments.report, report_json(arguments, report));
    files.commit();
  } catch (const Failure& failure) {
    throw Failure(line + "; " + failure.what());
  }
}

static void write_outputs(const Arguments& arguments, const Network& network,
                          const wsk_surface_view& surface, const wsk_report& report) {
  OutputFiles files;
  files.add(arguments.output, mesh_bytes(surface, arguments.output));
  if (!arguments.image.empty()) {
    files.add(arguments.image, png_bytes(draw_picture(surface, network, arguments.up_axis)));
  }
  if (!arguments.report.empty()) {
    files.add(arguments.report, report_json(arguments, report, &surface));
  }
  if (cancel_wanted()) throw Failure(arguments.input + ": cancelled");
  files.commit();
}

static void run(const Arguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const Network network = read_network(arguments.input);
  catch_signals();  // from here on; while a pipe is read, a signal may simply end the command
  ProgressLine progress(!arguments.quiet);
  const BuildResult result = build_surface(network, arguments, progress.callbacks());
  progress.clear();
  if (result.surface == nullptr) {
    const std::string line = failure_line(arguments.input, network, result.report);
    write_failure_report(arguments, result.report, line);
    throw Failure(line);
  }
  wsk_surface_view surface;
  wsk_surface_get_view(result.surface.get(), &surface, sizeof surface);
  write_outputs(arguments, network, surface, result.report);
  if (arguments.quiet) return;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::printf("%s: %lu vertices, %lu triangles, %lu patches, %.2f s\n", arguments.output.c_str(),
              static_cast<unsigned long>(surface.vertex_count),
              static_cast<unsigned long>(surface.triangle_count),
              static_cast<unsigned long>(surface.patch_count), seconds.count());
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
    std::fprintf(stderr, "%s\n", failure.what());
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
