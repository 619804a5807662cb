// SPDX-License-Identifier: Apache-2.0
/** What the page knows: the last of each kind of message, and what the user has chosen. */

import { Emitter } from "../util/emitter";
import type { Mark } from "../panels/findings";
import type {
  ClientMessage,
  CodePage,
  DisplayMessage,
  DisplayStatus,
  Findings,
  Hello,
  Problem,
  Relation,
  ReplayPrepared,
  Robot,
  RvizConfiguration,
  Saved,
  Stats,
  Tick,
  Timeline,
  Topic,
  TreeFrame,
} from "../protocol/messages";

export interface ModelEvents {
  hello: Hello;
  tree: Forest;
  stats: Stats;
  tick: Tick;
  topics: Topic[];
  robot: Robot;
  display: DisplayStatus;
  message: DisplayMessage;
  rviz: RvizConfiguration;
  relation: Relation;
  timeline: Timeline;
  problem: Problem;
  findings: Findings;
  page: CodePage;
  replay: ReplayPrepared;
  saved: Saved;
  connected: boolean;
  fixed: string;
  selection: Selection;
  visibility: undefined;
  clock: Clock;
}

export interface Selection {
  frame: string | null;
  /** What the selected frame is compared with; null means the fixed frame. */
  reference: string | null;
}

export interface Clock {
  live: boolean;
  playing: boolean;
  speed: number;
  loop: [number, number] | null;
}

/** While the time runs, ticks tell where it is again so long after it was moved. */
const ANSWER_MS = 1000;
/** The origin of ticks is a float64's: times come back as they were sent, but for that. */
const EXACT_NS = 1000;

/** The trees, with what is asked of them often looked up beforehand. */
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

  /** Parent, parent's parent, ... to the root; ends even if the tree it was given has a loop. */
  ancestors(i: number): number[] {
    const found: number[] = [];
    let at = this.frames[i]?.parent ?? -1;
    while (at >= 0 && at < this.frames.length && found.length < this.frames.length) {
      found.push(at);
      at = this.frames[at]?.parent ?? -1;
    }
    return found;
  }

  /** From one frame to the other over their nearest common ancestor; null when there is none. */
  chain(from: number, to: number): number[] | null {
    const up = [from, ...this.ancestors(from)];
    const down = [to, ...this.ancestors(to)];
    const place = new Map(up.map((frame, i) => [frame, i]));
    const meet = down.findIndex((frame) => place.has(frame));
    if (meet < 0) return null;
    const top = place.get(down[meet] as number) as number;
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
  tick: Tick | null = null;
  topics: Topic[] = [];
  /** By frame: what the doctor says of it. */
  marks = new Map<string, Mark>();
  robots = new Map<string | number, Robot>();
  fixed = "";
  connected = false;
  selection: Selection = { frame: null, reference: null };
  hidden = new Set<string>();
  solo: string | null = null;
  clock: Clock = { live: true, playing: false, speed: 1, loop: null };
  broken = 0;
  /** The time that was asked for last, and when. */
  private asked: { at: number; since: number } | null = null;
  private soloShown = new Set<string>();

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
    return this.solo === null ? !this.hidden.has(name) : this.soloShown.has(name);
  }

  setHidden(names: string[], hidden: boolean): void {
    for (const name of names)
      if (hidden) this.hidden.add(name);
      else this.hidden.delete(name);
    this.emit("visibility", undefined);
  }

  /** Shows one frame and what hangs below it, and nothing else, until it is asked again. */
  setSolo(name: string | null): void {
    this.solo = name;
    this.updateSolo();
    this.emit("visibility", undefined);
  }

  updateSolo(): void {
    const i = this.solo === null ? undefined : this.forest.index.get(this.solo);
    this.soloShown = new Set(i === undefined ? [] : this.forest.subtree(i).map((k) => this.forest.name(k)));
  }

  setClock(change: Partial<Clock>, at?: number): void {
    this.clock = { ...this.clock, ...change };
    this.sendClock(at);
    this.emit("clock", this.clock);
  }

  sendClock(at = this.playhead): void {
    const { live, playing, speed, loop } = this.clock;
    this.asked = null;
    if (live) this.send({ type: "time", mode: "live" });
    else if (Number.isFinite(at)) {
      this.asked = { at: Math.round(at), since: performance.now() };
      this.send({ type: "time", mode: "at", at: Math.round(at), playing, speed, loop });
    }
  }

  /** The source finds the next message by itself: what was asked for before is over. */
  step(direction: 1 | -1): void {
    this.asked = null;
    this.send({ type: "step", direction });
  }

  /** What came is shown from now on. */
  take(tick: Tick): void {
    this.tick = tick;
    const { asked } = this;
    const answered = this.clock.playing
      ? asked !== null && performance.now() - asked.since > ANSWER_MS
      : Math.abs(tick.time - (asked?.at ?? NaN)) < EXACT_NS;
    if (answered) this.asked = null;
    this.emit("tick", tick);
  }

  /** Whether a tick that shows what was asked for is still to come. */
  get waiting(): boolean {
    return this.asked !== null;
  }

  /** The time that is looked at: what was asked for last, also while its tick is on the way. */
  get playhead(): number {
    if (!this.asked) return this.tick?.time ?? NaN;
    const { at, since } = this.asked;
    return this.clock.playing ? at + (performance.now() - since) * 1e6 * this.clock.speed : at;
  }
}
