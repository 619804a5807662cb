// SPDX-License-Identifier: Apache-2.0
/** The source of a replay: answers requests from the recording inside the page, as the server would. */

import {
  interpolate,
  compose,
  IDENTITY,
  inverse,
  matrix,
  relativePose,
  rpyDegrees,
  type Pose,
  type Quaternion,
} from "../util/math";
import { Forest } from "../model/model";
import {
  decode,
  FrameState,
  PROTOCOL_VERSION,
  type ClientMessage,
  type DisplayPose,
  type Hello,
  type Relation,
  type ReplayBlock,
  type RvizGlobalOptions,
  type DisplayOptions,
  type Vector,
} from "../protocol/messages";
import { showFatalError } from "../util/fatal";
import { quote } from "../util/static_commands";
import { bytes, DAMAGED, lastUpTo, ReplayDisplay, type PoseAt } from "./displays";
import type { MessageSource, SourceEvents } from "../protocol/source";

/** A subscription of a display to a recorded topic. */
interface Subscription {
  recorded: ReplayDisplay;
  /** The sequence numbers of the messages that the page has received. */
  sent: Set<number>;
  /** The last status that was sent. */
  status: string;
  /** Whether it requests colors that the replay does not contain. */
  missingColors: boolean;
}

type Listener = <K extends keyof SourceEvents>(event: K, value: SourceEvents[K]) => void;

const FRAME_INTERVAL_MS = 33;
const NO_GLOBAL_OPTIONS: RvizGlobalOptions = { fixed_frame: null, background: null, frame_rate: null };

/** Opens the recording in an element of this page. */
export function openReplay(element: HTMLElement): ReplaySource {
  try {
    const block = JSON.parse(element.textContent) as ReplayBlock | null;
    if (block?.format !== "coframe-replay") throw new Error("The page contains no recording.");
    return new ReplaySource(block);
  } catch (error) {
    throw showFatalError("Cannot open this replay", error instanceof Error ? error.message : String(error));
  }
}

export class ReplaySource implements MessageSource {
  readonly live = false;
  private readonly times: Float64Array;
  private readonly poses: Float32Array;
  private readonly states: Uint8Array;
  private readonly forest: Forest;
  private readonly count: number;
  private readonly displays: ReplayDisplay[];
  private readonly subscriptions = new Map<number, Subscription>();
  private fixedFrame: number;
  private playhead: number;
  private isPlaying = false;
  private speed = 1;
  private loop: [number, number] | null = null;
  private lastTick = 0;
  private hasStarted = false;
  private listener: Listener = () => {};

  constructor(private readonly block: ReplayBlock) {
    this.count = block.frames.length;
    this.times = new Float64Array(bytes(block.times, 8));
    this.poses = new Float32Array(bytes(block.poses, 4));
    this.states = new Uint8Array(bytes(block.states, 1));
    const samples = this.times.length;
    if (this.poses.length !== samples * this.count * 7 || this.states.length !== samples * this.count)
      throw new Error(DAMAGED);
    this.displays = block.displays.map((display) => new ReplayDisplay(display));
    const components: { root: string; size: number }[] = [];
    for (const frame of block.frames) {
      const component = (components[frame.component] ??= { root: frame.name, size: 0 });
      if (frame.parent < 0) component.root = frame.name;
      component.size++;
    }
    this.forest = new Forest(
      1,
      block.frames,
      Array.from(components, (c) => c ?? { root: "", size: 0 }),
    );
    this.fixedFrame = Math.max(0, this.forest.index.get(block.fixed) ?? 0);
    this.playhead = block.from;
  }

  start(listener: Listener): void {
    this.listener = listener;
    const { block, forest } = this;
    const span: [number, number] = [block.from, block.to];
    listener("connected", true);
    const hello: Hello = {
      type: "hello",
      version: PROTOCOL_VERSION,
      mode: "replay",
      title: block.title,
      origin: block.origin,
      span,
      fixed: block.fixed,
      fixed_is_given: true,
      rviz: block.rviz && {
        displays: block.rviz.displays,
        view: block.rviz.view,
        global: NO_GLOBAL_OPTIONS,
        tools: [],
        groups: [],
        saved_views: [],
        unknown: [],
        ignored: [],
      },
      topics: this.displays.map(({ block: { topic, type, display } }) => ({
        topic,
        type,
        display,
        automatic: true,
      })),
      can_publish: false,
      can_open: false,
      can_control: false,
      recent: [],
      restart: null,
    };
    listener("text", hello);
    listener("text", {
      type: "tree",
      revision: 1,
      fixed: block.fixed,
      frames: forest.frames,
      components: forest.components,
    });
    block.robots.forEach((robot, id) => listener("text", { ...robot, id }));
    for (const { node, geometry } of block.nodes) {
      listener("text", node);
      if (geometry) listener("binary", decode(bytes(geometry, 1)));
    }
    if (block.stats.length === this.count) listener("text", { type: "stats", revision: 1, span, frames: block.stats });
    this.hasStarted = true;
    this.sendFrames();
    setInterval(() => this.advance(), FRAME_INTERVAL_MS);
  }

