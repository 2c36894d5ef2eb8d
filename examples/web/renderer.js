// Draws a scene with WebGL 2: the surface in one of four looks, and lines and dots over it.
//
// The surface is drawn corner by corner, without an index, so that patches may differ in colour and the
// edges of triangles are known to the fragments. Lines are quads that keep their width in pixels.

const k_surface_vertex = `#version 300 es
in vec3 position;
in vec3 normal;
in float curvature;
in vec3 tint;
uniform mat4 matrix;
out vec3 n;
out float h;
out vec3 patchColour;
out vec3 corner;
out vec3 place;
void main() {
  n = normal;
  h = curvature;
  patchColour = tint;
  int k = gl_VertexID % 3;
  corner = vec3(k == 0, k == 1, k == 2);
  place = position;
  gl_Position = matrix * vec4(position, 1.0);
}`;

const k_surface_fragment = `#version 300 es
precision highp float;
in vec3 n;
in float h;
in vec3 patchColour;
in vec3 corner;
in vec3 place;
uniform int look;       // 0 shaded, 1 isophotes, 2 curvature, 3 patches
uniform bool wires;
uniform vec3 light;     // where the light comes from
uniform vec3 eye;
uniform float range;    // of the curvature's colours
uniform vec3 front;
uniform vec3 back;
out vec4 colour;

const vec3 k_low = vec3(0.13, 0.40, 0.76);
const vec3 k_middle = vec3(0.94, 0.93, 0.90);
const vec3 k_high = vec3(0.75, 0.16, 0.15);

vec3 diverging(float t) {
  return t < 0.0 ? mix(k_middle, k_low, min(-t, 1.0)) : mix(k_middle, k_high, min(t, 1.0));
}

// Twelve degrees a pair of stripes, with edges as wide as a pixel.
float stripe(vec3 unitNormal) {
  float phase = degrees(acos(clamp(dot(unitNormal, light), -1.0, 1.0))) / 12.0;
  float width = fwidth(phase);
  float triangle = abs(fract(phase) - 0.5);
  return width > 0.7 ? 0.5 : smoothstep(0.25 - 0.75 * width, 0.25 + 0.75 * width, triangle);
}

void main() {
  vec3 normal = normalize(n);
  vec3 toward = normalize(eye - place);
  float facing = abs(dot(normal, toward));
  vec3 base = gl_FrontFacing ? front : back;
  if (look == 2) base = diverging(h / range);
  if (look == 3) base = gl_FrontFacing ? patchColour : 0.65 * patchColour;
  float shade = 0.42 + 0.58 * facing;
  if (look == 0) {
    vec3 lit = gl_FrontFacing ? normal : -normal;
    float diffuse = max(dot(lit, light), 0.0);
    float shine = pow(max(dot(reflect(-light, lit), toward), 0.0), 40.0);
    colour = vec4(base * (0.30 + 0.25 * facing + 0.50 * diffuse) + 0.18 * shine, 1.0);
  } else if (look == 1) {
    colour = vec4(base * mix(0.22, 1.0, stripe(normal)) * shade, 1.0);
  } else {
    colour = vec4(base * shade, 1.0);
  }
  if (wires) {
    vec3 edge = corner / max(fwidth(corner), vec3(1e-6));
    float near = 1.0 - smoothstep(0.4, 1.3, min(edge.x, min(edge.y, edge.z)));
    colour.rgb = mix(colour.rgb, vec3(0.05, 0.07, 0.10), 0.55 * near);
  }
}`;

