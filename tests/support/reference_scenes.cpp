// The reference scenes beside those that tests call by name.
#include "support/scene_parts.h"
#include "support/scenes.h"

namespace scenes {

using Point = std::array<double, 3>;

static Scene named(const char* name, Scene scene, wsk_method method) {
  scene.name = name;
  scene.method = method;
  return scene;
}

// octants() on fewer vertices.
static Scene sphere(const char* name, wsk_method method) {
  Scene scene = named(name, octants(), method);
  scene.spacing = 0.25;
  return scene;
}

static Scene saddle_by(const char* name, wsk_method method) {
  Scene scene = named(name, saddle(), method);
  scene.spacing = 0.25;
  return scene;
}

// ---- Noise and softness -------------------------------------------------------------------------

static Scene noise_given() {
  Scene scene = named("noise_given", noisy(), WSK_METHOD_ITERATED);
  scene.smoothing = WSK_SMOOTHING_GIVEN;
  scene.noise = 0.003;
  return scene;
}

static Scene soft() {
  Scene scene = named("soft", noisy(), WSK_METHOD_ITERATED);
  scene.smoothing = WSK_SMOOTHING_NONE;
  scene.soft = 0.15;
  return scene;
}

static Scene soft_curve() {
  Scene scene = named("soft_curve", noisy(), WSK_METHOD_FAIR);
  scene.smoothing = WSK_SMOOTHING_NONE;
  scene.curves[1].soft = 0.2;
  return scene;
}

// ---- Creases ------------------------------------------------------------------------------------

static Point corner_of_box(uint32_t corner) {
  return {(corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.25 : -1.25,
          (corner & 4) != 0 ? 0.75 : -0.75};
}

// The edges of a box, each with the normals of its two sides.
static std::vector<Curve> box_edges(int segments) {
  std::vector<Curve> curves;
  for (uint32_t a = 0; a < 3; ++a) {
    const uint32_t b = (a + 1) % 3, c = (a + 2) % 3;
    for (uint32_t corner = 0; corner < 8; ++corner) {
      if ((corner >> a & 1) != 0) continue;
      const bool positive_b = (corner >> b & 1) != 0, positive_c = (corner >> c & 1) != 0;
      Point of_b = {}, of_c = {};
      of_b[b] = positive_b ? 1.0 : -1.0;
      of_c[c] = positive_c ? 1.0 : -1.0;
      const bool b_left = positive_b == positive_c;
      const uint32_t end = corner | 1u << a;
      const Point from = corner_of_box(corner), to = corner_of_box(end);
      Curve curve = straight(from, to, corner, end, b_left ? of_b : of_c, segments);
      curve.normals_right = straight(from, to, corner, end, b_left ? of_c : of_b, segments).normals;
      curve.sharp = true;
      curves.push_back(curve);
    }
  }
  return curves;
}

static Scene box(const char* name, wsk_method method, bool with_normals) {
  Scene scene;
  scene.name = name;
  scene.method = method;
  scene.spacing = 0.4;
  scene.curves = box_edges(4);
  if (with_normals) return scene;
  for (Curve& curve : scene.curves) {
    curve.normals.clear();
    curve.normals_right.clear();
  }
  return scene;
}

// Smooth across the equator, where the curvature may jump.
static Scene jump() {
  Scene scene = sphere("jump", WSK_METHOD_FAIR);
  scene.curves[0].sharp = true;
  scene.curves[0].normals_right = scene.curves[0].normals;
  return scene;
}

// ---- Loops, points, loose curves ----------------------------------------------------------------

// A circle in a plane z; its normals lean outward by `lean` and up by `up`.
static Curve ring(double radius, double z, double lean, double up, bool boundary) {
  Curve curve;
  curve.closed = true;
  curve.boundary = boundary;
  for (const Point2& p : circle(4)) {
    add_sample(curve, {radius * p.x, radius * p.y, z}, {lean * p.x, lean * p.y, up}, WSK_NONE);
  }
  return curve;
}

static Scene of_curves(const char* name, wsk_method method, double spacing,
                       const std::vector<Curve>& curves) {
  Scene scene;
  scene.name = name;
  scene.method = method;
  scene.spacing = spacing;
  scene.curves = curves;
  return scene;
}

static Scene hole() {
  return of_curves("hole", WSK_METHOD_FAIR, 0.15,
                   {ring(1.0, 0.0, 0.5, 1.0, true), ring(0.5, 0.125, 0.0, 1.0, true)});
}

static Scene tube() {
  return of_curves("tube", WSK_METHOD_FAIR, 0.25,
                   {ring(1.0, -0.5, 1.0, 0.0, true), ring(1.0, 0.5, 1.0, 0.0, true)});
}

static Scene one_circle() {
  return of_curves("one_circle", WSK_METHOD_ITERATED, 0.25, {ring(1.0, 0.0, 1.0, 0.0, false)});
}

static Scene inner_loop() {
  return of_curves("inner_loop", WSK_METHOD_STANKO, 0.2,
                   {ring(1.0, 0.0, 0.5, 1.0, true), ring(0.5, 0.2, 0.25, 1.0, false)});
}

static Scene held_points() {
  Curve point, place;
  add_sample(point, {0.3, 0.1, 0.3}, {0.1, 0.0, 1.0}, WSK_NONE);
  add_sample(place, {-0.4, 0.0, 0.2}, {}, WSK_NONE);
  place.normals.clear();
  return of_curves("held_points", WSK_METHOD_ITERATED, 0.15,
                   {ring(1.0, 0.0, 0.5, 1.0, true), point, place});
}

static Scene dangling() {
  Scene scene = saddle_by("dangling", WSK_METHOD_FAIR);
  Curve curve;
  for (int i = 0; i <= 4; ++i) {
    const double x = i / 8.0;
    add_sample(curve, {x, x, 0.0}, {-x, x, 1.0}, i == 0 ? 4 : WSK_NONE);
  }
  scene.curves.push_back(curve);
  return scene;
}

static std::vector<Curve> moved(std::vector<Curve> curves, double along_x, uint32_t numbers) {
  for (Curve& curve : curves) {
    for (size_t i = 0; i < curve.size(); ++i) {
      curve.positions[3 * i] += along_x;
      if (curve.nodes[i] != WSK_NONE) curve.nodes[i] += numbers;
    }
  }
  return curves;
}

static Scene two_spheres() {
  Scene scene = sphere("two_spheres", WSK_METHOD_ITERATED);
  const std::vector<Curve> other = moved(scene.curves, 4.0, 6);
  scene.curves.insert(scene.curves.end(), other.begin(), other.end());
  return scene;
}

// A sphere beside a border that crosses itself.
static Scene partial() {
  Scene scene = sphere("partial", WSK_METHOD_STANKO);
  scene.partial = true;
  const Point corner[4] = {{4, 0, 0}, {5, 1, 0}, {5, 0, 0}, {4, 1, 0}};
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t next = (i + 1) % 4;
    scene.curves.push_back(straight(corner[i], corner[next], 10 + i, 10 + next, {0, 0, 1}, 4));
    scene.curves.back().boundary = true;
  }
  return scene;
}

// The saddle whose border no one tagged.
static Scene untagged() {
  Scene scene = saddle();
  scene.name = "untagged";
  scene.find_borders = true;
  for (Curve& curve : scene.curves) curve.boundary = false;
  return scene;
}

// Four meridians and four parallels of radius 2 and 1; sample k of a curve is node where k / 4 is
// whole.
static Scene torus() {
  Scene scene;
  scene.name = "torus";
  scene.method = WSK_METHOD_FAIR;
  scene.spacing = 0.6;
  const std::vector<Point2> points = circle(4);
  const uint32_t n = static_cast<uint32_t>(points.size());
  const auto add = [&](Curve& curve, uint32_t u, uint32_t v) {
    const Point2 a = points[u], b = points[v];
    const double radius = 2.0 + b.x;
    const bool at_node = u % 4 == 0 && v % 4 == 0;
    add_sample(curve, {radius * a.x, radius * a.y, b.y}, {b.x * a.x, b.x * a.y, b.y},
               at_node ? u + v / 4 : WSK_NONE);
  };
  for (uint32_t fixed = 0; fixed < n; fixed += 4) {
    Curve meridian, parallel;
    meridian.closed = parallel.closed = true;
    for (uint32_t i = 0; i < n; ++i) {
      add(meridian, fixed, i);
      add(parallel, i, fixed);
    }
    scene.curves.push_back(meridian);
    scene.curves.push_back(parallel);
  }
  return scene;
}

// ---- Raw and measured curves --------------------------------------------------------------------

// Samples [first, last] of a curve that may be closed, without node numbers.
static Curve stretch(const Curve& of, size_t first, size_t last) {
  Curve curve;
  for (size_t i = first; i <= last; ++i) {
    const size_t k = i % of.size();
    add_sample(curve, {of.positions[3 * k], of.positions[3 * k + 1], of.positions[3 * k + 2]},
               {of.normals[3 * k], of.normals[3 * k + 1], of.normals[3 * k + 2]}, WSK_NONE);
  }
  return curve;
}

// Every great circle in five pieces that all but meet; some know no normals.
static Scene fragments() {
  Scene scene = sphere("fragments", WSK_METHOD_ITERATED);
  scene.way = Way::connect;
  std::vector<Curve> pieces;
  for (const Curve& whole : scene.curves) {
    const size_t n = whole.size();
    for (size_t first = 0; first < n; first += 7) {
      Curve piece = stretch(whole, first, first + 7 < n ? first + 7 : n);
      piece.positions[0] += 0.001;
      if (first == 14) piece.normals.assign(piece.normals.size(), 0.0);
      pieces.push_back(piece);
    }
  }
  scene.curves = pieces;
  return scene;
}

// The lines of the saddle as segments of two points.
static Scene segments() {
  Scene scene = saddle_by("segments", WSK_METHOD_FAIR);
  scene.way = Way::connect;
  std::vector<Curve> pieces;
  for (const Curve& whole : scene.curves) {
    for (size_t i = 0; i + 1 < whole.size(); ++i) {
      pieces.push_back(stretch(whole, i, i + 1));
      pieces.back().boundary = whole.boundary;
    }
  }
  scene.curves = pieces;
  return scene;
}

static Scene flipped() {
  Scene scene = sphere("flipped", WSK_METHOD_STANKO);
  scene.way = Way::connect;
  scene.orient = true;
  for (double& x : scene.curves[1].normals) x = -x;
  return scene;
}

static Scene sensors() {
  Scene scene = sphere("sensors", WSK_METHOD_FAIR);
  scene.way = Way::integrate;
  for (const Curve& whole : scene.curves) {
    SensorCurve sensor;
    const size_t n = whole.size(), shift = n / 4;
    for (size_t i = 0; i <= n; ++i) {
      sensor.arc_lengths.push_back(0.2 * static_cast<double>(i));
      for (size_t k = 0; k < 3; ++k) {  // the tangent of a circle is its point a quarter on
        sensor.tangents.push_back(whole.positions[3 * ((i + shift) % n) + k]);
        sensor.rest.normals.push_back(whole.normals[3 * (i % n) + k]);
      }
      sensor.rest.nodes.push_back(whole.nodes[i % n]);
    }
    sensor.rest.closed = true;
    scene.sensors.push_back(sensor);
  }
  scene.curves.clear();
  return scene;
}

static Scene sensors_by_step() {
  Scene scene = saddle_by("sensors_by_step", WSK_METHOD_ITERATED);
  scene.way = Way::integrate;
  scene.tangents_to_next = true;
  for (const Curve& whole : scene.curves) {
    SensorCurve sensor;
    sensor.rest = whole;
    double length = 0.0;
    for (size_t i = 0; i < whole.size(); ++i) {
      sensor.arc_lengths.push_back(length);
      const size_t a = i + 1 < whole.size() ? i : i - 1;
      Point step;
      for (size_t k = 0; k < 3; ++k) {
        step[k] = whole.positions[3 * a + 3 + k] - whole.positions[3 * a + k];
      }
      length += std::sqrt(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]);
      sensor.tangents.insert(sensor.tangents.end(), step.begin(), step.end());
    }
    scene.sensors.push_back(sensor);
  }
  scene.curves.clear();
  return scene;
}

