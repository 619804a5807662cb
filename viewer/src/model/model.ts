// SPDX-License-Identifier: Apache-2.0
/** The state of the page: the last message of each type, and the choices of the user. */

import { Emitter } from "../util/emitter";
import type { Mark } from "./marks";
import type { PickedGroup } from "./picked";
import type {
  ClientMessage,
  CodePage,
  Completions,
  Controlled,
  Curves,
  CurveStatus,
  DisplayMessage,
  DisplayStatus,
  FieldStates,
  FindingEntries,
  Hello,
  Inspection,
  LogEntries,
  NodeGeometry,
  NodeGraph,
  PartDetails,
  ProblemReport,
  PublishResult,
  Pulse,
  RemovedNodes,
  RemovedWidgets,
  Relation,
  ReplayPrepared,
  RobotModel,
  RvizConfiguration,
  RvizSaved,
  SceneNode,
  Stats,
  FrameUpdate,
  Timeline,
  DisplayTopic,
  TopicTable,
  TreeFrame,
  UploadProgress,
  Widget,
} from "../protocol/messages";

export interface ModelEvents {
  hello: Hello;
  tree: Forest;
  stats: Stats;
  frames: FrameUpdate;
  topics: DisplayTopic[];
  robot: RobotModel;
  display: DisplayStatus;
  message: DisplayMessage;
  rviz: RvizConfiguration;
  relation: Relation;
  /** The answer about a selected part. */
  picked: PartDetails;
  /** The selected parts of the scene; empty if there are none. */
  parts: readonly PickedGroup[];
  timeline: Timeline;
  problem: ProblemReport;
  findings: FindingEntries;
  page: CodePage;
  published: PublishResult;
  replay: ReplayPrepared;
  upload: UploadProgress;
  saved: RvizSaved;
  curve: CurveStatus;
  curves: Curves;
  inspection: Inspection;
  table: TopicTable;
  states: FieldStates;
  log: LogEntries;
  graph: NodeGraph;
  completions: Completions;
  controlled: Controlled;
  node: SceneNode;
  geometry: NodeGeometry;
  nodes_removed: RemovedNodes;
  widget: Widget;
  widgets_removed: RemovedWidgets;
  /** A request of a part of the page to plot an expression. */
  plot: string;
  /** A request of a part of the page to inspect a topic. */
  inspect: string;
  connected: boolean;
  /** Whether the server has sent nothing for a while. */
  silent: boolean;
  pulse: Pulse;
  fixed: string;
  selection: Selection;
  visibility: undefined;
  clock: Clock;
}

export interface Selection {
  frame: string | null;
  /** The frame that the pose is relative to; null means the fixed frame. */
  reference: string | null;
}

export interface Clock {
  live: boolean;
  playing: boolean;
  speed: number;
  loop: [number, number] | null;
}

/** During playback, the time of frame updates is used again this long after a seek. */
const SEEK_MS = 1000;
const MAX_PROBLEMS = 200;
/** Times are relative to an origin and have the precision of a float64. */
const TIME_TOLERANCE_NS = 1000;

/** The trees of frames, with indices for fast queries. */
export class Forest {
  readonly index = new Map<string, number>();
  readonly children: number[][];
  readonly roots: number[] = [];

  constructor(
    readonly revision: number,
    readonly frames: TreeFrame[],
    readonly components: { root: string; size: number }[],
  ) {
    this.children = frames.map(() => []);
    frames.forEach((frame, i) => {
      this.index.set(frame.name, i);
      const siblings = this.children[frame.parent];
      if (siblings && frame.parent !== i) siblings.push(i);
      else this.roots.push(i);
    });
  }

  name(i: number): string {
    return this.frames[i]?.name ?? "";
  }

  /** The ancestors from the parent to the root; terminates even if the tree is invalid and has a loop. */
  ancestors(i: number): number[] {
    const found: number[] = [];
    let at = this.frames[i]?.parent ?? -1;
    while (at >= 0 && at < this.frames.length && found.length < this.frames.length) {
      found.push(at);
      at = this.frames[at]?.parent ?? -1;
    }
    return found;
  }

  /** The frames from one frame to another, via their nearest common ancestor; null if they are not connected. */
  chain(from: number, to: number): number[] | null {
    const up = [from, ...this.ancestors(from)];
    const down = [to, ...this.ancestors(to)];
    const position = new Map(up.map((frame, i) => [frame, i]));
    const meet = down.findIndex((frame) => position.has(frame));
    if (meet < 0) return null;
    const top = position.get(down[meet] as number) as number;
    return [...up.slice(0, top + 1), ...down.slice(0, meet).reverse()];
  }

  subtree(i: number): number[] {
    const found = [i];
    for (let k = 0; k < found.length && found.length <= this.frames.length; k++)
      found.push(...(this.children[found[k] as number] ?? []));
    return found;
  }
}

