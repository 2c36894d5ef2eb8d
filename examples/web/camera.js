// An eye that turns round a pivot like a turntable: left and right about the up axis, up and down to the
// poles. All keys, mouse and touch movements end here.

import { add, cross, dot, multiply, perspective, scaled, unit } from "./vec.js";

const k_tangent = Math.tan((35 * Math.PI) / 360);

export class Camera {
  constructor(up) {
    this.up = up; // 0, 1 or 2: the axis of the data that points up
    this.azimuth = -0.6;
    this.elevation = 0.45;
    this.pivot = [0, 0, 0];
    this.centre = [0, 0, 0]; // of the ball that holds the object, and its radius
    this.distance = 1;
    this.radius = 1;
  }

  fit(bounds, aspect) {
    this.pivot = bounds.centre.slice();
    this.centre = bounds.centre.slice();
    this.radius = bounds.radius;
    this.distance = (1.08 * bounds.radius) / Math.sin(Math.atan(k_tangent * Math.min(1, aspect)));
  }

  // Right, up and towards the eye, orthonormal, in the data's axes.
  frame() {
    const c = Math.cos(this.elevation);
    const local = [
      c * Math.sin(this.azimuth), -c * Math.cos(this.azimuth), Math.sin(this.elevation)];
    const toData = (v) => {
      const w = [0, 0, 0];
      w[this.up] = v[2];
      w[(this.up + 1) % 3] = v[0];
      w[(this.up + 2) % 3] = v[1];
      return w;
    };
    const toward = toData(local);
    const right = toData([Math.cos(this.azimuth), Math.sin(this.azimuth), 0]);
    return { right, up: cross(toward, right), toward };
  }

  eye() {
    return add(this.pivot, scaled(this.frame().toward, this.distance));
  }

  matrix(aspect) {
    const { right, up, toward } = this.frame();
    const eye = this.eye();
    const along = (v) => -dot(v, eye);
    const view = new Float32Array([
      right[0], up[0], toward[0], 0,
      right[1], up[1], toward[1], 0,
      right[2], up[2], toward[2], 0,
      along(right), along(up), along(toward), 1,
    ]);
    const depth = along(toward) + dot(toward, this.centre); // of the object's middle; in front: < 0
    const near = Math.max(-depth - 1.02 * this.radius, 0.002 * this.distance);
    const far = Math.max(-depth + 1.02 * this.radius, 2 * near);
    return multiply(perspective(k_tangent, aspect, near, far), view);
  }

  turn(dx, dy) {
    this.azimuth -= dx;
    this.elevation = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.elevation + dy));
  }

  // In parts of the picture's height.
  pan(dx, dy) {
    const { right, up } = this.frame();
    const size = 2 * k_tangent * this.distance;
    this.pivot = add(this.pivot, add(scaled(right, -dx * size), scaled(up, dy * size)));
  }

  zoom(factor) {
    this.distance = Math.max(
      1e-4 * this.radius, Math.min(50 * this.radius, this.distance * factor));
  }

  // Looks from the tip of a coordinate axis (sign 1) or its foot (-1).
  along(axis, sign) {
    if (axis === this.up) {
      this.azimuth = 0;
      this.elevation = (sign * Math.PI) / 2;
      return;
    }
    this.elevation = 0;
    const first = axis === (this.up + 1) % 3;
    this.azimuth = first ? (sign * Math.PI) / 2 : sign > 0 ? Math.PI : 0;
  }

  // The ray through a point of the picture, x and y from -1 to 1.
  ray(x, y, aspect) {
    const { right, up, toward } = this.frame();
    const direction = add(
      add(scaled(right, x * k_tangent * aspect), scaled(up, y * k_tangent)), scaled(toward, -1));
    return { origin: this.eye(), direction: unit(direction) };
  }
}
