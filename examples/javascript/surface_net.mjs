// Surfaces a network in T. Stanko's format (.net) and writes the mesh as OBJ. The library is a
// WebAssembly module that imports nothing, so the same lines serve a page. Made by
//
//     clang++ --target=wasm32-wasi -std=c++17 -O2 -fno-exceptions -fno-rtti -fno-threadsafe-statics
//         -I../../single_include -x c++ -DWIRESKIN_IMPLEMENTATION -c ../../single_include/wireskin.h
//         -o wireskin.o
//     clang --target=wasm32-wasi -mexec-model=reactor wireskin.o -lm -o wireskin.wasm
//         -Wl,--export=malloc,--export=free,--export=wsk_build,--export=wsk_status_name
//         -Wl,--export=wsk_surface_get_view,--export=wsk_surface_free
//     node surface_net.mjs wireskin.wasm ../data/sphere.net sphere.obj
import { readFile, writeFile } from "node:fs/promises";

const CURVE_BYTES = 56; // sizeof(wsk_curve), and below the places of its fields, with 32-bit pointers
const VIEW_BYTES = 48; // wsk_surface_view as far as `triangles`: the library writes no more than it is told

async function load(bytes) {
  const { instance } = await WebAssembly.instantiate(bytes, {});
  instance.exports._initialize?.();
  return instance.exports;
}

// Curves as {positions, normals: Float64Array, nodes: Uint32Array, closed, boundary}.
function readNet(text) {
  const lines = text.split("\n").filter((line) => line.trim());
  const numbers = () => lines.shift().trim().split(/\s+/).map(Number);
  const vertices = Array.from({ length: numbers()[0] }, numbers);
  return Array.from({ length: numbers()[0] }, () => {
    const [boundary] = numbers();
    const nodes = numbers();
    const closed = nodes[0] === nodes.at(-1);
    if (closed) nodes.pop();
    const positions = Float64Array.from(nodes.flatMap((i) => vertices[i].slice(0, 3)));
    const normals = Float64Array.from(nodes.flatMap((i) => vertices[i].slice(3, 6)));
    return { positions, normals, nodes: Uint32Array.from(nodes), closed, boundary };
  });
}

// {positions: Float64Array, triangles: Uint32Array}, three numbers an element.
function build(wasm, network) {
  const taken = [];
  const allocate = (bytes) => {
    const at = wasm.malloc(bytes);
    if (at === 0) throw new Error("out of memory");
    taken.push(at);
    return at;
  };
  // Memory may grow with every call, so views of it are made when they are used.
  const put = (array) => {
    const at = allocate(array.byteLength);
    new array.constructor(wasm.memory.buffer, at, array.length).set(array);
    return at;
  };
  try {
    const curves = allocate(CURVE_BYTES * network.length);
    network.forEach(({ positions, normals, nodes, closed, boundary }, i) => {
      const pointers = [put(positions), put(normals), put(nodes)];
      const field = new Int32Array(wasm.memory.buffer, curves + CURVE_BYTES * i, CURVE_BYTES / 4).fill(0);
      [field[0], field[1], field[3], field[5]] = [nodes.length, ...pointers];
      [field[6], field[7]] = [closed, boundary];
    });
    const handle = allocate(4);
    const status = wasm.wsk_build(curves, network.length, 0, handle, 0);
    if (status !== 0) {
      const name = new Uint8Array(wasm.memory.buffer, wasm.wsk_status_name(status), 64);
      throw new Error(new TextDecoder().decode(name.subarray(0, name.indexOf(0))));
    }
    const surface = new Uint32Array(wasm.memory.buffer, handle, 1)[0];
    const view = allocate(VIEW_BYTES);
    wasm.wsk_surface_get_view(surface, view, VIEW_BYTES);
    const field = new Uint32Array(wasm.memory.buffer, view, VIEW_BYTES / 4);
    const positions = new Float64Array(wasm.memory.buffer, field[5], 3 * field[1]).slice();
    const triangles = new Uint32Array(wasm.memory.buffer, field[11], 3 * field[2]).slice();
    wasm.wsk_surface_free(surface);
    return { positions, triangles };
  } finally {
    taken.forEach((at) => wasm.free(at));
  }
}

const rows = (letter, array, format) =>
  Array.from({ length: array.length / 3 }, (_, i) =>
    `${letter} ${Array.from(array.subarray(3 * i, 3 * i + 3), format).join(" ")}\n`).join("");

const [module, input, output] = process.argv.slice(2);
if (!output) {
  console.error("usage: surface_net.mjs MODULE.wasm INPUT.net OUTPUT.obj");
  process.exit(2);
}
const wasm = await load(await readFile(module));
const { positions, triangles } = build(wasm, readNet(await readFile(input, "utf8")));
await writeFile(output, rows("v", positions, String) + rows("f", triangles, (i) => i + 1));
console.log(`${positions.length / 3} vertices, ${triangles.length / 3} triangles`);
