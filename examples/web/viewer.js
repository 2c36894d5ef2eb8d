// The page: canvas, pointer, keys, layers and report. One viewer for a result that opens from disk and
// for the application round the library.

import { Camera } from "./camera.js";
import { add, cross, dot, scaled, sub, unit } from "./vec.js";
import { Renderer } from "./renderer.js";
import { point } from "./scene.js";

export const byId = (id) => document.getElementById(id);

// A CSS colour variable as three numbers from 0 to 1.
function themeColour(name) {
  const text = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  return [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16) / 255);
}

function readTheme() {
  const theme = {};
  for (const name of ["ground", "front", "back", "curve", "boundary", "sample", "normal", "node", "mark"]) {
    theme[name] = themeColour(name);
  }
  return theme;
}

export function formatNumber(value) {
  if (value === null || value === undefined) return "–";
  if (typeof value !== "number") return String(value);
  if (Number.isInteger(value)) return value.toLocaleString("en");
  const size = Math.abs(value);
  return size >= 1e-3 && size < 1e5 ? String(+value.toPrecision(4)) : value.toExponential(2);
}

// The nearest triangle that a ray meets, or null. Source: T. Moeller, B. Trumbore, "Fast, Minimum
// Storage Ray/Triangle Intersection", 1997.
function pick(scene, { origin, direction }) {
  let best = null;
  for (let t = 0; 3 * t < scene.triangles.length; ++t) {
    const a = point(scene.positions, scene.triangles[3 * t]);
    const ab = sub(point(scene.positions, scene.triangles[3 * t + 1]), a);
    const ac = sub(point(scene.positions, scene.triangles[3 * t + 2]), a);
    const p = cross(direction, ac);
    const determinant = dot(ab, p);
    if (determinant === 0) continue;
    const s = sub(origin, a);
    const u = dot(s, p) / determinant;
    if (u < 0 || u > 1) continue;
    const q = cross(s, ab);
    const v = dot(direction, q) / determinant;
    if (v < 0 || u + v > 1) continue;
    const distance = dot(ac, q) / determinant;
    if (distance > 0 && (!best || distance < best.distance)) best = { distance, triangle: t };
  }
  if (best) best.place = add(origin, scaled(direction, best.distance));
  return best;
}

const k_report = [
  ["Method", "method"], ["Status", "status"], ["Curves", "curves"], ["Nodes", "nodes"], ["Segments", "segments"],
  ["Patches", "patches"], ["Vertices", "vertices"], ["Triangles", "triangles"], ["Components", "components"],
  ["Boundary loops", "boundary_loops"], ["Euler characteristic", "euler_characteristic"],
  ["Betti numbers", "flow.betti"], ["Open patches", "flow.open_patches"], ["Bare segments", "flow.bare_segments"],
  ["Spacing", "spacing"], ["Least angle", "min_angle_deg", "°"],
  ["Noise found", "noise_position"], ["Greatest distance from a sample", "constraint_distance_max"],
  ["Mean normal deviation", "normal_deviation_mean_deg", "°"], ["Mean angle across curves", "dihedral_mean_deg", "°"],
  ["Joints snapped", "preparation.snaps"], ["Open ends", "preparation.after.dangling_ends"], ["Left out patches", "failed_patches"], ["Borders found", "found_borders"], ["Minimal-area patches", "minimal_area_patches"], ["Guarded patches", "guarded_patches"],
  ["Factorisations", "factorisations"], ["Peak memory", "peak_bytes", " bytes"], ["Time", "total_ms", " ms"],
];

