/**
 * What travels between the server and the page.
 *
 * Text messages are JSON objects with a `type`; binary ones are little-endian and open with a 4-byte kind. All times are
 * nanoseconds relative to `hello.origin`, as numbers: exact below 2^53, that is for 104 days.
 */

export type Vector = [number, number, number];
export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
export type JsonObject = { [key: string]: Json };

export interface Topic {
  topic: string;
  type: string;
  display: string;
}

export interface RvizDisplay {
  class: string;
  name: string;
  enabled: boolean;
  topic?: string | null;
  options: JsonObject;
}

export interface RvizConfig {
  displays: RvizDisplay[];
  global: { fixed_frame?: string | null; background?: Json; frame_rate?: number | null };
  view: { class: string; options: JsonObject } | null;
  unknown: { path: string; class: string; name: string }[];
}

export interface Hello {
  type: "hello";
  version: number;
  mode: "live" | "recording" | "buffer" | "replay";
  title: string;
  origin: string;
  span: [number, number] | null;
  fixed: string;
  rviz: RvizConfig | null;
  topics: Topic[];
  can_publish: boolean;
}

export interface TreeFrame {
  name: string;
  parent: number;
  static: boolean;
  component: number;
}

export interface Tree {
  type: "tree";
  fixed?: string;
  revision: number;
  frames: TreeFrame[];
  components: { root: string; size: number }[];
}

export interface FrameStats {
  rate: number | null;
  age: number | null;
  last: number | null;
  publisher: string | null;
  samples: number;
  longest_gap: number | null;
  state: "static" | "fresh" | "stale" | "gone";
}

export interface Stats {
  type: "stats";
  revision: number;
  span: [number, number] | null;
  frames: FrameStats[];
}

export interface RobotJoint {
  name: string;
  type: string;
  lower: number | null;
  upper: number | null;
  value: number;
}

export interface Robot {
  type: "robot";
  id: string | number;
  name: string;
  source: string;
  urdf: string;
  meshes: Record<string, string>;
  /** What of it cannot be drawn. */
  problems: string[];
  /** What is odd about its description. */
  warnings: string[];
  joints: RobotJoint[];
  description_topic: string | null;
}

export interface DisplayStatus {
  type: "display";
  id: number;
  state: "ok" | "waiting" | "error";
  text: string;
  /** In replays: what was left out. */
  note?: string;
}

export interface Relation {
  type: "relation";
  id: number;
  ok: boolean;
  target: string;
  source: string;
  stamp: number | null;
  translation: Vector | null;
  quaternion: [number, number, number, number] | null;
  rpy_deg: Vector | null;
  matrix: number[] | null;
  static_command: string | null;
  chain: string[];
  error: string | null;
  hint: string | null;
  broken_at: string | null;
}

export interface TimelineEdge {
  frame: number;
  counts: string;
  gaps: [number, number][];
}

export interface Timeline {
  type: "timeline";
  revision: number;
  bins: number;
  from: number;
  to: number;
  edges: TimelineEdge[];
}

export interface Problem {
  type: "problem";
  text: string;
  hint?: string | null;
}

export type Severity = "error" | "warning" | "note";

export interface Finding {
  code: string;
  severity: Severity;
  title: string;
  subject: string;
  /** Whose rows it concerns. */
  frames: string[];
  text: string;
  why: string;
  fix: string;
  publishers: string[];
  /** When it was seen first, in ns. */
  first: number | null;
  namespace: string;
  /** What would go if it did. */
  explains: Finding[];
}

export interface Findings {
  type: "findings";
  state: "none" | "waiting" | "told" | "failed";
  text: string;
  findings: Finding[];
}

/** The page of a finding's code, Markdown. */
export interface CodePage {
  type: "page";
  code: string;
  title: string;
  text: string;
}

export type ServerMessage =
  | Hello
  | Tree
  | Stats
  | { type: "topics"; topics: Topic[] }
  | Robot
  | DisplayStatus
  | ({ type: "rviz" } & RvizConfig)
  | Relation
  | Timeline
  | Problem
  | Findings
  | CodePage
  | { type: "replay"; looks: string }
  | { type: "saved"; path?: string; text?: string };

export interface SubscribeOptions {
  color_by?: "axis" | "intensity" | "rgb" | "distance" | "flat";
  axis?: "x" | "y" | "z";
  decay?: number;
  keep?: number;
  most_points?: number;
  trail?: number;
}

