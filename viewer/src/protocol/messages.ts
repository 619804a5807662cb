// SPDX-License-Identifier: Apache-2.0
/**
 * The messages between the server and the page.
 *
 * Types, headers and checks are generated from `src/coframe/viewer/protocol`, which documents the protocol.
 * This module decodes binary messages with them.
 */

import {
  BinaryKind,
  CloudFlag,
  ImageFormat,
  readCloudHeader,
  readCurveRecord,
  readCurvesHeader,
  readEntryRecord,
  readFramesHeader,
  readGridHeader,
  readGridPartHeader,
  readImageHeader,
  readNodeHeader,
  readShapesHeader,
  type FieldReader,
  type ShapesDescription,
} from "../generated/protocol";
import type { Vector } from "../util/math";
import { ProtocolError } from "./validation";

export * from "../generated/protocol";
export { checkServerMessage, ProtocolError } from "./validation";

export type { Vector } from "../util/math";

/** The pose of a displayed message's frame at the stamp of the message. */
export interface DisplayPose {
  id: number;
  sequence: number;
  /** The index of the message's frame in the tree; -1 if it is unknown. */
  frame: number;
  /** x, y, z, qx, qy, qz, qw, relative to the origin of the frame update. */
  pose: Float32Array;
  ok: boolean;
}

/** The poses of all frames and displayed messages at one time. */
export interface FrameUpdate {
  kind: "frames";
  revision: number;
  /** Nanoseconds relative to hello.origin; NaN while there is no data. */
  time: number;
  origin: Vector;
  count: number;
  /** count x (x, y, z, qx, qy, qz, qw), relative to `origin`; NaN for frames without a pose. */
  poses: Float32Array;
  states: Uint8Array;
  displays: DisplayPose[];
}

export interface Cloud {
  kind: "cloud";
  id: number;
  sequence: number;
  count: number;
  /** Every n-th point of the message was sent. */
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

/** New cells of a grid that was received. */
export interface GridPart {
  kind: "grid_part";
  id: number;
  sequence: number;
  x: number;
  y: number;
  width: number;
  height: number;
  cells: Int8Array;
}

export interface Image {
  kind: "image";
  id: number;
  sequence: number;
  width: number;
  height: number;
  format: number;
  /** Every n-th row and column of the message was sent. */
  step: number;
  stamp: number;
  data: Uint8Array<ArrayBuffer>;
  /** Measured values, such as depths; null for images with colors or brightness. */
  values: Uint16Array | Float32Array | null;
}

export interface Shapes {
  kind: "shapes";
  id: number;
  sequence: number;
  description: ShapesDescription;
  payload: Float32Array;
}

/** New points of one curve; they replace earlier ones if `reset` is set. */
export interface CurvePoints {
  id: number;
  reset: boolean;
  /** Nanoseconds relative to hello.origin. */
  times: Float64Array;
  values: Float64Array;
}

export interface Curves {
  kind: "curves";
  curves: CurvePoints[];
}

/** The geometry of a node that a program has added. */
export interface NodeGeometry {
  kind: "node";
  id: number;
  /** Relative to `offset`. */
  vertices: Float32Array;
  indices: Uint32Array;
  /** Red, green, blue and alpha of each vertex, or of each pixel of an image; or empty. */
  colors: Uint8Array<ArrayBuffer>;
  /** Pixels in each row of an image. */
  width: number;
  offset: Vector;
}

export type BinaryMessage = FrameUpdate | DisplayMessage | Curves | NodeGeometry;
export type DisplayMessage = Cloud | Grid | GridPart | Shapes | Image;

/** Reads fields one after another; throws a ProtocolError if the data ends too early. */
class Reader implements FieldReader {
  private offset = 0;
  private readonly view: DataView;

  constructor(
    private readonly buffer: ArrayBuffer,
    private readonly what: string,
  ) {
    this.view = new DataView(buffer);
  }

  private advance(bytes: number): number {
    const start = this.offset;
    if (!Number.isSafeInteger(bytes) || bytes < 0 || start + bytes > this.buffer.byteLength)
      throw new ProtocolError(`${this.what}: ${bytes} bytes expected at ${start} of ${this.buffer.byteLength}`);
    this.offset = start + bytes;
    return start;
  }

  readUint32(): number {
    return this.view.getUint32(this.advance(4), true);
  }

  readFloat32(): number {
    return this.view.getFloat32(this.advance(4), true);
  }

  readFloat64(): number {
    return this.view.getFloat64(this.advance(8), true);
  }

  /** A view without a copy if the offset is a multiple of four, as it is in valid messages. */
  readFloats(count: number): Float32Array {
    const start = this.advance(count * 4);
    if (start % 4 === 0) return new Float32Array(this.buffer, start, count);
    return new Float32Array(this.buffer.slice(start, start + count * 4));
  }

  readIntegers(count: number): Uint32Array {
    const start = this.advance(count * 4);
    if (start % 4 === 0) return new Uint32Array(this.buffer, start, count);
    return new Uint32Array(this.buffer.slice(start, start + count * 4));
  }

  readDoubles(count: number): Float64Array {
    const start = this.advance(count * 8);
    if (start % 8 === 0) return new Float64Array(this.buffer, start, count);
    return new Float64Array(this.buffer.slice(start, start + count * 8));
  }

  bytes(count: number): Uint8Array<ArrayBuffer> {
    return new Uint8Array(this.buffer, this.advance(count), count);
  }

  align(): void {
    this.advance((4 - (this.offset % 4)) % 4);
  }

