// node page_test.mjs CHROMIUM COMMAND DATA WORK [WEB]
//
// Opens a result made by the command (--html) and, where WEB is given, the page round the library in a
// headless browser, and looks at the pixels: surface, stripes, curves, each layer. Leaves screenshots
// in WORK.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser, serve } from "./browser.mjs";

const [program, command, data, work, web] = process.argv.slice(2);
await mkdir(work, { recursive: true });

// Counts of pixels of the canvas after the next frame: all that differ from the ground, those near the
// colour of the curves, of the border, dark ones and light ones, and how many hues there are.
const k_look = `new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => {
  const view = document.getElementById("view");
  const copy = document.createElement("canvas");
  copy.width = view.width; copy.height = view.height;
  const context = copy.getContext("2d");
  context.drawImage(view, 0, 0);
  const { data } = context.getImageData(0, 0, copy.width, copy.height);
  const colour = (name) => { const t = getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
    return [1, 3, 5].map((i) => parseInt(t.slice(i, i + 2), 16)); };
  const near = (i, c) => Math.abs(data[i] - c[0]) + Math.abs(data[i + 1] - c[1]) + Math.abs(data[i + 2] - c[2]) < 24;
  const ground = colour("ground"), names = ["curve", "boundary", "sample", "normal", "node"];
  const colours = names.map(colour);
  const found = { all: 0, dark: 0, light: 0, hues: 0, sum: 0 };
  for (const name of names) found[name] = 0;
  const hues = new Set();
  for (let i = 0; i < data.length; i += 4) {
    found.sum = (found.sum * 31 + data[i] + 256 * data[i + 1] + 65536 * data[i + 2]) % 4294967296;
    if (near(i, ground)) continue;
    ++found.all;
    const size = data[i] + data[i + 1] + data[i + 2];
    if (size < 260) ++found.dark;
    if (size > 480) ++found.light;
    colours.forEach((c, k) => { if (near(i, c)) ++found[names[k]]; });
    const m = Math.max(data[i], data[i + 1], data[i + 2]);
    if (m > 60) hues.add([0, 1, 2].map((k) => Math.round((6 * data[i + k]) / m)).join());
  }
  found.hues = hues.size;
  resolve(found);
})))`;

const browser = await Browser.start(program);
const look = () => browser.evaluate(k_look);
const click = (selector) => browser.evaluate(`document.querySelector(${JSON.stringify(selector)}).click()`);
const shoot = async (name) => writeFile(join(work, `${name}.png`), await browser.screenshot());
const layer = (name) => `[data-layer=${name}]`;

// Switches a layer, sees that the picture changes as `check` wants, and switches it back.
async function switching(name, check) {
  const before = await look();
  await click(layer(name));
  const after = await look();
  assert.notEqual(after.sum, before.sum, `${name} changes the picture`);
  check?.(before, after);
  await click(layer(name));
  assert.equal((await look()).sum, before.sum, `${name} comes back`);
}

async function testResult() {
  const page = resolve(work, "spot.html");
  execFileSync(command, [join(data, "spot.net"), "-o", join(work, "spot.ply"), "--html", page, "--up", "y",
    "--method", "stanko", "--quiet"]);
  await browser.open(pathToFileURL(page).href);
  await browser.until("document.body.dataset.ready", 60);
  const first = await look();
  assert.ok(first.all > 60000, `a surface is seen: ${first.all} pixels`);
  assert.ok(first.dark > 0.15 * first.all && first.light > 0.15 * first.all, "there are stripes");
  assert.ok(first.curve > 1000, "curves are seen");
  await shoot("isophotes");
  await switching("curves", (before, after) => assert.ok(after.curve < 0.2 * before.curve));
  await switching("surface", (before, after) => assert.ok(after.all < 0.6 * before.all));
  await switching("wires");
  await switching("samples");
  await switching("normals", (before, after) => assert.ok(after.normal > before.normal + 500));
  await switching("nodes");

  await click("[name=look][value='0']");
  await shoot("shaded");
  await click("[name=look][value='2']");
  assert.equal(await browser.evaluate("document.getElementById('legend').hidden"), false);
  await shoot("curvature");
  await click("[name=look][value='3']");
  const patches = await look();
  assert.ok(patches.hues > 3 * first.hues, `patches have colours: ${patches.hues} against ${first.hues}`);
  await shoot("patches");
  await click("[name=look][value='1']");
  assert.equal((await look()).sum, first.sum);

  // Every key of a layer, the views, the theme.
  await browser.evaluate("document.getElementById('view').focus()");
  for (const key of ["x", "ArrowLeft", "+", "f"]) {
    const before = (await look()).sum;
    await browser.send("Input.dispatchKeyEvent", { type: "keyDown", key });
    assert.notEqual((await look()).sum, before, `the key ${key} moves the view`);
  }
  await click("#theme");
  await shoot("dark");
  assert.match(await browser.evaluate("document.getElementById('report').innerText"), /Patches\s+38/);

  const ground = await browser.evaluate("getComputedStyle(document.body).backgroundColor");
  await click("#theme");
  assert.notEqual(await browser.evaluate("getComputedStyle(document.body).backgroundColor"), ground);
}

