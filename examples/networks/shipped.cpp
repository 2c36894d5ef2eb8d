#include "shipped.h"

#include "closed_forms.h"

namespace networks {

std::vector<Shipped> shipped_closed_forms() {
  return {
      {"sphere.net", sphere_great_circles(62)},
      {"torus.net", torus(4.0, 2.0, {0.0, 90.0, 180.0, 270.0}, {0.0, 90.0, 180.0, 270.0}, 0.12)},
      {"saddle.obj", saddle(0.02)},
      {"bumpy.net", bumpy_sphere(0.0253)},
      {"cylinder.net", cylinder_band(1.0, 0.6, 4, 0.025)},
  };
}

// Found by a random search over offsets for patches that are discs, have a border that is a simple
// polygon along its mean normal, also when that is tilted by 5 degrees, and lie nearest the mesh on
// average. The planes x = +-.271 and z = .005 split ears and front legs lengthwise, for a loop
// round a limb has normals that cancel out.
Shipped shipped_spot(const Mesh& spot) {
  const Point x = {1.0, 0.0, 0.0};
  const Point y = {0.0, 1.0, 0.0};
  const Point z = {0.0, 0.0, 1.0};
  const std::vector<Plane> planes = {
      {x, 0.0},   {x, 0.271},  {x, -0.271}, {y, -0.049},
      {y, 0.704}, {z, -0.232}, {z, 0.005},  {z, 0.356},
  };
  return {"spot.net", cut(spot, planes)};
}

}  // namespace networks
