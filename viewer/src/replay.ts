/** A recording inside the page: answers what the server would, as far as poses alone can tell. */

import { compose, inverse, matrix, relative, rpyDegrees, type Pose, type Quaternion } from "./math";
import { Forest } from "./model";
import { FrameState, type ClientMessage, type Hello, type Relation, type Robot, type TreeFrame, type Vector } from "./protocol";
import type { Source, SourceEvents } from "./source";

export interface ReplayBlock {
  format: "coframe-replay";
  version: number;
  title: string;
  origin: string;
  from: number;
  to: number;
  rate: number;
  fixed: string;
  origin_xyz?: Vector;
  frames: TreeFrame[];
  times: string;
  poses: string;
  states: string;
  robots?: Partial<Robot>[];
}

type Listener = <K extends keyof SourceEvents>(event: K, value: SourceEvents[K]) => void;

const PICTURE_MS = 33;
const DAMAGED = "the recording in this file is damaged";

/** The recording that the server wrote into this page; null in a live one. */
export function replayBlock(): ReplayBlock | null {
  const text = document.getElementById("replay")?.textContent;
  if (!text) return null;
  const block = JSON.parse(text) as ReplayBlock | null;
  return block?.format === "coframe-replay" ? block : null;
}

export class ReplaySource implements Source {
  readonly live = false;
  private readonly times: Float64Array;
  private readonly poses: Float32Array;
  private readonly states: Uint8Array;
  private readonly forest: Forest;
  private readonly count: number;
  private fixed: number;
  private at: number;
  private playing = false;
  private speed = 1;
  private loop: [number, number] | null = null;
  private last = 0;
  private listener: Listener = () => {};

  constructor(private readonly block: ReplayBlock) {
    this.count = block.frames.length;
    this.times = new Float64Array(bytes(block.times, 8));
    this.poses = new Float32Array(bytes(block.poses, 4));
    this.states = new Uint8Array(bytes(block.states, 1));
    const samples = this.times.length;
    if (this.poses.length !== samples * this.count * 7 || this.states.length !== samples * this.count)
      throw new Error(DAMAGED);
    const components: { root: string; size: number }[] = [];
    for (const frame of block.frames) {
      const component = (components[frame.component] ??= { root: frame.name, size: 0 });
      if (frame.parent < 0) component.root = frame.name;
      component.size++;
    }
    this.forest = new Forest(1, block.frames, Array.from(components, (c) => c ?? { root: "", size: 0 }));
    this.fixed = Math.max(0, this.forest.index.get(block.fixed) ?? 0);
    this.at = block.from;
  }

  start(listener: Listener): void {
    this.listener = listener;
    const { block, forest } = this;
    const span: [number, number] = [block.from, block.to];
    listener("connected", true);
    const hello: Hello = {
      type: "hello",
      version: 1,
      mode: "replay",
      title: block.title,
      origin: block.origin,
      span,
      fixed: block.fixed,
      rviz: null,
      topics: [],
      can_publish: false,
    };
    listener("text", hello);
    listener("text", { type: "tree", revision: 1, fixed: block.fixed, frames: forest.frames, components: forest.components });
    (block.robots ?? []).forEach((robot, id) =>
      listener("text", {
        type: "robot",
        id,
        name: robot.name ?? "robot",
        source: "replay",
        urdf: robot.urdf ?? "",
        meshes: robot.meshes ?? {},
        problems: [],
        warnings: [],
        joints: robot.joints ?? [],
        description_topic: null,
      }),
    );
    this.tick();
    setInterval(() => this.advance(), PICTURE_MS);
  }

  send(message: ClientMessage): void {
    switch (message.type) {
      case "fixed":
        this.fixed = this.forest.index.get(message.frame) ?? this.fixed;
        this.tick();
        break;
      case "time":
        if (message.mode === "at") {
          this.at = message.at;
          this.playing = message.playing;
          this.speed = message.speed;
          this.loop = message.loop;
          this.last = performance.now();
        }
        this.tick();
        break;
      case "step": {
        const next = this.times[this.sample() + message.direction];
        if (next !== undefined) this.at = next;
        this.tick();
        break;
      }
      case "relate":
        this.listener("text", this.relate(message.id, message.target, message.source));
        break;
      default:
        break;
    }
  }

