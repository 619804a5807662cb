// SPDX-License-Identifier: Apache-2.0
/**
 * Builds the page, and passes the messages of the source to the model, whose events update all parts. A replay contains
 * this script only, which then starts by itself.
 */

import { AdjustPanel } from "./panels/adjust";
import { Bar } from "./panels/bar";
import { DockLauncher } from "./dock/launcher";
import { Displays } from "./displays/manager";
import { DisplaysPanel } from "./panels/displays";
import { byId } from "./util/dom";
import { ReplayExport, saveImage } from "./panels/export";
import { FindingsPanel } from "./panels/findings";
import { Inspector } from "./panels/inspector";
import { JointsPanel } from "./panels/joints";
import { marksOf } from "./model/marks";
import { Forest, Model } from "./model/model";
import { FileOpener } from "./panels/open_file";
import { MovieRecorder } from "./panels/movie";
import { Overlay } from "./panels/overlay";
import { PartsPanel } from "./panels/parts";
import { Panel } from "./panels/side_panel";
import { exposeProbe } from "./probe";
import type { BinaryMessage, ServerMessage } from "./protocol/messages";
import { openReplay } from "./replay/source";
import { Selector } from "./displays/selector";
import { Interaction } from "./displays/interaction";
import { InteractiveDisplay } from "./displays/interactive";
import { NodesView } from "./scene/nodes";
import { RvizPanel } from "./panels/rviz";
import { ScenePanel } from "./panels/scene";
import { cameraKeys, Shortcuts } from "./panels/shortcuts";
import type { MessageSource } from "./protocol/source";
import { Theme } from "./util/theme";
import { Timeline } from "./panels/timeline";
import { toast } from "./util/toast";
import { Toolbar } from "./panels/toolbar";
import { ToolSettings } from "./model/tools";
import { TreePanel } from "./panels/tree";
import { Undo } from "./panels/undo";
import { View } from "./scene/view";
import { ViewsPanel } from "./panels/views";

const HIDDEN_PING_MS = 1000;

