// Runs the wireskin command, compiled to WebAssembly, on one file after the other. In: name, bytes, up
// and options. Out: { progress }, then { files, line } or { error }.

importScripts("wireskin.js");

self.onmessage = async ({ data }) => {
  const printed = [];
  const complaints = [];
  try {
    // A new instance for each run: a command starts with nothing left from the one before.
    const command = await createWireskin({
      print: (line) => printed.push(line),
      printErr: (line) => complaints.push(line),
      onProgress: (stage, fraction) => postMessage({ progress: { stage, fraction } }),
    });
    const name = data.name.replace(/[/\0]/g, "_");
    command.FS.writeFile(name, new Uint8Array(data.bytes));
    const outputs = { obj: "out.obj", ply: "out.ply", stl: "out.stl", html: "out.html" };
    const words = [name, "-o", outputs.obj, "-o", outputs.ply, "-o", outputs.stl,
      "--html", outputs.html, "--curves", "--up", data.up, ...data.options];
    const status = command.callMain(words);
    if (status !== 0) {
      postMessage({ error: complaints.join("\n") || `The command ended with status ${status}.` });
      return;
    }
    const files = {};
    for (const [type, path] of Object.entries(outputs)) files[type] = command.FS.readFile(path);
    postMessage({ files, line: printed.join("\n") }, Object.values(files).map((f) => f.buffer));
  } catch (error) {
    postMessage({ error: complaints.join("\n") || `The command stopped: ${error.message ?? error}` });
  }
};
