// The page round the library: a file in, a surface on the screen. The command itself runs in a worker
// (worker.js), so the page stays awake, and cancelling ends the worker at once.

import { sceneFromBase64 } from "./scene.js";
import { Viewer, byId } from "./viewer.js";

const k_examples = ["spot.net", "torus.net", "bumpy.net", "sphere.net", "saddle.obj", "cylinder.net"];
const k_saved = { OBJ: "obj", PLY: "ply", STL: "stl", Page: "html" };

const k_form = `
  <div class="drop" id="drop">
    <label class="button">Open a file<input type="file" id="file" hidden></label>
    <p class="small">or drop one here: curves in any format the command reads. Nothing leaves this computer.</p>
  </div>
  <div class="fields">
    <label for="example">Example</label><select id="example"><option value="">–</option></select>
    <label for="method">Method</label><select id="method">
      <option>fair</option><option>iterated</option><option>stanko</option><option>biharmonic</option>
      <option>triharmonic</option></select>
    <label for="spacing">Spacing</label><input id="spacing" type="text" inputmode="decimal" placeholder="automatic">
    <label for="soft">Soft</label><input id="soft" type="text" inputmode="decimal" placeholder="curves hold">
    <label for="topology">Patches</label><select id="topology"><option value="auto">automatic</option>
      <option value="normals">by normals</option><option value="flow">by curves alone</option></select>
    <label for="voids">Voids</label><input id="voids" type="text" inputmode="numeric" placeholder="automatic">
    <label for="snap">Snap</label><input id="snap" type="text" inputmode="decimal" placeholder="automatic">
  </div>
  <div class="buttons">
    <button type="button" id="run" class="first" disabled>Surface</button>
    <button type="button" id="cancel" disabled>Cancel</button>
  </div>
  <p class="small" id="state" role="status"></p>
  <progress id="progress" max="1" value="0" hidden></progress>
  <p class="small error" id="error" role="alert"></p>
  <div class="buttons" id="save" hidden></div>`;

class App {
  constructor() {
    this.viewer = new Viewer();
    byId("app").innerHTML = k_form;
    byId("title").textContent = "wireskin";
    for (const name of k_examples) byId("example").add(new Option(name));
    this.connect();
    this.startWorker();
    const wanted = new URLSearchParams(location.search).get("example");
    this.openExample(k_examples.includes(wanted) ? wanted : k_examples[0]);
  }

  connect() {
    byId("file").addEventListener("change", (event) => this.openFile(event.target.files[0]));
    byId("example").addEventListener("change", (event) => {
      if (event.target.value) this.openExample(event.target.value);
    });
    byId("run").addEventListener("click", () => this.run());
    byId("cancel").addEventListener("click", () => this.cancel());
    for (const [label, type] of Object.entries(k_saved)) {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = `Save ${label}`;
      button.addEventListener("click", () => this.save(type));
      byId("save").append(button);
    }
    document.addEventListener("dragover", (event) => {
      event.preventDefault();
      document.body.classList.add("dragging");
    });
    document.addEventListener("dragleave", () => document.body.classList.remove("dragging"));
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      document.body.classList.remove("dragging");
      this.openFile(event.dataTransfer.files[0]);
    });
  }

  startWorker() {
    this.worker = new Worker("worker.js");
    this.worker.onmessage = ({ data }) => this.take(data);
    this.worker.onerror = (event) => this.finish(`The worker could not run: ${event.message}`);
  }

  async openExample(name) {
    try {
      const response = await fetch(`data/${name}`);
      if (!response.ok) throw new Error(`${response.status} ${response.statusText}`);
      byId("example").value = name;
      this.open(name, await response.arrayBuffer(), name === "spot.net" ? "y" : "z");
    } catch (error) {
      this.finish(`The example could not be loaded (${error.message}): serve the page by a web server.`);
    }
  }

  async openFile(file) {
    if (!file) return;
    byId("example").value = "";
    this.open(file.name, await file.arrayBuffer(), "z");
  }

  open(name, bytes, up) {
    this.input = { name, bytes, up };
    byId("run").disabled = false;
    this.run();
  }

  options() {
    const words = ["--topology", byId("topology").value];
    // The default is not spelled out: the command says so where a method given has no effect.
    if (byId("method").value !== "fair") words.push("--method", byId("method").value);
    for (const name of ["spacing", "soft", "voids", "snap"]) {
      if (byId(name).value.trim()) words.push(`--${name}`, byId(name).value.trim());
    }
    return words;
  }

  run() {
    if (!this.input) return;
    if (this.running) this.cancel();
    this.running = true;
    byId("cancel").disabled = false;
    byId("error").textContent = "";
    byId("progress").hidden = false;
    byId("progress").removeAttribute("value");
    byId("state").textContent = `${this.input.name} …`;
    this.worker.postMessage({ ...this.input, options: this.options() });
  }

  // A worker that computes hears nothing: it is ended, and a new one waits.
  cancel() {
    if (!this.running) return;
    this.worker.terminate();
    this.startWorker();
    this.finish("");
    byId("state").textContent = "Cancelled.";
  }

  take(message) {
    if (message.progress) {
      byId("state").textContent = `${this.input.name}: ${message.progress.stage}`;
      if (message.progress.fraction > 0) byId("progress").value = message.progress.fraction;
      else byId("progress").removeAttribute("value");
    } else if (message.error) {
      this.finish(message.error);
    } else {
      this.files = message.files;
      const page = new TextDecoder().decode(this.files.html);
      const start = page.indexOf(">", page.indexOf('id="scene"')) + 1;
      this.viewer.show(sceneFromBase64(page.slice(start, page.indexOf("<\/script>", start))));
      this.finish("");
      byId("save").hidden = false;
      byId("state").textContent = message.line.replace(/^out\.[^:]*: /, "");  // not the worker's files
    }
  }

  finish(error) {
    this.running = false;
    byId("cancel").disabled = true;
    byId("progress").hidden = true;
    byId("state").textContent = "";
    byId("error").textContent = error;
    document.body.dataset.error = error;
  }

  save(type) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([this.files[type]]));
    link.download = `${this.input.name.replace(/\.[^.]*$/, "")}-surface.${type}`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }
}

try {
  new App();
} catch (error) {
  byId("word").textContent = error.message;
  byId("word").hidden = false;
}