export class Model extends Emitter<ModelEvents> {
  hello: Hello | null = null;
  forest = new Forest(-1, [], []);
  stats: Stats | null = null;
  statsReceived = 0;
  frameUpdate: FrameUpdate | null = null;
  topics: DisplayTopic[] = [];
  /** The doctor's marks, by frame. */
  marks = new Map<string, Mark>();
  robots = new Map<string | number, RobotModel>();
  fixed = "";
  connected = false;
  /** Whether an open connection has delivered nothing for a while. */
  silent = false;
  /** The last pulse of the server; null without a server. */
  pulse: Pulse | null = null;
  selection: Selection = { frame: null, reference: null };
  hidden = new Set<string>();
  solo: string | null = null;
  clock: Clock = { live: true, playing: false, speed: 1, loop: null };
  /** The last problems that the server has reported. */
  readonly problems: ProblemReport[] = [];
  /** The number of invalid messages received. */
  invalidMessages = 0;
  /** The last seek that is not yet visible in frame updates: its time, and when it was requested. */
  private seek: { at: number; since: number } | null = null;
  private passesFilter: (name: string) => boolean = () => true;
  private framesShownSolo = new Set<string>();

  constructor(readonly send: (message: ClientMessage) => void) {
    super();
  }

  get origin(): bigint {
    try {
      return BigInt(this.hello?.origin ?? 0);
    } catch {
      return 0n;
    }
  }

  get span(): [number, number] | null {
    return this.stats?.span ?? this.hello?.span ?? null;
  }

  setFixed(frame: string): void {
    if (frame === this.fixed) return;
    this.fixed = frame;
    this.send({ type: "fixed", frame });
    this.emit("fixed", frame);
  }

  select(frame: string | null, reference: string | null = this.selection.reference): void {
    this.selection = { frame, reference: reference === frame ? null : reference };
    this.emit("selection", this.selection);
  }

  isShown(name: string): boolean {
    if (this.solo !== null) return this.framesShownSolo.has(name);
    return !this.hidden.has(name) && this.passesFilter(name);
  }

  /** Shows only frames for which the function returns true, in addition to what the user hides. */
  setFilter(passes: (name: string) => boolean): void {
    this.passesFilter = passes;
    this.emit("visibility", undefined);
  }

  setHidden(names: string[], hidden: boolean): void {
    for (const name of names)
      if (hidden) this.hidden.add(name);
      else this.hidden.delete(name);
    this.emit("visibility", undefined);
  }

  /** Shows only one frame and its descendants; null shows all frames again. */
  setSolo(name: string | null): void {
    this.solo = name;
    this.updateSolo();
    this.emit("visibility", undefined);
  }

  updateSolo(): void {
    const i = this.solo === null ? undefined : this.forest.index.get(this.solo);
    this.framesShownSolo = new Set(i === undefined ? [] : this.forest.subtree(i).map((k) => this.forest.name(k)));
  }

  setClock(change: Partial<Clock>, at?: number): void {
    this.clock = { ...this.clock, ...change };
    this.sendClock(at);
    this.emit("clock", this.clock);
  }

  sendClock(at = this.playhead): void {
    const { live, playing, speed, loop } = this.clock;
    this.seek = null;
    if (live) this.send({ type: "time", mode: "live" });
    else if (Number.isFinite(at)) {
      this.seek = { at: Math.round(at), since: performance.now() };
      this.send({ type: "time", mode: "at", at: Math.round(at), playing, speed, loop });
    }
  }

  private graphUsers = 0;

  /** Requests the graph of nodes and topics for one more part of the page, or for one less. */
  countGraphUsers(isUsed: boolean): void {
    this.graphUsers = Math.max(0, this.graphUsers + (isUsed ? 1 : -1));
    if (isUsed || this.graphUsers === 0) this.send({ type: "graph", shown: isUsed });
  }

  /** Stores and announces a problem. */
  report(problem: ProblemReport): void {
    this.problems.push(problem);
    if (this.problems.length > MAX_PROBLEMS) this.problems.shift();
    this.emit("problem", problem);
  }

  /** Steps to the next or previous message, which the source determines; cancels a pending seek. */
  step(direction: 1 | -1): void {
    this.seek = null;
    this.send({ type: "step", direction });
  }

  /** Sets the frame update to be drawn. */
  setFrameUpdate(update: FrameUpdate): void {
    this.frameUpdate = update;
    const { seek } = this;
    const arrived = this.clock.playing
      ? seek !== null && performance.now() - seek.since > SEEK_MS
      : Math.abs(update.time - (seek?.at ?? NaN)) < TIME_TOLERANCE_NS;
    if (arrived) this.seek = null;
    this.emit("frames", update);
  }

  /** Whether the frame update of the last seek has not arrived yet. */
  get isSeeking(): boolean {
    return this.seek !== null;
  }

  /** The displayed time, or the time of a pending seek. */
  get playhead(): number {
    if (!this.seek) return this.frameUpdate?.time ?? NaN;
    const { at, since } = this.seek;
    return this.clock.playing ? at + (performance.now() - since) * 1e6 * this.clock.speed : at;
  }
}
