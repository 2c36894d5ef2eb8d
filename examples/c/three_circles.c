/*
 * Surfaces three great circles of the unit sphere and writes the mesh as OBJ.
 *
 *     cc -I../../src three_circles.c libwireskin.a -lm -o three_circles
 *     ./three_circles sphere.obj        (without a name: to standard output)
 */
#include <math.h>
#include <stdio.h>

#include "wireskin.h"

#define SAMPLES 64 /* of each circle; a multiple of 4, so that samples fall on the axes */

static double points[3][SAMPLES][3];
static uint32_t nodes[3][SAMPLES];

/* Circle c lies in the plane of the axes c and c + 1. Where it crosses an axis it meets another
   circle: both must have the same node number there, and exactly the same point. */
static void make_circle(int c, wsk_curve* curve) {
  static const double quarter_cos[4] = {1, 0, -1, 0};
  const int first = c, second = (c + 1) % 3;
  int i;
  for (i = 0; i < SAMPLES; ++i) {
    const int quarter = i * 4 / SAMPLES;
    const double angle = 2.0 * 3.14159265358979323846 * i / SAMPLES;
    if (i % (SAMPLES / 4) == 0) {
      points[c][i][first] = quarter_cos[quarter];
      points[c][i][second] = quarter_cos[(quarter + 3) % 4];
      /* Six nodes: the two ends of each axis. */
      nodes[c][i] = (uint32_t)(2 * (quarter % 2 == 0 ? first : second) + quarter / 2);
    } else {
      points[c][i][first] = cos(angle);
      points[c][i][second] = sin(angle);
      nodes[c][i] = WSK_NONE;
    }
  }
  curve->sample_count = SAMPLES;
  curve->positions = &points[c][0][0];
  curve->normals = &points[c][0][0]; /* on the unit sphere the normal is the point */
  curve->nodes = &nodes[c][0];
  curve->closed = 1;
}

static int write_obj(FILE* file, const wsk_surface* surface) {
  wsk_surface_view view;
  uint32_t i;
  wsk_surface_get_view(surface, &view, sizeof view);
  for (i = 0; i < view.vertex_count; ++i) {
    const double* p = view.positions + 3 * (size_t)i;
    fprintf(file, "v %.17g %.17g %.17g\n", p[0], p[1], p[2]);
  }
  for (i = 0; i < view.triangle_count; ++i) {
    const uint32_t* t = view.triangles + 3 * (size_t)i;
    fprintf(file, "f %lu %lu %lu\n", t[0] + 1ul, t[1] + 1ul, t[2] + 1ul);
  }
  return ferror(file) == 0;
}

int main(int argc, char** argv) {
  static wsk_curve curves[3]; /* static: members not set below are zero */
  wsk_surface* surface = NULL;
  wsk_report report;
  FILE* file;
  int c, written;

  for (c = 0; c < 3; ++c) make_circle(c, &curves[c]);
  wsk_report_init(&report, sizeof report);
  if (wsk_build(curves, 3, NULL, &surface, &report) != WSK_OK) {
    fprintf(stderr, "three_circles: %s: %s\n", wsk_status_name(report.status), report.sentence);
    return 1;
  }
  file = argc > 1 ? fopen(argv[1], "w") : stdout;
  written = file != NULL && write_obj(file, surface);
  if (file != NULL && fclose(file) != 0) written = 0;
  wsk_surface_free(surface);
  if (!written) {
    fprintf(stderr, "three_circles: the mesh could not be written\n");
    return 1;
  }
  return 0;
}