export class Viewer {
  constructor() {
    this.canvas = byId("view");
    this.scene = null;
    this.layers = { look: 1 };
    this.lightTurn = [-0.35, 0.45];
    this.pointers = new Map();
    this.renderer = new Renderer(this.canvas);
    this.camera = new Camera(2);
    this.theme = readTheme();
    this.connectPanel();
    this.connectPointers();
    this.connectKeys();
    new ResizeObserver(() => this.resize()).observe(byId("stage"));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.retheme());
    this.canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.say("The graphics device was lost. Reload the page.");
    });
    this.resize();
  }

  show(scene) {
    this.scene = scene;
    byId("title").textContent = scene.title;
    document.title = `${scene.title} – wireskin`;
    this.camera = new Camera(scene.up ?? 2);
    this.renderer.load(scene);
    this.camera.fit(scene.bounds, this.aspect());
    this.showReport(scene.report);
    this.showMarks(scene.marks);
    const range = formatNumber(scene.curvatureRange);
    const [low, , high] = byId("scale").children;
    low.textContent = `−${range}`;
    high.textContent = range;
    this.say("");
    this.refresh();
    document.body.dataset.ready = String(Number(document.body.dataset.ready || 0) + 1);
  }

  say(text) {
    byId("word").textContent = text;
    byId("word").hidden = text === "";
  }

  aspect() {
    return this.canvas.width / Math.max(1, this.canvas.height);
  }

  resize() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    this.canvas.width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
    this.canvas.height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
    this.refresh();
  }

  retheme() {
    this.theme = readTheme();
    this.refresh();
  }

  // Draws once before the next frame, however often it is called until then.
  refresh() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      if (!this.scene) return;
      this.renderer.draw(this.scene, this.camera, this.layers, this.theme, this.light());
      this.drawAxes();
    });
  }

  // The light hangs on the eye: turning the object moves the stripes over it.
  light() {
    const { right, up, toward } = this.camera.frame();
    const [x, y] = this.lightTurn;
    return unit(add(toward, add(scaled(right, x), scaled(up, y))));
  }

  // ---- Panel ----

  connectPanel() {
    for (const box of document.querySelectorAll("[data-layer]")) {
      this.layers[box.dataset.layer] = box.checked;
      box.addEventListener("change", () => {
        this.layers[box.dataset.layer] = box.checked;
        this.refresh();
      });
    }
    for (const radio of document.querySelectorAll("[name=look]")) {
      radio.addEventListener("change", () => this.setLook(Number(radio.value)));
      if (radio.checked) this.setLook(Number(radio.value));
    }
    for (const button of document.querySelectorAll("[data-view]")) {
      button.addEventListener("click", (event) => this.setView(button.dataset.view, event.shiftKey));
    }
    byId("theme").addEventListener("click", () => this.switchTheme());
  }

  setLook(look) {
    this.layers.look = look;
    document.querySelector(`[name=look][value="${look}"]`).checked = true;
    byId("legend").hidden = look !== 2;
    this.refresh();
  }

  setView(view, fromBehind) {
    if (!this.scene) return;
    if (view === "fit") this.camera.fit(this.scene.bounds, this.aspect());
    else this.camera.along(Number(view), fromBehind ? -1 : 1);
    this.refresh();
  }

  switchTheme() {
    const root = document.documentElement;
    const dark = root.dataset.theme
      ? root.dataset.theme === "dark"
      : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
    this.retheme();
  }

  showReport(report) {
    const valueOf = (key) => key.split(".").reduce((object, name) => object?.[name], report);
    const rows = k_report
      .map(([name, key, unitText]) => [name, key, valueOf(key), unitText])
      .filter(([, , value]) => value !== undefined && value !== null)
      .map(([name, key, value, unitText]) => {
        const row = document.createElement("tr");
        const number = Array.isArray(value) ? value.length : value;
        const text = key === "flow.betti" ? value.join(", ") : formatNumber(number) + (unitText ?? "");
        for (const cell of [name, text]) row.insertCell().textContent = cell;
        return row;
      });
    byId("report").replaceChildren(...rows);
  }

  showMarks(marks) {
    byId("marks-row").hidden = marks.length === 0;
    const items = marks.map((mark) => {
      const item = document.createElement("li");
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = mark.text;
      button.addEventListener("click", () => this.lookAt(mark.at));
      item.append(button);
      return item;
    });
    byId("marks").replaceChildren(...items);
  }

  lookAt(place) {
    this.camera.pivot = place.slice();
    this.camera.distance = Math.min(this.camera.distance, this.scene.bounds.radius);
    this.refresh();
  }

  drawAxes() {
    const { right, up, toward } = this.camera.frame();
    const colours = ["#d8402f", "#2f9e4f", "#3b7de0"];
    const axes = [0, 1, 2].map((k) => ({ k, x: 34 * right[k], y: -34 * up[k], depth: toward[k] }));
    axes.sort((a, b) => a.depth - b.depth);
    byId("axes").firstElementChild.innerHTML = axes
      .map(({ k, x, y }) => `<line x2="${x}" y2="${y}" stroke="${colours[k]}"/>` +
        `<text x="${1.3 * x}" y="${1.3 * y}" fill="${colours[k]}">${"XYZ"[k]}</text>`)
      .join("");
  }

  // ---- Pointer ----

  connectPointers() {
    const { canvas } = this;
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    for (const name of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(name, (event) => this.pointers.delete(event.pointerId));
    }
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("dblclick", (event) => {
      const found = this.scene && pick(this.scene, this.rayAt(event));
      if (found) this.camera.pivot = found.place;
      this.refresh();
    });
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 16 : 1;
      this.camera.zoom(Math.exp(0.0012 * lines * event.deltaY));
      this.refresh();
    }, { passive: false });
  }

  rayAt(event) {
    const box = this.canvas.getBoundingClientRect();
    const x = (2 * (event.clientX - box.left)) / box.width - 1;
    const y = 1 - (2 * (event.clientY - box.top)) / box.height;
    return this.camera.ray(x, y, this.aspect());
  }

  move(event) {
    const last = this.pointers.get(event.pointerId);
    if (!last) {
      this.hintAt(event);
      return;
    }
    const height = this.canvas.clientHeight;
    const dx = (event.clientX - last[0]) / height;
    const dy = (event.clientY - last[1]) / height;
    if (this.pointers.size === 2) {
      this.pinch(event, dx, dy);
    } else if (event.altKey) {
      this.lightTurn[0] += 3 * dx;
      this.lightTurn[1] -= 3 * dy;
    } else if (event.shiftKey || event.buttons & 6) {
      this.camera.pan(dx, dy);
    } else {
      this.camera.turn(4 * dx, 4 * dy);
    }
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    this.refresh();
  }

  // Two fingers: their distance zooms, their middle moves.
  pinch(event, dx, dy) {
    const [other] = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, p]) => p);
    const last = this.pointers.get(event.pointerId);
    const before = Math.hypot(last[0] - other[0], last[1] - other[1]);
    const after = Math.hypot(event.clientX - other[0], event.clientY - other[1]);
    if (before > 0 && after > 0) this.camera.zoom(before / after);
    this.camera.pan(dx / 2, dy / 2);
  }

  // What the mark under the pointer says.
  hintAt(event) {
    const hint = byId("hint");
    const marks = this.scene && this.layers.marks ? this.scene.marks : [];
    const { origin, direction } = marks.length ? this.rayAt(event) : {};
    const near = marks.find((mark) => {
      const to = sub(mark.at, origin);
      const away = sub(to, scaled(direction, dot(to, direction)));
      return Math.hypot(...away) < 0.012 * this.camera.distance;
    });
    hint.hidden = !near;
    if (!near) return;
    const box = this.canvas.getBoundingClientRect();
    hint.textContent = near.text;
    hint.style.left = `${event.clientX - box.left}px`;
    hint.style.top = `${event.clientY - box.top}px`;
  }

  // ---- Keys ----

  connectKeys() {
    const layerKeys = { s: "surface", w: "wires", c: "curves", b: "boundary", g: "samples", n: "normals", o: "nodes", m: "marks" };
    document.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.target.matches("select, input[type=text], input[type=number]")) return;
      const key = event.key.toLowerCase();
      const arrows = { arrowleft: [-1, 0], arrowright: [1, 0], arrowup: [0, -1], arrowdown: [0, 1] };
      if (layerKeys[key]) {
        document.querySelector(`[data-layer=${layerKeys[key]}]`).click();
      } else if (arrows[key] && event.target === this.canvas) {
        const [dx, dy] = arrows[key];
        if (event.shiftKey) this.camera.pan(0.05 * dx, 0.05 * dy);
        else this.camera.turn(0.12 * dx, 0.12 * dy);
      } else if (key === "+" || key === "=") {
        this.camera.zoom(0.87);
      } else if (key === "-") {
        this.camera.zoom(1.15);
      } else if (key === "f") {
        this.setView("fit");
      } else if ("xyz".includes(key) && key.length === 1) {
        this.setView("xyz".indexOf(key), event.shiftKey);
      } else if ("1234".includes(key) && key.length === 1) {
        this.setLook(Number(key) - 1);
      } else if (key === "d") {
        this.switchTheme();
      } else {
        return;
      }
      event.preventDefault();
      this.refresh();
    });
  }
}
