// A result that opens with a double click: the scene stands in the page itself.

import { sceneFromBase64 } from "./scene.js";
import { Viewer, byId } from "./viewer.js";

try {
  const viewer = new Viewer();
  viewer.show(sceneFromBase64(byId("scene").textContent));
} catch (error) {
  byId("word").textContent = error.message;
  byId("word").hidden = false;
}