const k_line_vertex = `#version 300 es
in vec2 end;            // x: which end, y: which side
in vec3 from;
in vec3 to;
uniform mat4 matrix;
uniform vec2 size;      // of the picture in pixels
uniform float width;
uniform vec3 eye;
const float k_nearer = 0.997;  // a little towards the eye, so that the surface hides no half of a line
void main() {
  vec4 a = matrix * vec4(mix(eye, from, k_nearer), 1.0);
  vec4 b = matrix * vec4(mix(eye, to, k_nearer), 1.0);
  float least = 1e-5 * max(a.w, b.w);
  a.w = max(a.w, least);
  b.w = max(b.w, least);
  vec2 along = (b.xy / b.w - a.xy / a.w) * size;
  float l = length(along);
  vec2 direction = l > 0.0 ? along / l : vec2(1.0, 0.0);
  vec2 across = vec2(-direction.y, direction.x);
  vec4 p = end.x < 0.5 ? a : b;
  vec2 offset = (across * end.y + direction * (2.0 * end.x - 1.0) * 0.5) * width / size;
  gl_Position = p + vec4(offset * p.w, 0.0, 0.0);
}`;

const k_line_fragment = `#version 300 es
precision highp float;
uniform vec3 tint;
out vec4 colour;
void main() { colour = vec4(tint, 1.0); }`;

const k_dot_vertex = `#version 300 es
in vec3 from;
uniform mat4 matrix;
uniform float width;
uniform vec3 eye;
void main() {
  gl_Position = matrix * vec4(mix(eye, from, 0.994), 1.0);
  gl_PointSize = width;
}`;

const k_dot_fragment = `#version 300 es
precision highp float;
uniform vec3 tint;
uniform vec3 rim;
out vec4 colour;
void main() {
  float r = length(gl_PointCoord - 0.5);
  if (r > 0.5) discard;
  colour = vec4(r > 0.36 ? rim : tint, 1.0);
}`;

function compile(gl, type, source) {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) {
    throw new Error(gl.getShaderInfoLog(shader));
  }
  return shader;
}

function link(gl, vertex, fragment) {
  const program = gl.createProgram();
  gl.attachShader(program, compile(gl, gl.VERTEX_SHADER, vertex));
  gl.attachShader(program, compile(gl, gl.FRAGMENT_SHADER, fragment));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    throw new Error(gl.getProgramInfoLog(program));
  }
  const uniforms = {};
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS);
  for (let i = 0; i < count; ++i) {
    const { name } = gl.getActiveUniform(program, i);
    uniforms[name] = gl.getUniformLocation(program, name);
  }
  return { program, uniforms };
}

function attribute(gl, { program }, name, data, components, divisor = 0) {
  const location = gl.getAttribLocation(program, name);
  if (location < 0) return;
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
  gl.enableVertexAttribArray(location);
  const type = data instanceof Uint8Array ? gl.UNSIGNED_BYTE
    : data instanceof Int16Array ? gl.SHORT : gl.FLOAT;
  gl.vertexAttribPointer(location, components, type, type !== gl.FLOAT, 0, 0);
  gl.vertexAttribDivisor(location, divisor);
}

// Neighbouring numbers get hues far apart (the golden ratio's).
export function patchColour(patch) {
  const hue = 6 * ((patch * 0.6180339887) % 1);
  const lightness = 0.62 + 0.1 * (patch % 3);
  const channel = (shift) => {
    const x = Math.abs(((hue + shift) % 6) - 3) - 1;
    return Math.round(255 * (lightness + 0.42 * (Math.max(0, Math.min(1, x)) - 0.55)));
  };
  return [channel(0), channel(4), channel(2)];
}