  /** A replay opens no files. */
  sendBytes(): void {}

  send(message: ClientMessage): void {
    switch (message.type) {
      case "fixed":
        this.fixedFrame = this.forest.index.get(message.frame) ?? this.fixedFrame;
        this.sendFrames();
        break;
      case "time":
        if (message.mode === "at") {
          this.playhead = message.at ?? this.playhead;
          this.isPlaying = message.playing ?? false;
          this.speed = message.speed ?? 1;
          this.loop = message.loop ?? null;
          this.lastTick = performance.now();
        }
        this.sendFrames();
        break;
      case "step": {
        const next = this.times[this.sample() + message.direction];
        if (next !== undefined) this.playhead = next;
        this.sendFrames();
        break;
      }
      case "relate":
        this.listener("text", this.relate(message.id, message.target, message.source));
        break;
      case "subscribe":
        this.subscribe(message.id, message.topic, message.options ?? {});
        break;
      case "unsubscribe":
        this.subscriptions.delete(message.id);
        this.sendFrames();
        break;
      case "timeline": {
        const { from, to, edges, bins } = this.block;
        this.listener("text", { type: "timeline", revision: 1, bins, from, to, edges });
        break;
      }
      default:
        break;
    }
  }

  private subscribe(id: number, topic: string, options: DisplayOptions): void {
    const matching = this.displays.filter(({ block }) => block.topic === topic);
    const recorded = matching.find(({ block }) => block.color_by === (options.color_by ?? null)) ?? matching[0];
    if (!recorded) {
      this.subscriptions.delete(id);
      this.listener("text", {
        type: "display",
        id,
        state: "error",
        text: `This replay does not contain topic ${topic}.`,
      });
      return;
    }
    const computed = !options.color_by || ["axis", "flat"].includes(options.color_by);
    const missingColors = !computed && recorded.block.color_by !== options.color_by;
    this.subscriptions.set(id, { recorded, sent: new Set(), status: "", missingColors });
    this.sendFrames();
  }

  private advance(): void {
    if (!this.isPlaying) return;
    const now = performance.now();
    const [first, end] = this.loop ?? [this.block.from, this.block.to];
    this.playhead += (now - this.lastTick) * 1e6 * this.speed;
    this.lastTick = now;
    if (this.playhead > end)
      this.playhead = this.loop ? first + ((this.playhead - first) % Math.max(1, end - first)) : end;
    this.sendFrames();
  }

  /** The index of the last sample at or before the playhead. */
  private sample(): number {
    return Math.max(0, lastUpTo(this.times, this.playhead));
  }

  private pose(sample: number, frame: number): Pose {
    const p = (sample * this.count + frame) * 7;
    const row = Array.from(this.poses.subarray(p, p + 7));
    return { position: row.slice(0, 3) as Vector, quaternion: row.slice(3) as Quaternion };
  }

  private sendFrames(): void {
    if (this.times.length === 0 || !this.hasStarted) return;
    const sample = this.sample();
    const { frames } = this.forest;
    const poses = new Float32Array(this.count * 7);
    const states = this.states.slice(sample * this.count, (sample + 1) * this.count);
    const asRecorded = frames[this.fixedFrame]?.name === this.block.fixed;
    const own = frames[this.fixedFrame]?.component;
    const bases = new Map<number, Pose>();
    for (let i = 0; i < this.count; i++) {
      let pose = this.pose(sample, i);
      const component = frames[i]?.component ?? 0;
      if (!asRecorded) {
        const root = component === own ? this.fixedFrame : this.rootOf(i);
        let base = bases.get(root);
        if (!base) bases.set(root, (base = inverse(this.pose(sample, root))));
        pose = compose(base, pose);
        if (component !== own) states[i] = FrameState.otherTree;
        else if (states[i] === FrameState.otherTree) states[i] = FrameState.ok;
      }
      poses.set([...pose.position, ...pose.quaternion], i * 7);
    }
    const origin: Vector = asRecorded ? this.block.origin_xyz : [0, 0, 0];
    this.listener("binary", {
      kind: "frames",
      revision: 1,
      time: this.playhead,
      origin,
      count: this.count,
      poses,
      states,
      displays: this.listMessages(sample, asRecorded),
    });
  }