export type ClientMessage =
  | { type: "fixed"; frame: string }
  | { type: "time"; mode: "live" }
  | { type: "time"; mode: "at"; at: number; playing: boolean; speed: number; loop: [number, number] | null }
  | { type: "step"; direction: 1 | -1 }
  | { type: "subscribe"; id: number; topic: string; display: string; options: SubscribeOptions }
  | { type: "unsubscribe"; id: number }
  | { type: "relate"; id: number; target: string; source: string }
  | { type: "timeline"; from: number; to: number; bins: number }
  | { type: "joints"; robot: string | number; positions: Record<string, number>; publish: boolean }
  | { type: "load_rviz"; text: string }
  | { type: "save_rviz"; displays: RvizDisplay[]; global: JsonObject; view: JsonObject }
  | {
      type: "replay";
      displays: { topic: string; options: SubscribeOptions }[];
      rviz: { displays: RvizDisplay[]; global: JsonObject; view: JsonObject | null };
    }
  | { type: "frame_timeout"; seconds: number }
  | { type: "explain"; code: string }
  | { type: "ready"; drawn: number | null };

export const FrameState = { ok: 0, stale: 1, gone: 2, otherTree: 3 } as const;

/** Where a message's frame was at the message's stamp. */
export interface DisplayPose {
  id: number;
  sequence: number;
  /** x, y, z, qx, qy, qz, qw, relative to the tick's origin. */
  pose: Float32Array;
  ok: boolean;
}

export interface Tick {
  kind: "tick";
  revision: number;
  /** Nanoseconds relative to hello.origin; NaN when nothing came yet. */
  time: number;
  origin: Vector;
  count: number;
  /** count x (x, y, z, qx, qy, qz, qw), relative to `origin`; NaN where it cannot be told. */
  poses: Float32Array;
  states: Uint8Array;
  displays: DisplayPose[];
}

export interface Cloud {
  kind: "cloud";
  id: number;
  sequence: number;
  count: number;
  /** Every so-manieth of the message's points. */
  step: number;
  stamp: number;
  range: [number, number];
  points: Float32Array;
  scalar: Float32Array | null;
  rgba: Uint8Array | null;
}

export interface Grid {
  kind: "grid";
  id: number;
  sequence: number;
  width: number;
  height: number;
  resolution: number;
  /** Pose of the grid's corner in the message's frame: x, y, z, qx, qy, qz, qw. */
  origin: Float32Array;
  cells: Int8Array;
}

export const ImageFormat = { grey: 0, rgb: 1, jpeg: 2, png: 3 } as const;

export interface Image {
  kind: "image";
  id: number;
  sequence: number;
  width: number;
  height: number;
  format: number;
  /** Every so-manieth of the message's rows and columns. */
  step: number;
  stamp: number;
  data: Uint8Array<ArrayBuffer>;
}

export interface MarkerItem {
  ns: string;
  id: number;
  type: number;
  pose: number[];
  scale: Vector;
  rgba: (number | null)[];
  text: string;
  /** Where the mesh is served, and as the marker named it. */
  mesh: string | null;
  mesh_name?: string;
  mesh_problem?: string | null;
  use_materials?: boolean;
  points: [number, number] | null;
  colors: [number, number] | null;
}

/** Pairs are [offset in floats, number of rows] in the payload: a pose is a row of 7 floats, a point of 3, a colour of 4. */
export type ShapesHead =
  | { kind: "poses"; frame: string; stamp: number; poses: [number, number]; covariance?: (number | null)[] }
  | { kind: "path"; frame: string; stamp: number; poses: [number, number] }
  | { kind: "odometry"; frame: string; stamp: number; poses: [number, number]; covariance?: (number | null)[] }
  | { kind: "markers"; frame: string; stamp: number; items: MarkerItem[] }
  | {
      kind: "range";
      frame: string;
      stamp: number;
      range: number | null;
      min_range: number;
      max_range: number;
      field_of_view: number;
      radiation_type: number;
    }
  | { kind: "camera"; frame: string; stamp: number; width: number; height: number; k: number[] };

export interface Shapes {
  kind: "shapes";
  id: number;
  sequence: number;
  head: ShapesHead;
  payload: Float32Array;
}

export type BinaryMessage = Tick | DisplayMessage;
export type DisplayMessage = Cloud | Grid | Shapes | Image;

export class ProtocolError extends Error {}

/** Reads fields one after another and says what was missing when the bytes end early. */
class Reader {
  private offset = 0;
  private readonly view: DataView;

  constructor(
    private readonly buffer: ArrayBuffer,
    private readonly what: string,
  ) {
    this.view = new DataView(buffer);
  }

  private take(bytes: number): number {
    const start = this.offset;
    if (!Number.isSafeInteger(bytes) || bytes < 0 || start + bytes > this.buffer.byteLength)
      throw new ProtocolError(`${this.what}: ${bytes} bytes wanted at ${start} of ${this.buffer.byteLength}`);
    this.offset = start + bytes;
    return start;
  }

  u32(): number {
    return this.view.getUint32(this.take(4), true);
  }

