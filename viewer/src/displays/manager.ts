// SPDX-License-Identifier: Apache-2.0
/** The list of displays: from an .rviz file, from the last session, or from the available topics. */

import * as THREE from "three";
import { Meshes } from "../scene/meshes";
import { DISPLAYS } from "../generated/displays";
import type {
  DisplayMessage,
  DisplayStatus,
  Json,
  RobotModel,
  RvizConfiguration,
  RvizDisplay,
  RvizGroup,
  DisplayOptions,
  DisplayTopic,
} from "../protocol/messages";
import { loadList, storeValue } from "../util/storage";
import type { Theme } from "../util/theme";
import type { View } from "../scene/view";
import type { Model } from "../model/model";
import { AXIS_M } from "../scene/frames";
import { CameraDisplay } from "./camera_info";
import { ImageDisplay } from "./image";
import { displayClass, MessageDisplay, type Context, type Display, type DisplayConfig } from "./display";
import { MAKERS } from "./registry";
import { RobotDisplay } from "./robot";
import { isObject } from "./options";
import { TfDisplay } from "./tf";

export class Displays {
  list: Display[] = [];
  /** The groups of the .rviz file and of the user. A group that contains another one stands before it. */
  groups: RvizGroup[] = [];
  private readonly meshes = new Meshes();
  private readonly context: Context;
  private readonly listeners: (() => void)[] = [];
  /** Whether the displays are those of an .rviz file. */
  private areFromFile = false;
  /** The filters of the TF display that the model uses. */
  private filters = JSON.stringify(["", ""]);
  private nextId = 1;
  /** Whether new topics are displayed automatically, until the user or a file changes the list. */
  private showsNewTopics = true;
  private hasStarted = false;