  /** Returns the visible messages of all displays, and sends those that the page has not received yet. */
  private listMessages(sample: number, asRecorded: boolean): DisplayPose[] {
    const poseAt: PoseAt = asRecorded ? () => IDENTITY : (stamp) => this.recordedFixedFrame(sample, stamp);
    const listed: DisplayPose[] = [];
    for (const [id, subscription] of this.subscriptions) {
      const entries = subscription.recorded.at(sample, id, poseAt);
      for (const { sequence } of entries)
        if (!subscription.sent.has(sequence)) this.sendMessage(id, sequence, subscription);
      subscription.sent = new Set(entries.map(({ sequence }) => sequence));
      this.sendStatus(id, sample, subscription);
      listed.push(...entries);
    }
    return listed;
  }

  private sendMessage(id: number, sequence: number, { recorded }: Subscription): void {
    try {
      const message = recorded.message(sequence, id);
      if (message) this.listener("binary", message);
    } catch (error) {
      this.listener("invalid", error instanceof Error ? error.message : String(error));
    }
  }

  private sendStatus(id: number, sample: number, subscription: Subscription): void {
    const { recorded, missingColors } = subscription;
    const [recordedState, recordedText] = recorded.status(sample);
    const uncolored = missingColors && recordedState === "ok";
    const state = uncolored ? "error" : recordedState;
    const text = uncolored ? "This replay contains only the colors that it was saved with." : recordedText;
    if (subscription.status === `${state} ${text}`) return;
    subscription.status = `${state} ${text}`;
    this.listener("text", { type: "display", id, state, text, note: recorded.note });
  }

  /** The pose of the recorded fixed frame relative to the selected one at a time; null if they are not connected. */
  private recordedFixedFrame(sample: number, stamp: number): Pose | null {
    const recorded = this.forest.index.get(this.block.fixed) ?? -1;
    if (this.forest.frames[recorded]?.component !== this.forest.frames[this.fixedFrame]?.component) return null;
    const low = Number.isFinite(stamp) ? Math.max(0, lastUpTo(this.times, stamp)) : sample;
    const high = Math.min(low + (Number.isFinite(stamp) ? 1 : 0), this.times.length - 1);
    const [from, to] = [this.times[low] as number, this.times[high] as number];
    const part = to > from ? Math.max(0, Math.min(1, (stamp - from) / (to - from))) : 0;
    const base = interpolate(this.pose(low, this.fixedFrame), this.pose(high, this.fixedFrame), part);
    return base.position.every(Number.isFinite) ? inverse(base) : null;
  }

  private rootOf(i: number): number {
    return this.forest.ancestors(i).at(-1) ?? i;
  }

  private relate(id: number, target: string, source: string): Relation {
    const [t, s] = [this.forest.index.get(target), this.forest.index.get(source)];
    const failure: Relation = {
      type: "relation",
      id,
      ok: false,
      target,
      source,
      stamp: this.playhead,
      translation: null,
      quaternion: null,
      rpy_deg: null,
      matrix: null,
      static_command: null,
      chain: [],
      error: null,
      hint: null,
      broken_at: null,
    };
    if (t === undefined || s === undefined)
      return { ...failure, error: `No frame named “${t === undefined ? target : source}” in this replay.` };
    const chain = this.forest.chain(s, t);
    if (!chain) {
      const roots = [this.rootOf(t), this.rootOf(s)].map((root) => this.forest.name(root));
      return {
        ...failure,
        chain: [source, target],
        broken_at: target,
        error: `Frames “${target}” and “${source}” are not connected: they are in different trees.`,
        hint: `Publish a transform that connects their roots “${roots[0]}” and “${roots[1]}”.`,
      };
    }
    const sample = this.sample();
    const names = chain.map((frame) => this.forest.name(frame));
    const pose = relativePose(this.pose(sample, t), this.pose(sample, s));
    if (![...pose.position, ...pose.quaternion].every(Number.isFinite))
      return { ...failure, chain: names, error: "The replay contains no transform at this time." };
    const values = [...pose.position, ...pose.quaternion].map((value) => String(Number(value.toPrecision(9))));
    const flags = ["x", "y", "z", "qx", "qy", "qz", "qw"].map((name, k) => `--${name} ${values[k]}`).join(" ");
    return {
      ...failure,
      ok: true,
      chain: names,
      translation: pose.position,
      quaternion: pose.quaternion,
      rpy_deg: rpyDegrees(pose.quaternion),
      matrix: matrix(pose),
      static_command: `coframe static ${flags} --frame-id ${quote(target)} --child-frame-id ${quote(source)}`,
    };
  }
}
