// node no_imports.mjs MODULE.wasm: the module needs nothing from its host and exports the library.
import { readFile } from "node:fs/promises";

const module = await WebAssembly.compile(await readFile(process.argv[2]));
const imports = WebAssembly.Module.imports(module);
if (imports.length > 0) throw new Error(`it imports ${JSON.stringify(imports)}`);
const { exports } = await WebAssembly.instantiate(module, {});
if (typeof exports.wsk_build !== "function") throw new Error("wsk_build is not exported");