async function openText(name, text) {
  await browser.evaluate(`(() => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([${JSON.stringify(text)}], ${JSON.stringify(name)}));
    document.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, cancelable: true }));
  })()`);
}

async function testApp() {
  const site = await serve(web);
  await browser.open(`${site.url}?example=sphere.net`);
  await browser.until("document.body.dataset.ready === '1'", 120);
  assert.equal(await browser.evaluate("document.getElementById('error').textContent"), "");
  assert.ok((await look()).all > 60000, "the example is seen");
  await shoot("app");

  // A file of one's own, saved again: the same bits as from the command.
  const bumpy = await readFile(join(data, "bumpy.net"), "utf8");
  await openText("my curves.net", bumpy);
  await browser.until("document.body.dataset.ready === '2'", 120);
  await browser.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: resolve(work) });
  const saved = join(work, "my curves-surface.obj");
  await click("#save button");
  let text = "";
  for (let i = 0; i < 100 && text === ""; ++i) {
    await new Promise((r) => setTimeout(r, 100));
    text = await readFile(saved, "utf8").catch(() => "");
  }
  execFileSync(command, [join(data, "bumpy.net"), "-o", join(work, "bumpy.obj"), "--quiet"]);
  const numbers = (obj) => obj.split("\n").filter((line) => /^[vf]/.test(line)).join("\n");
  assert.equal(numbers(text), numbers(await readFile(join(work, "bumpy.obj"), "utf8")), "the saved surface");
  // What was saved is read back by the command: the curves with their normals give the same patches.
  execFileSync(command, [saved, "-o", join(work, "again.obj"), "--report", join(work, "again.json"), "--quiet"]);
  const again = JSON.parse(await readFile(join(work, "again.json"), "utf8"));
  assert.equal(again.patches, 8);
  assert.equal(again.euler_characteristic, 2);

  // A long run is cancelled at once.
  await browser.evaluate("document.getElementById('spacing').value = '0.01'");
  await click("#run");
  await browser.until("document.getElementById('state').textContent.includes('my curves.net: ')", 60);
  await click("#cancel");
  assert.equal(await browser.evaluate("document.getElementById('state').textContent"), "Cancelled.");
  assert.equal(await browser.evaluate("document.getElementById('cancel').disabled"), true);
  await browser.evaluate("document.getElementById('spacing').value = ''");

  // A bad file: the command's own sentence; the surface shown before stays.
  await openText("bad.net", "3\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 nonsense 0 0 1\n");
  const error = await browser.until("document.getElementById('error').textContent", 60);
  assert.match(error, /^bad\.net:4: /);
  assert.ok((await look()).all > 60000);
  await shoot("error");
  site.close();
}

try {
  await testResult();
  console.log("result page: passed");
  if (web) {
    await testApp();
    console.log("application: passed");
  } else {
    console.log("application: skipped, it is not built (cmake --workflow --preset web)");
  }
  assert.deepEqual(browser.complaints, []);
} finally {
  await browser.close();
}