  constructor(
    private readonly model: Model,
    private readonly view: View,
    theme: Theme,
  ) {
    this.context = {
      model,
      palette: () => theme.palette(),
      distinct: () => theme.distinct,
      height: () => view.renderer.height,
      software: () => view.renderer.software,
      replayed: () => model.hello?.mode === "replay",
      redraw: () => view.refresh(),
    };
    model.on("hello", (hello) => {
      if (hello.restart !== null)
        for (const display of this.list) if (display instanceof MessageDisplay) display.clear();
      this.start(hello.rviz);
    });
    model.on("topics", (topics) => this.showOffered(topics));
    model.on("robot", (robot) => this.setRobot(robot));
    model.on("message", (message) => this.receive(message));
    model.on("display", (status) => this.setStatus(status));
    model.on("connected", (connected) => {
      if (!connected) return;
      for (const display of this.list) this.subscribe(display);
      this.sendTimeout();
    });
    view.onPoses((framePoses, update) => {
      for (const display of this.list) if (display.config.enabled) display.setPoses(framePoses, update);
      for (const display of this.list) {
        if (!(display instanceof ImageDisplay) || !display.config.enabled) continue;
        display.markDetections(this.list);
        if (!display.projects) continue;
        this.showCamera(display.cameraTopic);
        const visible = this.list.filter((other) => this.isVisibleIn(display, other));
        display.project(this.list, visible, framePoses, AXIS_M * view.tf.scale);
      }
    });
    view.addBounds(() => {
      const box = new THREE.Box3();
      for (const display of this.list) if (display.config.enabled) box.union(display.bounds());
      return box;
    });
    view.addSurfaces(() =>
      this.list
        .filter(({ config, kind }) => config.enabled && DISPLAYS[kind].surfaces)
        .map((display) => display.object),
    );
    theme.onChange(() => {
      for (const display of this.list) display.restyle();
    });
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  get robots(): RobotDisplay[] {
    return this.list.filter((display) => display instanceof RobotDisplay);
  }

  /** Adds a display that the user has chosen. */
  add(className: string, topic: string | null, name = className): void {
    this.showsNewTopics = false;
    this.create({ class: className, name: this.freeName(name), enabled: true, topic, options: {} });
    this.notifyChange();
  }

  remove(display: Display): void {
    this.showsNewTopics = false;
    this.drop(display);
    this.notifyChange();
  }

  /** Enables or disables a display itself. In a disabled group, it stays hidden. */
  setEnabled(display: Display, checked: boolean): void {
    display.config.checked = checked;
    this.setShown(display, checked && this.groupsEnabled(display.config.group));
    this.notifyChange();
  }

  setGroupEnabled(group: RvizGroup, enabled: boolean): void {
    group.enabled = enabled;
    for (const display of this.list) {
      const shown = (display.config.checked ?? display.config.enabled) && this.groupsEnabled(display.config.group);
      display.config.checked ??= display.config.enabled;
      if (shown !== display.config.enabled) this.setShown(display, shown);
    }
    this.notifyChange();
  }

  renameGroup(group: RvizGroup, name: string): void {
    group.name = name.trim() || group.name;
    this.notifyChange();
  }

  /** Moves a display into a group, by its place; "" is none, and null a new group. */
  setGroup(display: Display, source: string | null): void {
    this.showsNewTopics = false;
    display.config.group = source ?? this.addGroup();
    const checked = display.config.checked ?? display.config.enabled;
    this.groups = this.groups.filter((group) => this.isUsed(group));
    const shown = checked && this.groupsEnabled(display.config.group);
    display.config.checked = checked;
    if (shown !== display.config.enabled) this.setShown(display, shown);
    this.notifyChange();
  }

  private addGroup(): string {
    let n = 1;
    while (this.groups.some(({ source }) => source === `new ${n}`)) n++;
    this.groups.push({ source: `new ${n}`, group: "", name: `Group ${n}`, enabled: true });
    return `new ${n}`;
  }

  /** Whether a group is one of a file, or contains a display. */
  private isUsed({ source }: RvizGroup): boolean {
    return !source.startsWith("new ") || this.list.some(({ config }) => config.group === source);
  }

  /** Whether a group and all groups that contain it are enabled. */
  groupsEnabled(source: string | undefined): boolean {
    const group = source ? this.groups.find((other) => other.source === source) : undefined;
    return !group || (group.enabled && this.groupsEnabled(group.group));
  }

  /** Whether a camera of an .rviz file shows a display: its option "Visibility" contains the names of groups and displays. */
  private isVisibleIn(camera: ImageDisplay, display: Display): boolean {
    const path = [display.config.name];
    for (let source = display.config.group; source;) {
      const group = this.groups.find((other) => other.source === source);
      if (group) path.unshift(group.name);
      source = group?.group;
    }
    let at: Json | undefined = camera.config.options["Visibility"];
    for (const name of path) {
      if (!isObject(at)) return at !== false;
      if (at["Value"] === false) return false;
      at = at[name];
    }
    return isObject(at) ? at["Value"] !== false : at !== false;
  }

  private setShown(display: Display, enabled: boolean): void {
    display.config.enabled = enabled;
    display.object.visible = enabled;
    if (display instanceof MessageDisplay) {
      if (enabled) this.subscribe(display);
      else {
        this.model.send({ type: "unsubscribe", id: display.id });
        display.clear();
      }
    }
  }

  /** Applies an option that the panel has changed in the configuration of a display. */
  optionChanged(display: Display): void {
    delete display.config.added;
    if (display instanceof MessageDisplay) this.resubscribeIfNeeded(display);
    display.restyle();
    this.notifyChange();
  }

  /** Displays a CameraInfo into whose image the scene is projected. */
  private showCamera(topic: string | null): void {
    const isCamera = (display: Display): boolean => display instanceof CameraDisplay && display.config.topic === topic;
    if (topic && !this.list.some(isCamera)) this.add("CameraInfo", topic);
  }

  /** Replaces all displays by those of a file. */
  apply(rviz: RvizConfiguration): void {
    this.showsNewTopics = false;
    this.areFromFile = true;
    for (const display of this.list) this.discard(display);
    this.list = [];
    this.groups = orderedGroups(rviz.groups ?? []).map((group) => ({ ...group }));
    for (const display of rviz.displays) this.create({ ...display, topic: display.topic ?? null });
    for (const robot of this.model.robots.values()) this.assignRobot(robot);
    this.notifyChange();
  }

  /** The displays in the format of .rviz files. */
  save(): RvizDisplay[] {
    return this.list
      .filter(({ config }) => !config.added)
      .map(({ config: { added: _added, ...config } }) => {
        const checked = config.checked ?? config.enabled;
        return { ...config, enabled: checked, checked };
      });
  }

  /** All displays and groups as text, which `restore` reads. */
  snapshot(): string {
    return JSON.stringify({ displays: this.list.map(({ config }) => config), groups: this.groups });
  }

  /** Shows the displays of a snapshot again. Those that are the same stay as they are. */
  restore(snapshot: string): void {
    const { displays, groups } = JSON.parse(snapshot) as { displays: DisplayConfig[]; groups: RvizGroup[] };
    this.showsNewTopics = false;
    this.groups = groups;
    const kept = [...this.list];
    const restored = displays.map((config) => {
      const text = JSON.stringify(config);
      const same = kept.findIndex((display) => JSON.stringify(display.config) === text);
      return same < 0 ? null : (kept.splice(same, 1)[0] as Display);
    });
    for (const display of kept) this.discard(display);
    this.list = restored.filter((display) => display !== null);
    const order = restored.map((display, i) => display ?? this.create(displays[i] as DisplayConfig));
    this.list = order.filter((display) => display !== null);
    for (const robot of this.model.robots.values()) this.assignRobot(robot);
    this.notifyChange();
  }

  /** The topics of enabled displays, with the options of their subscriptions. */
  get shownTopics(): { topic: string; options: DisplayOptions }[] {
    return this.list.flatMap((display) => {
      const { topic, enabled } = display.config;
      return display instanceof MessageDisplay && topic && enabled ? [{ topic, options: display.subscription() }] : [];
    });
  }

  private start(rviz: RvizConfiguration | null): void {
    if (this.hasStarted) return;
    this.hasStarted = true;
    const last = loadList("displays", isConfig);
    if (rviz) this.apply(rviz);
    else if (last.length > 0) {
      this.showsNewTopics = false;
      this.groups = orderedGroups(loadList("groups", isGroup));
      for (const config of last) {
        const enabled = config.enabled && this.groupsEnabled(config.group);
        this.create({ ...config, checked: config.enabled, enabled });
      }
      this.notifyChange();
    } else {
      this.create({ class: "Grid", name: "Grid", enabled: true, topic: null, options: {} });
      this.create({ class: "TF", name: "TF", enabled: true, topic: null, options: {} });
      this.notifyChange();
    }
    this.showOffered(this.model.topics);
  }

  /** Displays the topics that the server has chosen, which may change while topics appear. */
  private showOffered(topics: DisplayTopic[]): void {
    if (!this.showsNewTopics || !this.hasStarted) return;
    const chosen = new Set(topics.filter(({ automatic }) => automatic).map(({ topic }) => topic));
    const isReplaced = (display: Display): boolean =>
      display instanceof MessageDisplay && display.config.topic !== null && !chosen.has(display.config.topic);
    // A topic that is gone may come back; it makes room only for another one.
    if (chosen.size > 0)
      for (const display of this.list.filter(isReplaced))
        if (topics.some(({ topic }) => topic === display.config.topic)) this.drop(display);
    for (const { topic, display, automatic } of topics) {
      const shown = this.list.some((other) => other.config.topic === topic && other instanceof MessageDisplay);
      if (!automatic || shown || !displayClass(display)) continue;
      this.create({ class: display, name: this.freeName(display), enabled: true, topic, options: {} });
    }
    this.notify();
  }

  private drop(display: Display): void {
    this.discard(display);
    this.list = this.list.filter((other) => other !== display);
  }

  /** The topics that could be displayed and are not. */
  get omittedTopics(): DisplayTopic[] {
    const shown = new Set(this.list.map(({ config }) => config.topic));
    return this.model.topics.filter(({ topic, display }) => displayClass(display) && !shown.has(topic));
  }

  rename(display: Display, name: string): void {
    const wanted = name.trim();
    if (!wanted || wanted === display.config.name) return;
    this.showsNewTopics = false;
    display.config.name = this.freeName(wanted);
    this.notifyChange();
  }

  /** Adds a display with the same topic and options after it. */
  duplicate(display: Display): void {
    this.showsNewTopics = false;
    const config = structuredClone(display.config);
    const made = this.create({ ...config, name: this.freeName(config.name) });
    if (made) {
      this.list.splice(this.list.indexOf(display) + 1, 0, ...this.list.splice(this.list.indexOf(made), 1));
      if (made instanceof RobotDisplay && display instanceof RobotDisplay && display.robot)
        made.setRobot(display.robot);
    }
    this.notifyChange();
  }

  /** Moves a display in the list, which is the order in an .rviz file. */
  move(display: Display, by: 1 | -1): void {
    const at = this.list.indexOf(display);
    const to = Math.max(0, Math.min(this.list.length - 1, at + by));
    this.showsNewTopics = false;
    this.list.splice(to, 0, ...this.list.splice(at, 1));
    this.notifyChange();
  }

  private setRobot(robot: RobotModel): void {
    this.assignRobot(robot);
    this.notify();
    this.view.refresh();
  }

  /** Passes a robot to the display that shows it, to one that waits for it, or to a new one. */
  private assignRobot(robot: RobotModel): void {
    const topicOf = (display: RobotDisplay): string | null => display.config.topic;
    const display =
      this.robots.find((other) => other.robot?.id === robot.id) ??
      this.robots.find((other) => !other.robot && (!topicOf(other) || topicOf(other) === robot.description_topic)) ??
      this.robots.find((other) => !other.robot);
    if (display) display.setRobot(robot);
    else {
      const name = this.freeName("RobotModel");
      const config = { class: "RobotModel", name, enabled: true, options: {}, added: this.areFromFile };
      const made = this.create({ ...config, topic: robot.description_topic });
      if (made instanceof RobotDisplay) made.setRobot(robot);
    }
  }

  private create(config: DisplayConfig): Display | null {
    const kind = displayClass(config.class);
    if (!kind) return null;
    const own = { ...config, options: { ...config.options } };
    const display = new MAKERS[kind](this.nextId++, own, this.context, this.meshes);
    if (display instanceof ImageDisplay) display.alone = !this.list.some((other) => other instanceof ImageDisplay);
    if (display instanceof MessageDisplay && !config.topic)
      display.status = { state: "waiting", text: "No topic selected" };
    this.list.push(display);
    this.view.renderer.scene.add(display.object);
    if (!(display instanceof RobotDisplay)) display.restyle();
    this.subscribe(display);
    return display;
  }

  private discard(display: Display): void {
    if (display instanceof MessageDisplay) this.model.send({ type: "unsubscribe", id: display.id });
    display.dispose();
  }

  private readonly subscriptions = new Map<number, string>();

  private subscribe(display: Display): void {
    if (!(display instanceof MessageDisplay) || !display.config.topic || !display.config.enabled) return;
    const options = display.subscription();
    this.subscriptions.set(display.id, JSON.stringify(options));
    display.clear();
    const { topic } = display.config;
    this.model.send({ type: "subscribe", id: display.id, topic, options });
  }

  private resubscribeIfNeeded(display: MessageDisplay): void {
    if (this.subscriptions.get(display.id) === JSON.stringify(display.subscription())) return;
    this.model.send({ type: "unsubscribe", id: display.id });
    this.subscribe(display);
  }

  private receive(message: DisplayMessage): void {
    const display = this.list.find((other) => other.id === message.id);
    if (display instanceof MessageDisplay) display.receive(message);
  }

  private setStatus({ id, state, text, note }: DisplayStatus): void {
    const display = this.list.find((other) => other.id === id);
    if (!display) return;
    display.status = { state, text };
    display.omitted = note ?? "";
    this.notify();
  }

  private notifyChange(): void {
    this.chooseResolutions();
    if (!this.showsNewTopics) {
      storeValue("displays", this.save());
      storeValue("groups", this.groups);
    }
    this.applyTf();
    this.view.refresh();
    this.notify();
  }

  /** A single image has its full resolution. */
  private chooseResolutions(): void {
    const images = this.list.filter((display) => display instanceof ImageDisplay);
    const shown = images.filter(({ config }) => config.enabled && config.topic);
    for (const image of shown) {
      image.alone = shown.length === 1;
      if (this.subscriptions.has(image.id)) this.resubscribeIfNeeded(image);
    }
  }

  /** Applies the options of the TF display to the view. */
  private applyTf(): void {
    const tf = this.list.find((display) => display instanceof TfDisplay);
    this.view.tfShown = tf?.config.enabled ?? false;
    if (!tf) return;
    const { options } = tf;
    this.view.tf = {
      scale: options.number("Marker Scale"),
      axes: options.flag("Show Axes"),
      arrows: options.flag("Show Arrows"),
      names: options.flag("Show Names"),
    };
    const filters = JSON.stringify([options.text("Filter (whitelist)"), options.text("Filter (blacklist)")]);
    if (filters !== this.filters) {
      this.filters = filters;
      this.model.setFilter(tf.filter());
    }
    this.view.framePoses.frameTimeout = options.number("Frame Timeout");
    this.sendTimeout();
  }

  private sentTimeout = 0;

  private sendTimeout(): void {
    const seconds = this.view.framePoses.frameTimeout;
    if (seconds === this.sentTimeout && this.model.connected) return;
    if (this.model.connected) this.sentTimeout = seconds;
    this.model.send({ type: "frame_timeout", seconds });
  }

  private freeName(name: string): string {
    const taken = new Set(this.list.map((display) => display.config.name));
    if (!taken.has(name)) return name;
    let n = 2;
    while (taken.has(`${name} ${n}`)) n++;
    return `${name} ${n}`;
  }

  private notify(): void {
    for (const listener of this.listeners) listener();
  }
}

/** Returns the groups whose containing group, if any, stands before them: no group contains itself. */
function orderedGroups(groups: readonly RvizGroup[]): RvizGroup[] {
  const known = new Set([""]);
  return groups.filter(({ source, group }) => known.has(group) && !known.has(source) && known.add(source));
}

function isGroup(value: unknown): value is RvizGroup {
  const group = value as Partial<RvizGroup> | null;
  return (
    typeof group?.source === "string" &&
    typeof group.group === "string" &&
    typeof group.name === "string" &&
    typeof group.enabled === "boolean"
  );
}

function isConfig(value: unknown): value is DisplayConfig {
  const config = value as Partial<DisplayConfig> | null;
  return (
    typeof config?.class === "string" &&
    typeof config.name === "string" &&
    typeof config.enabled === "boolean" &&
    typeof config.options === "object" &&
    config.options !== null
  );
}