  remainingBytes(): number {
    return this.buffer.byteLength - this.offset;
  }
}

export function decode(buffer: ArrayBuffer): BinaryMessage {
  if (buffer.byteLength < 4) throw new ProtocolError(`a binary message of ${buffer.byteLength} bytes`);
  const kind = new DataView(buffer).getUint32(0, true);
  if (kind === BinaryKind.frames) return decodeFrameUpdate(new Reader(buffer, "frame update"));
  if (kind === BinaryKind.cloud) return decodeCloud(new Reader(buffer, "cloud"));
  if (kind === BinaryKind.grid) return decodeGrid(new Reader(buffer, "grid"));
  if (kind === BinaryKind.gridPart) return decodeGridPart(new Reader(buffer, "grid part"));
  if (kind === BinaryKind.shapes) return decodeShapes(new Reader(buffer, "shapes"));
  if (kind === BinaryKind.image) return decodeImage(new Reader(buffer, "image"));
  if (kind === BinaryKind.curves) return decodeCurves(new Reader(buffer, "curves"));
  if (kind === BinaryKind.node) return decodeNode(new Reader(buffer, "node"));
  throw new ProtocolError(`a binary message of unknown kind ${kind}`);
}

function decodeFrameUpdate(reader: Reader): FrameUpdate {
  const { revision, time, origin, frames: count, entries } = readFramesHeader(reader);
  const poses = reader.readFloats(count * 7);
  const states = reader.bytes(count);
  reader.align();
  const displays: DisplayPose[] = [];
  for (let i = 0; i < entries; i++) {
    const { display: id, sequence, frame, pose, missing } = readEntryRecord(reader);
    displays.push({ id, sequence, frame: frame < count ? frame : -1, pose, ok: missing === 0 });
  }
  return { kind: "frames", revision, time, origin, count, poses, states, displays };
}

function decodeCloud(reader: Reader): Cloud {
  const { display: id, sequence, points: count, flags, stamp, range } = readCloudHeader(reader);
  const points = reader.readFloats(count * 3);
  const scalar = flags & CloudFlag.scalars ? reader.readFloats(count) : null;
  const rgba = flags & CloudFlag.colors ? reader.bytes(count * 4) : null;
  return { kind: "cloud", id, sequence, count, step: Math.max(1, flags >>> 8), stamp, range, points, scalar, rgba };
}

function decodeGrid(reader: Reader): Grid {
  const { display: id, sequence, width, height, resolution, corner: origin } = readGridHeader(reader);
  const bytes = reader.bytes(width * height);
  const cells = new Int8Array(bytes.buffer, bytes.byteOffset, bytes.length);
  return { kind: "grid", id, sequence, width, height, resolution, origin, cells };
}

function decodeGridPart(reader: Reader): GridPart {
  const { display: id, sequence, x, y, width, height } = readGridPartHeader(reader);
  const bytes = reader.bytes(width * height);
  const cells = new Int8Array(bytes.buffer, bytes.byteOffset, bytes.length);
  return { kind: "grid_part", id, sequence, x, y, width, height, cells };
}

function decodeShapes(reader: Reader): Shapes {
  const { display: id, sequence, length } = readShapesHeader(reader);
  const text = new TextDecoder().decode(reader.bytes(length));
  reader.align();
  let description: ShapesDescription;
  try {
    description = JSON.parse(text) as ShapesDescription;
  } catch {
    throw new ProtocolError("shapes: the description is not JSON");
  }
  return {
    kind: "shapes",
    id,
    sequence,
    description,
    payload: reader.readFloats(Math.floor(reader.remainingBytes() / 4)),
  };
}

function decodeImage(reader: Reader): Image {
  const { display: id, sequence, width, height, format: flags, stamp } = readImageHeader(reader);
  const format = flags & 255;
  const step = Math.max(1, flags >>> 8);
  const bytes = BYTES_PER_PIXEL[format];
  const data = reader.bytes(bytes === undefined ? reader.remainingBytes() : bytes * width * height);
  const values =
    format === ImageFormat.gray16
      ? new Uint16Array(data.slice().buffer)
      : format === ImageFormat.float
        ? new Float32Array(data.slice().buffer)
        : null;
  return { kind: "image", id, sequence, width, height, format, step, stamp, data, values };
}

const BYTES_PER_PIXEL: Readonly<Record<number, number>> = {
  [ImageFormat.gray]: 1,
  [ImageFormat.rgb]: 3,
  [ImageFormat.gray16]: 2,
  [ImageFormat.float]: 4,
};

function decodeCurves(reader: Reader): Curves {
  const { curves: count } = readCurvesHeader(reader);
  const records = [];
  for (let i = 0; i < count; i++) records.push(readCurveRecord(reader));
  const curves = records.map(({ curve, reset, points }) => ({
    id: curve,
    reset: reset === 1,
    times: reader.readDoubles(points),
    values: reader.readDoubles(points),
  }));
  return { kind: "curves", curves };
}

function decodeNode(reader: Reader): NodeGeometry {
  const { node: id, vertices: count, indices: used, colors: colored, width, offset } = readNodeHeader(reader);
  const vertices = reader.readFloats(count * 3);
  const indices = reader.readIntegers(used);
  if (!indices.every((index) => index < count)) throw new ProtocolError("node: an index of a vertex is too large");
  const colors = reader.bytes(colored * 4);
  return { kind: "node", id, vertices, indices, colors, width, offset };
}

/** Rows of a payload; empty if the pair is outside of it. */
export function slice(payload: Float32Array, at: [number, number] | null | undefined, width: number): Float32Array {
  const [offset, rows] = at ?? [0, 0];
  const end = offset + rows * width;
  if (!(offset >= 0 && rows >= 0 && end <= payload.length)) return new Float32Array(0);
  return payload.subarray(offset, end);
}