  private advance(): void {
    if (!this.playing) return;
    const now = performance.now();
    const [first, end] = this.loop ?? [this.block.from, this.block.to];
    this.at += (now - this.last) * 1e6 * this.speed;
    this.last = now;
    if (this.at > end) this.at = this.loop ? first + ((this.at - first) % Math.max(1, end - first)) : end;
    this.tick();
  }

  /** The last sample that is not later than the playhead. */
  private sample(): number {
    let low = 0;
    let high = this.times.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if ((this.times[middle] as number) <= this.at) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  private pose(sample: number, frame: number): Pose {
    const p = (sample * this.count + frame) * 7;
    const row = Array.from(this.poses.subarray(p, p + 7));
    return { position: row.slice(0, 3) as Vector, quaternion: row.slice(3) as Quaternion };
  }

  private tick(): void {
    if (this.times.length === 0) return;
    const sample = this.sample();
    const { frames } = this.forest;
    const poses = new Float32Array(this.count * 7);
    const states = this.states.slice(sample * this.count, (sample + 1) * this.count);
    const asRecorded = frames[this.fixed]?.name === this.block.fixed;
    const own = frames[this.fixed]?.component;
    const bases = new Map<number, Pose>();
    for (let i = 0; i < this.count; i++) {
      let pose = this.pose(sample, i);
      const component = frames[i]?.component ?? 0;
      if (!asRecorded) {
        const root = component === own ? this.fixed : this.rootOf(i);
        let base = bases.get(root);
        if (!base) bases.set(root, (base = inverse(this.pose(sample, root))));
        pose = compose(base, pose);
        if (component !== own) states[i] = FrameState.otherTree;
        else if (states[i] === FrameState.otherTree) states[i] = FrameState.ok;
      }
      poses.set([...pose.position, ...pose.quaternion], i * 7);
    }
    const origin: Vector = asRecorded ? (this.block.origin_xyz ?? [0, 0, 0]) : [0, 0, 0];
    this.listener("binary", {
      kind: "tick",
      revision: 1,
      time: this.at,
      origin,
      count: this.count,
      poses,
      states,
      displays: [],
    });
  }

  private rootOf(i: number): number {
    return this.forest.ancestors(i).at(-1) ?? i;
  }

  private relate(id: number, target: string, source: string): Relation {
    const [t, s] = [this.forest.index.get(target), this.forest.index.get(source)];
    const answer: Relation = {
      type: "relation",
      id,
      ok: false,
      target,
      source,
      stamp: this.at,
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
      return { ...answer, error: `There is no frame “${t === undefined ? target : source}” in this recording.` };
    const chain = this.forest.chain(s, t);
    if (!chain) {
      const roots = [this.rootOf(t), this.rootOf(s)].map((root) => this.forest.name(root));
      return {
        ...answer,
        chain: [source, target],
        broken_at: target,
        error: `“${target}” and “${source}” are in two trees that are not connected.`,
        hint: `Their roots are “${roots[0]}” and “${roots[1]}”: a transform between them is missing.`,
      };
    }
    const sample = this.sample();
    const names = chain.map((frame) => this.forest.name(frame));
    const pose = relative(this.pose(sample, t), this.pose(sample, s));
    if (![...pose.position, ...pose.quaternion].every(Number.isFinite))
      return { ...answer, chain: names, error: "At this time the recording cannot tell it." };
    const values = [...pose.position, ...pose.quaternion].map((value) => String(Number(value.toPrecision(9))));
    const flags = ["x", "y", "z", "qx", "qy", "qz", "qw"].map((name, k) => `--${name} ${values[k]}`).join(" ");
    return {
      ...answer,
      ok: true,
      chain: names,
      translation: pose.position,
      quaternion: pose.quaternion,
      rpy_deg: rpyDegrees(pose.quaternion),
      matrix: matrix(pose),
      static_command: `coframe static ${flags} --frame-id ${quoted(target)} --child-frame-id ${quoted(source)}`,
    };
  }
}

/** For a shell: plain names as they are, others in quotes. */
function quoted(name: string): string {
  return /^[\w./-]+$/.test(name) ? name : `'${name.replaceAll("'", `'\\''`)}'`;
}

function bytes(base64: string, unit: number): ArrayBuffer {
  const text = atob(base64);
  if (text.length % unit !== 0) throw new Error(DAMAGED);
  const out = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) out[i] = text.charCodeAt(i);
  return out.buffer;
}