export class Renderer {
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error("This page needs WebGL 2, which this browser does not offer.");
    this.gl = gl;
    this.surfaceProgram = link(gl, k_surface_vertex, k_surface_fragment);
    this.lineProgram = link(gl, k_line_vertex, k_line_fragment);
    this.dotProgram = link(gl, k_dot_vertex, k_dot_fragment);
    this.arrays = [];
  }

  newArray() {
    const array = this.gl.createVertexArray();
    this.gl.bindVertexArray(array);
    this.arrays.push(array);
    return array;
  }

  load(scene) {
    for (const array of this.arrays) this.gl.deleteVertexArray(array);
    this.arrays = [];
    this.loadSurface(scene);
    const samples = lineOfSamples(scene);
    this.lines = {
      samples: this.loadLines(...samples),
      normals: this.loadLines(...linesOfNormals(scene)),
      curves: this.loadLines(...linesOfEdges(scene.positions, scene.edges)),
      boundary: this.loadLines(...linesOfEdges(scene.positions, scene.boundary)),
    };
    this.dots = {
      points: this.loadDots(scene.samples),
      nodes: this.loadDots(scene.nodes),
      marks: this.loadDots(new Float32Array(scene.marks.flatMap((mark) => mark.at))),
    };
  }

  loadSurface(scene) {
    const { triangles, positions, normals, curvature, patch, creaseCorners, creaseNormals } = scene;
    const count = triangles.length;
    const corners = {
      position: new Float32Array(3 * count),
      normal: new Int16Array(3 * count),
      curvature: new Float32Array(count),
      tint: new Uint8Array(3 * count),
    };
    const colours = new Map();
    for (let h = 0; h < count; ++h) {
      const v = triangles[h];
      const p = patch[Math.floor(h / 3)];
      if (!colours.has(p)) colours.set(p, patchColour(p));
      const colour = colours.get(p);
      for (let k = 0; k < 3; ++k) {
        corners.position[3 * h + k] = positions[3 * v + k];
        corners.normal[3 * h + k] = normals[3 * v + k];
        corners.tint[3 * h + k] = colour[k];
      }
      corners.curvature[h] = curvature[v];
    }
    creaseCorners.forEach((h, i) => {
      for (let k = 0; k < 3; ++k) corners.normal[3 * h + k] = creaseNormals[3 * i + k];
    });
    this.surface = { array: this.newArray(), count };
    attribute(this.gl, this.surfaceProgram, "position", corners.position, 3);
    attribute(this.gl, this.surfaceProgram, "normal", corners.normal, 3);
    attribute(this.gl, this.surfaceProgram, "curvature", corners.curvature, 1);
    attribute(this.gl, this.surfaceProgram, "tint", corners.tint, 3);
  }

  loadLines(from, to) {
    const lines = { array: this.newArray(), count: from.length / 3 };
    const ends = new Float32Array([0, -1, 1, -1, 0, 1, 1, 1]);
    attribute(this.gl, this.lineProgram, "end", ends, 2);
    attribute(this.gl, this.lineProgram, "from", from, 3, 1);
    attribute(this.gl, this.lineProgram, "to", to, 3, 1);
    return lines;
  }

  loadDots(points) {
    const dots = { array: this.newArray(), count: points.length / 3 };
    attribute(this.gl, this.dotProgram, "from", points, 3);
    return dots;
  }

  // `layers` says what is shown, `theme` the colours (three numbers from 0 to 1 each).
  draw(scene, camera, layers, theme, light) {
    const { gl } = this;
    const { width, height } = gl.canvas;
    const matrix = camera.matrix(width / height);
    gl.viewport(0, 0, width, height);
    gl.clearColor(...theme.ground, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    if (layers.surface) this.drawSurface(scene, camera, layers, theme, light, matrix);

    const eye = camera.eye();
    const scale = gl.canvas.width / Math.max(1, gl.canvas.clientWidth);
    const line = (name, colour, size) => this.drawLines(this.lines[name], colour, size * scale, matrix, eye);
    const dot = (name, colour, size) =>
      this.drawDots(this.dots[name], colour, theme.ground, size * scale, matrix, eye);
    if (layers.curves) line("curves", theme.curve, 2.2);
    if (layers.boundary) line("boundary", theme.boundary, 3.2);
    if (layers.samples) {
      line("samples", theme.sample, 1.4);
      dot("points", theme.sample, 4.5);
    }
    if (layers.normals) line("normals", theme.normal, 1.2);
    if (layers.nodes) dot("nodes", theme.node, 8);
    if (layers.marks) dot("marks", theme.mark, 13);
  }

  drawSurface(scene, camera, layers, theme, light, matrix) {
    const { gl } = this;
    const { program, uniforms } = this.surfaceProgram;
    gl.useProgram(program);
    gl.uniformMatrix4fv(uniforms.matrix, false, matrix);
    gl.uniform1i(uniforms.look, layers.look);
    gl.uniform1i(uniforms.wires, layers.wires ? 1 : 0);
    gl.uniform3fv(uniforms.light, light);
    gl.uniform3fv(uniforms.eye, camera.eye());
    gl.uniform1f(uniforms.range, scene.curvatureRange);
    gl.uniform3fv(uniforms.front, theme.front);
    gl.uniform3fv(uniforms.back, theme.back);
    gl.bindVertexArray(this.surface.array);
    gl.drawArrays(gl.TRIANGLES, 0, this.surface.count);
  }

  drawLines(lines, colour, width, matrix, eye) {
    if (lines.count === 0) return;
    const { gl } = this;
    const { program, uniforms } = this.lineProgram;
    gl.useProgram(program);
    gl.uniformMatrix4fv(uniforms.matrix, false, matrix);
    gl.uniform2f(uniforms.size, gl.canvas.width, gl.canvas.height);
    gl.uniform1f(uniforms.width, width);
    gl.uniform3fv(uniforms.eye, eye);
    gl.uniform3fv(uniforms.tint, colour);
    gl.bindVertexArray(lines.array);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, lines.count);
  }

  drawDots(dots, colour, rim, size, matrix, eye) {
    if (dots.count === 0) return;
    const { gl } = this;
    const { program, uniforms } = this.dotProgram;
    gl.useProgram(program);
    gl.uniformMatrix4fv(uniforms.matrix, false, matrix);
    gl.uniform1f(uniforms.width, size);
    gl.uniform3fv(uniforms.eye, eye);
    gl.uniform3fv(uniforms.tint, colour);
    gl.uniform3fv(uniforms.rim, rim);
    gl.bindVertexArray(dots.array);
    gl.drawArrays(gl.POINTS, 0, dots.count);
  }
}

