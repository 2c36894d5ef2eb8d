/* The header in strict C89: compiled with -std=c89 -pedantic-errors, linked by the C compiler
 * alone. */
#include "wireskin.h"

static int failed(const char* what) {
  return what[0] == '\0';
}

int main(void) {
  wsk_options options;
  wsk_report report;
  wsk_surface_view view;
  wsk_surface* surface = NULL;
  wsk_status status;

  wsk_options_init(&options, sizeof options);
  wsk_report_init(&report, sizeof report);
  status = wsk_build(NULL, 0, &options, &surface, &report);
  wsk_surface_get_view(surface, &view, sizeof view);
  wsk_surface_free(surface);
  if (status != WSK_ERROR_EMPTY || view.vertex_count != 0) return 1;
  return failed(wsk_status_name(status)) || failed(wsk_stage_name(report.stage)) ||
         failed(wsk_version_string());
}