  f32(): number {
    return this.view.getFloat32(this.take(4), true);
  }

  f64(): number {
    return this.view.getFloat64(this.take(8), true);
  }

  /** No copy where the bytes lie on a multiple of four, which the layout sees to. */
  floats(count: number): Float32Array {
    const start = this.take(count * 4);
    if (start % 4 === 0) return new Float32Array(this.buffer, start, count);
    return new Float32Array(this.buffer.slice(start, start + count * 4));
  }

  bytes(count: number): Uint8Array<ArrayBuffer> {
    return new Uint8Array(this.buffer, this.take(count), count);
  }

  align(): void {
    this.take((4 - (this.offset % 4)) % 4);
  }

  rest(): number {
    return this.buffer.byteLength - this.offset;
  }
}

export function decode(buffer: ArrayBuffer): BinaryMessage {
  if (buffer.byteLength < 4) throw new ProtocolError(`a binary message of ${buffer.byteLength} bytes`);
  const kind = new DataView(buffer).getUint32(0, true);
  if (kind === 1) return decodeTick(new Reader(buffer, "tick"));
  if (kind === 2) return decodeCloud(new Reader(buffer, "cloud"));
  if (kind === 3) return decodeGrid(new Reader(buffer, "grid"));
  if (kind === 4) return decodeShapes(new Reader(buffer, "shapes"));
  if (kind === 5) return decodeImage(new Reader(buffer, "image"));
  throw new ProtocolError(`a binary message of unknown kind ${kind}`);
}

function decodeTick(reader: Reader): Tick {
  reader.u32();
  const revision = reader.u32();
  const time = reader.f64();
  const origin: Vector = [reader.f64(), reader.f64(), reader.f64()];
  const count = reader.u32();
  const displayCount = reader.u32();
  const poses = reader.floats(count * 7);
  const states = reader.bytes(count);
  reader.align();
  const displays: DisplayPose[] = [];
  for (let i = 0; i < displayCount; i++) {
    const id = reader.u32();
    const sequence = reader.u32();
    const pose = reader.floats(7);
    displays.push({ id, sequence, pose, ok: reader.u32() === 0 });
  }
  return { kind: "tick", revision, time, origin, count, poses, states, displays };
}

function decodeCloud(reader: Reader): Cloud {
  reader.u32();
  const id = reader.u32();
  const sequence = reader.u32();
  const count = reader.u32();
  const flags = reader.u32();
  const stamp = reader.f64();
  const range: [number, number] = [reader.f32(), reader.f32()];
  const points = reader.floats(count * 3);
  const scalar = flags & 1 ? reader.floats(count) : null;
  const rgba = flags & 2 ? reader.bytes(count * 4) : null;
  return { kind: "cloud", id, sequence, count, step: Math.max(1, flags >>> 8), stamp, range, points, scalar, rgba };
}

function decodeGrid(reader: Reader): Grid {
  reader.u32();
  const id = reader.u32();
  const sequence = reader.u32();
  const width = reader.u32();
  const height = reader.u32();
  const resolution = reader.f32();
  const origin = reader.floats(7);
  const bytes = reader.bytes(width * height);
  const cells = new Int8Array(bytes.buffer, bytes.byteOffset, bytes.length);
  return { kind: "grid", id, sequence, width, height, resolution, origin, cells };
}

function decodeShapes(reader: Reader): Shapes {
  reader.u32();
  const id = reader.u32();
  const sequence = reader.u32();
  const text = new TextDecoder().decode(reader.bytes(reader.u32()));
  reader.align();
  let head: ShapesHead;
  try {
    head = JSON.parse(text) as ShapesHead;
  } catch {
    throw new ProtocolError("shapes: the description is not JSON");
  }
  return { kind: "shapes", id, sequence, head, payload: reader.floats(Math.floor(reader.rest() / 4)) };
}

function decodeImage(reader: Reader): Image {
  reader.u32();
  const id = reader.u32();
  const sequence = reader.u32();
  const width = reader.u32();
  const height = reader.u32();
  const flags = reader.u32();
  const stamp = reader.f64();
  const format = flags & 255;
  const raw = format === ImageFormat.grey ? width * height : format === ImageFormat.rgb ? 3 * width * height : null;
  const data = reader.bytes(raw ?? reader.rest());
  return { kind: "image", id, sequence, width, height, format, step: Math.max(1, flags >>> 8), stamp, data };
}

/** Rows of a payload, or none where the pair points outside of it. */
export function slice(payload: Float32Array, at: [number, number] | null | undefined, width: number): Float32Array {
  const [offset, rows] = at ?? [0, 0];
  const end = offset + rows * width;
  if (!(offset >= 0 && rows >= 0 && end <= payload.length)) return new Float32Array(0);
  return payload.subarray(offset, end);
}