// ---- Curves alone -------------------------------------------------------------------------------

static Scene flow_box() {
  Scene scene = box("flow_box", WSK_METHOD_FAIR, false);
  scene.way = Way::flow;
  return scene;
}

// A box with a frame across its middle: two rooms and a wall between them.
static Scene flow_rooms() {
  Scene scene = box("flow_rooms", WSK_METHOD_FAIR, false);
  scene.way = Way::flow;
  scene.voids = 2;
  scene.raw = true;
  const Point middle[4] = {{-1, 0, -0.75}, {1, 0, -0.75}, {1, 0, 0.75}, {-1, 0, 0.75}};
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t next = (i + 1) % 4;
    scene.curves.push_back(straight(middle[i], middle[next], 8 + i, 8 + next, {0, 0, 1}, 4));
    scene.curves.back().normals.clear();
  }
  return scene;
}

static Scene flow_normals() {
  Scene scene = named("flow_normals", ellipsoid(), WSK_METHOD_ITERATED);
  scene.spacing = 0.3;
  scene.way = Way::flow;
  return scene;
}

static Scene flow_bare() {
  Scene scene = named("flow_bare", ellipsoid(), WSK_METHOD_FAIR);
  scene.spacing = 0.3;
  scene.way = Way::flow;
  for (Curve& curve : scene.curves) curve.normals.clear();
  return scene;
}

