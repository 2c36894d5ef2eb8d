// What the page shows, read from the compact form that the command writes (write_page.cpp): a
// 32-bit length, a JSON header of that length, then arrays of little-endian numbers, each beginning at
// a multiple of four bytes. Positions are relative to header.origin, so that 32 bits hold them well.

const k_types = { f32: Float32Array, u32: Uint32Array, i16: Int16Array };

export function readScene(buffer) {
  const view = new DataView(buffer);
  const headerLength = view.getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, headerLength)));
  const start = 4 * Math.ceil((4 + headerLength) / 4);
  const scene = { ...header };
  for (const array of header.arrays) {
    scene[array.name] = new k_types[array.type](buffer, start + array.offset, array.count);
  }
  scene.boundary = boundaryEdges(scene.triangles);
  scene.bounds = boundsOf(scene);
  scene.curvatureRange = curvatureRange(scene.curvature);
  return scene;
}

export function sceneFromBase64(text) {
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return readScene(bytes.buffer);
}

export function point(array, i) {
  return [array[3 * i], array[3 * i + 1], array[3 * i + 2]];
}

// Edges with one triangle. Keys are numbers as long as vertices are fewer than 2^26.
function boundaryEdges(triangles) {
  const seen = new Map();
  for (let h = 0; h < triangles.length; ++h) {
    const a = triangles[h];
    const b = triangles[h % 3 === 2 ? h - 2 : h + 1];
    const key = Math.min(a, b) * 67108864 + Math.max(a, b);
    if (seen.has(key)) seen.set(key, -1);
    else seen.set(key, h);
  }
  const edges = [];
  for (const h of seen.values()) {
    if (h >= 0) edges.push(triangles[h], triangles[h % 3 === 2 ? h - 2 : h + 1]);
  }
  return new Uint32Array(edges);
}

// The middle of the box of surface and samples, and the radius of the ball round it that holds both.
function boundsOf(scene) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const array of [scene.positions, scene.samples]) {
    for (let i = 0; i < array.length; ++i) {
      const axis = i % 3;
      if (array[i] < low[axis]) low[axis] = array[i];
      if (array[i] > high[axis]) high[axis] = array[i];
    }
  }
  const centre = [0, 1, 2].map((k) => (low[k] + high[k]) / 2);
  let radius = 0;
  for (const array of [scene.positions, scene.samples]) {
    for (let i = 0; i < array.length; i += 3) {
      radius = Math.max(
        radius, Math.hypot(array[i] - centre[0], array[i + 1] - centre[1], array[i + 2] - centre[2]));
    }
  }
  return { centre, radius: radius > 0 ? radius : 1 };
}

// What 98 of 100 vertices stay below: a few wild ones must not bleach the rest.
function curvatureRange(curvature) {
  const sizes = Float32Array.from(curvature, Math.abs).sort();
  const range = sizes.length ? sizes[Math.floor(0.98 * (sizes.length - 1))] : 0;
  return range > 0 ? range : 1;
}
