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
#include "write_mesh.h"
#include "write_page.h"

namespace wireskin_cli {

static std::string report_of(const Arguments& arguments, const BuildResult& result,
                             size_t line = 0) {
  wsk_surface_view surface;
  wsk_surface_get_view(result.surface.get(), &surface, sizeof surface);
  const wsk_network_view prepared = result.prepared_view();
  return report_json({arguments, result.report, &surface,
                      result.prepared == nullptr ? nullptr : &prepared, result.flow.get(), line});
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

static void write_outputs(const Arguments& arguments, const wsk_surface_view& surface,
                          const BuildResult& result) {
  OutputFiles files;
  for (const std::string& output : arguments.outputs) {
    files.add(output, mesh_bytes(surface, output, arguments.curves));
  }
  if (!arguments.image.empty()) {
    files.add(arguments.image, png_bytes(draw_picture(surface, arguments.up_axis)));
  }
  const std::string json = report_of(arguments, result);
  if (!arguments.report.empty()) files.add(arguments.report, json);
  if (!arguments.html.empty()) {
    const std::string title = std::filesystem::path(arguments.input).filename().string();
    files.add(arguments.html, page_bytes({surface, result, title, json, arguments.up_axis}));
  }
  if (cancel_wanted()) throw Failure(arguments.input + ": cancelled");
  files.commit();
}

static void print_flow(const wsk_flow_view& view, int voids_asked) {
  const auto number = [](uint32_t n) { return static_cast<unsigned long>(n); };
  std::printf(
      "from curves alone: Betti numbers %lu %lu %lu, %lu open patches, %lu bare segments%s%s\n",
      number(view.betti[0]), number(view.betti[1]), number(view.betti[2]),
      number(view.open_patch_count), number(view.bare_count),
      view.manifold != 0 ? "" : ", not a manifold",
      view.smoothed != 0 ? "; shaped by the normals" : "");
  if (voids_asked > 0 && view.caged_count < static_cast<uint32_t>(voids_asked)) {
    std::printf("asked for %d voids, the curves cage %lu\n", voids_asked, number(view.caged_count));
  }
  if (view.normals_sentence[0] == 0) return;
  std::printf("the normals could not be used: %s", view.normals_sentence);
  if (view.normals_places > 0) std::printf(" (in %lu places)", number(view.normals_places));
  std::printf("\n");
}

static void run(const Arguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const Network network = read_input(arguments);
  catch_signals();  // from here on; while a pipe is read, a signal may simply end the command
  ProgressLine progress(!arguments.quiet);
  const BuildResult result = build_surface(network, arguments, progress.callbacks());
  progress.clear();
  if (result.surface == nullptr) {
    const std::string line = failure_line(arguments.input, network, result.report) +
                             failure_hint(arguments, network, result);
    const size_t place = line_of(network, result.report);
    write_failure_report(arguments, report_of(arguments, result, place), line);
    throw Failure(line);
  }
  wsk_surface_view surface;
  wsk_surface_get_view(result.surface.get(), &surface, sizeof surface);
  write_outputs(arguments, surface, result);
  if (arguments.quiet) return;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::printf("%s: %lu vertices, %lu triangles, %lu patches, %.2f s\n",
              printable(arguments.outputs.front()).c_str(),
              static_cast<unsigned long>(surface.vertex_count),
              static_cast<unsigned long>(surface.triangle_count),
              static_cast<unsigned long>(surface.patch_count), seconds.count());
  if (result.report.failed_patches > 0) {
    std::printf("left out, as the report says: %lu of these patches\n",
                static_cast<unsigned long>(result.report.failed_patches));
  }
  if (result.flow != nullptr) print_flow(result.flow->view, arguments.voids);
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