std::vector<Scene> all() {
  return {octants(),
          saddle(),
          band(),
          noisy(),
          sphere("sphere_biharmonic", WSK_METHOD_BIHARMONIC),
          sphere("sphere_triharmonic", WSK_METHOD_TRIHARMONIC),
          sphere("sphere_clamped", WSK_METHOD_CLAMPED),
          sphere("sphere_iterated", WSK_METHOD_ITERATED),
          sphere("sphere_fair", WSK_METHOD_FAIR),
          saddle_by("saddle_fair", WSK_METHOD_FAIR),
          saddle_by("saddle_iterated", WSK_METHOD_ITERATED),
          named("band_fair", band(), WSK_METHOD_FAIR),
          named("band_iterated", band(), WSK_METHOD_ITERATED),
          noise_given(),
          soft(),
          soft_curve(),
          box("box", WSK_METHOD_FAIR, true),
          box("box_stanko", WSK_METHOD_STANKO, true),
          box("box_bare", WSK_METHOD_ITERATED, false),
          jump(),
          hole(),
          tube(),
          one_circle(),
          inner_loop(),
          held_points(),
          dangling(),
          two_spheres(),
          partial(),
          untagged(),
          torus(),
          fragments(),
          segments(),
          flipped(),
          sensors(),
          sensors_by_step(),
          flow_box(),
          flow_rooms(),
          flow_normals(),
          flow_bare()};
}

}  // namespace scenes