export function showPage(source: MessageSource): void {
  const theme = new Theme();
  const model = new Model((message) => source.send(message));
  const view = new View(model, theme, byId("canvas") as HTMLCanvasElement, byId("labels"), byId("panes"));
  const displays = new Displays(model, view, theme);
  const nodes = new NodesView(model, view, theme);
  if (source.live) {
    const interactive = (): InteractiveDisplay[] => displays.list.filter((one) => one instanceof InteractiveDisplay);
    new Interaction(view, model, interactive, view.renderer.canvas);
  }
  const scene = new ScenePanel(model, nodes, () => showScene());
  const toolSettings = new ToolSettings();
  const tree = new TreePanel(model);
  const rviz = new RvizPanel(model, displays, view, theme, toolSettings, source.live);
  const replays = new ReplayExport(model, displays, rviz, view);
  const panel = new Panel(byId("panel"), [
    { id: "frames", title: "Frames", body: tree.element },
    { id: "findings", title: "Findings", body: new FindingsPanel(model).element },
    { id: "displays", title: "Displays", body: new DisplaysPanel(model, displays).element },
    { id: "scene", title: "Scene", body: scene.element },
    { id: "joints", title: "Joints", body: new JointsPanel(model, displays).element },
    { id: "rviz", title: "RViz", body: rviz.element },
  ]);
  panel.setAvailable("scene", false);
  model.on("findings", ({ findings }) =>
    panel.setTitle("findings", findings.length ? `Findings ${findings.length}` : "Findings"),
  );
  const opener = new FileOpener(
    model,
    (data) => source.sendBytes(data),
    (file) => void rviz.open(file),
  );
  const timeline = new Timeline(byId("timeline"), model, source.live ? reset : null);
  const dock = new DockLauncher(byId("dock"), model, async () => {
    // Never in a replay: it has no server that could fill the panels, and does not contain their script.
    const { makeDock } = await import("./panes");
    return (root, onChange) => makeDock(root, model, theme, onChange);
  });
  const overlay = new Overlay(byId("overlay"), byId("notice"), model, view, () => views.toggle());
  const toolbar = new Toolbar(byId("overlay"), model, view, toolSettings);
  const views = new ViewsPanel(byId("overlay"), model, view, () => {
    panel.restore();
    if (source.live) dock.restore();
  });
  const undo = new Undo(displays, view);
  model.on("rviz", () => undo.clear());
  const movie = new MovieRecorder(byId("overlay"), model, view);
  new Inspector(byId("inspector"), model, view);
  new PartsPanel(byId("parts"), model, view, source.live);
  new Selector(model, view, displays);
  new AdjustPanel(byId("inspector"), model, view, source.live);

  const shortcuts = new Shortcuts([
    { key: " ", shown: "Space", text: "Pause or play", act: () => timeline.toggle() },
    { key: "l", text: "Back to live", act: () => timeline.goLive() },
    { key: ",", text: "Previous message", act: () => timeline.step(-1) },
    { key: ".", text: "Next message", act: () => timeline.step(1) },
    { key: "ArrowLeft", shown: "←", text: "Back by one second", act: () => timeline.jump(-1) },
    { key: "ArrowRight", shown: "→", text: "Forward by one second", act: () => timeline.jump(1) },
    ...(source.live
      ? [{ key: "R", shown: "Shift r", text: "Reset: start again without the data received so far", act: reset }]
      : []),
    { key: "y", text: "Go to a time, bookmarks", act: () => timeline.showTimes() },
    { key: "o", text: "Loop", act: () => timeline.toggleLoop() },
    { key: "t", text: "Rates over time", act: () => timeline.toggleSparklines() },
    { key: "a", text: "Show everything", act: () => view.fit() },
    { key: "v", text: "Top-down or orbit view", act: () => overlay.toggleTop() },
    { key: "f", text: "Follow the selected frame", act: () => overlay.toggleFollow() },
    { key: "z", text: "Look at the point that is clicked next", act: () => view.tools.toggle("focus") },
    { key: "w", text: "Numbers of the view, saved views", act: () => views.toggle() },
    ...cameraKeys(view.renderer.camera),
    { key: "k", text: "Select: click anything, or drag a rectangle", act: () => view.tools.toggle("select") },
    { key: "m", text: "Measure", act: () => overlay.toggleMeasure() },
    { key: "n", text: "Measure, as in RViz", act: () => overlay.toggleMeasure() },
    { key: "p", text: "2D pose estimate", act: () => toolbar.toggle("estimate") },
    { key: "g", text: "2D goal pose", act: () => toolbar.toggle("goal") },
    { key: "u", text: "Publish point", act: () => toolbar.toggle("point") },
    { key: "h", text: "Hide the selected frame", act: () => hideSelected() },
    { key: "/", text: "Search frames", act: () => (panel.open("frames"), tree.focusSearch()) },
    { key: "b", text: "Show or hide the panel", act: () => panel.toggle() },
    ...(source.live ? dock.shortcuts() : []),
    { key: "d", text: "Dark or light theme", act: () => theme.toggleDark() },
    { key: "Control+z", shown: "Ctrl z", text: "Undo a change of a display or of the camera", act: () => undo.undo() },
    { key: "Control+Z", shown: "Ctrl y", text: "Redo", act: () => undo.redo() },
    { key: "M", shown: "Shift m", text: "Record a movie of the scene, or stop it", act: () => movie.toggle() },
    { key: "s", text: "Save an image", act: () => void saveImage(view, model) },
    { key: "Escape", shown: "Esc", text: "Deselect or cancel the tool", act: () => deselect() },
    { key: "?", text: "Show or hide this help", act: () => shortcuts.show() },
  ]);

  new Bar(
    byId("bar"),
    model,
    {
      toggleTheme: () => theme.toggleDark(),
      toggleDistinct: () => theme.toggleDistinct(),
      help: () => shortcuts.show(),
      open: () => opener.show(),
      togglePanel: () => panel.toggle(),
      saveImage: () => void saveImage(view, model),
      recordMovie: () => movie.toggle(),
      saveReplay: () => replays.open(),
      panes: source.live ? dock.menu() : [],
    },
    source.live,
  );
  if (source.live) dock.restore();
  exposeProbe(model, view, displays, nodes);

  /** Shows the tab of what a program has added, and opens it when the program adds its first widget. */
  function showScene(): void {
    const isNew = panel.setAvailable("scene", !scene.isEmpty);
    if (isNew && scene.hasWidgets) panel.choose("scene");
  }

  function reset(): void {
    model.send({ type: "restart" });
  }

  /** Says that everything has started again. Earlier times no longer exist, so the newest data is shown. */
  function showRestart(reason: string): void {
    const recorded = model.hello?.mode === "recording";
    if (!recorded) model.setClock({ live: true, playing: false, loop: null });
    toast(`${reason}.`, "All displays start again without the data received so far.", "info");
  }

  function hideSelected(): void {
    const { frame } = model.selection;
    if (frame) model.setHidden([frame], model.isShown(frame));
  }

  function deselect(): void {
    if (view.tools.active) view.tools.choose(null);
    else {
      model.select(null);
      model.emit("parts", []);
    }
  }

  function receive(message: ServerMessage): void {
    switch (message.type) {
      case "hello":
        model.hello = message;
        model.stats = null;
        model.topics = message.topics;
        model.robots.clear();
        model.marks.clear();
        model.emit("hello", message);
        model.emit("topics", message.topics);
        if (message.restart !== null) showRestart(message.restart);
        break;
      case "pulse":
        model.pulse = message;
        model.emit("pulse", message);
        break;
      case "tree":
        model.forest = new Forest(message.revision, message.frames, message.components);
        if (message.fixed !== model.fixed) {
          model.fixed = message.fixed;
          model.emit("fixed", model.fixed);
        }
        model.emit("tree", model.forest);
        break;
      case "stats":
        model.stats = message;
        model.statsReceived = performance.now();
        model.emit("stats", message);
        break;
      case "topics":
        model.topics = message.topics;
        model.emit("topics", message.topics);
        break;
      case "robot":
        model.robots.set(message.id, message);
        model.emit("robot", message);
        break;
      case "findings":
        model.marks = marksOf(message.findings);
        model.emit("findings", message);
        break;
      case "display":
      case "page":
      case "rviz":
      case "relation":
      case "picked":
      case "timeline":
      case "published":
      case "replay":
      case "upload":
      case "saved":
      case "curve":
      case "inspection":
      case "table":
      case "states":
      case "log":
      case "graph":
      case "completions":
      case "controlled":
      case "node":
      case "nodes_removed":
      case "widget":
      case "widgets_removed":
        model.emit(message.type, message as never);
        break;
      case "problem":
        toast(String(message.text), message.hint);
        model.report(message);
        break;
    }
  }

  function receiveBinary(message: BinaryMessage): void {
    if (message.kind === "curves") {
      model.emit("curves", message);
      return;
    }
    if (message.kind === "node") {
      model.emit("geometry", message);
      return;
    }
    if (message.kind !== "frames") {
      model.emit("message", message);
      return;
    }
    model.setFrameUpdate(message);
    // A hidden tab draws nothing. It requests one update per second, so that the server keeps the connection.
    if (document.hidden) setTimeout(() => document.hidden && showReady(message.time), HIDDEN_PING_MS);
  }

  function showReady(time: number): void {
    source.send({ type: "ready", drawn: Number.isFinite(time) ? time : null });
  }

  view.onBeforeDraw((update) => showReady(update.time));

  source.start((event, value) => {
    if (event === "text") receive(value as ServerMessage);
    else if (event === "binary") receiveBinary(value as BinaryMessage);
    else if (event === "connected") {
      model.connected = value as boolean;
      model.emit("connected", model.connected);
    } else if (event === "silent") {
      model.silent = value as boolean;
      model.emit("silent", model.silent);
    } else {
      model.invalidMessages++;
      console.warn(`coframe: ${value as string}`);
    }
  });
}

const recording = document.getElementById("replay");
if (recording) showPage(openReplay(recording));
