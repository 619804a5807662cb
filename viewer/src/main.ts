/** The page: what comes from the source goes to the model, and every part listens to that. */

import "./style.css";
import { Bar } from "./bar";
import { byId } from "./dom";
import { Forest, Model } from "./model";
import { Panel } from "./panel";
import type { BinaryMessage, ServerMessage } from "./protocol";
import { SocketSource, socketUrl } from "./socket";
import { Theme } from "./theme";
import { toast } from "./toast";
import { TreePanel } from "./tree_panel";
import { View } from "./view";

const source = new SocketSource(socketUrl(location));
const theme = new Theme();
const model = new Model((message) => source.send(message));
const view = new View(model, theme, byId("canvas") as HTMLCanvasElement, byId("labels"));
const tree = new TreePanel(model);
const panel = new Panel(byId("panel"), [{ id: "frames", title: "Frames", body: tree.element }]);
new Bar(
  byId("bar"),
  model,
  {
    toggleTheme: () => theme.toggleDark(),
    toggleDistinct: () => theme.toggleDistinct(),
    help: () => {},
    togglePanel: () => panel.toggle(),
    savePicture: () => {},
    saveReplay: () => {},
  },
  source.live,
);
view.onDrawn((tick) => {
  if (tick) source.send({ type: "ready", drawn: Number.isFinite(tick.time) ? tick.time : null });
});

function receive(message: ServerMessage): void {
  switch (message.type) {
    case "hello":
      model.hello = message;
      model.emit("hello", message);
      break;
    case "tree":
      model.forest = new Forest(message.revision, message.frames, message.components);
      if (message.fixed) model.fixed = message.fixed;
      model.emit("tree", model.forest);
      break;
    case "stats":
      model.stats = message;
      model.statsReceived = performance.now();
      model.emit("stats", message);
      break;
    case "problem":
      toast(message.text, message.hint);
      break;
    default:
      break;
  }
}

function receiveBinary(message: BinaryMessage): void {
  if (message.kind === "tick") {
    model.tick = message;
    model.emit("tick", message);
  } else model.emit("message", message);
}

source.start((event, value) => {
  if (event === "text") receive(value as ServerMessage);
  else if (event === "binary") receiveBinary(value as BinaryMessage);
  else if (event === "connected") {
    model.connected = value as boolean;
    model.emit("connected", model.connected);
  } else model.broken++;
});