// ---- Lines from the scene's arrays: where each begins and where it ends ---------------------------

function linesOfEdges(positions, edges) {
  const from = new Float32Array(1.5 * edges.length);
  const to = new Float32Array(1.5 * edges.length);
  for (let e = 0; 2 * e < edges.length; ++e) {
    for (let k = 0; k < 3; ++k) {
      from[3 * e + k] = positions[3 * edges[2 * e] + k];
      to[3 * e + k] = positions[3 * edges[2 * e + 1] + k];
    }
  }
  return [from, to];
}

function lineOfSamples(scene) {
  const edges = [];
  for (let c = 0; c < scene.curveClosed.length; ++c) {
    const first = scene.curveStart[c];
    const end = scene.curveStart[c + 1];
    for (let i = first; i + 1 < end; ++i) edges.push(i, i + 1);
    if (scene.curveClosed[c] && end - first > 1) edges.push(end - 1, first);
  }
  return linesOfEdges(scene.samples, edges);
}

// Hairs of a thirtieth of the object's size; at most a few thousand, evenly chosen.
function linesOfNormals(scene) {
  const count = scene.sampleNormals.length / 3;
  const step = Math.max(1, Math.ceil(count / 4000));
  const size = scene.bounds.radius / 15;
  const from = [];
  const to = [];
  for (let i = 0; i < count; i += step) {
    for (let k = 0; k < 3; ++k) {
      from.push(scene.samples[3 * i + k]);
      to.push(scene.samples[3 * i + k] + (size * scene.sampleNormals[3 * i + k]) / 32767);
    }
  }
  return [new Float32Array(from), new Float32Array(to)];
}
