// SPDX-License-Identifier: Apache-2.0
/** The Marker and MarkerArray displays. The type numbers are those of visualization_msgs/Marker. */

import * as THREE from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { materialsOf, type Meshes } from "../scene/meshes";
import { textSprite } from "../scene/text_sprite";
import { slice, type DisplayMessage, type MarkerItem, type Shapes, type Vector } from "../protocol/messages";
import { arrowGeometry } from "./arrows";
import type { PickedPart } from "../model/picked";
import type { Hit } from "../scene/picking";
import { isInside, MessageDisplay, type Context, type DisplayConfig } from "./display";
import { billboards } from "./billboards";

const MAX_NAMESPACES = 200;
const MAX_TEXT = 200;
/** The names of the types, in the order of visualization_msgs/Marker. */
const TYPE_NAMES = [
  ..."ARROW CUBE SPHERE CYLINDER LINE_STRIP LINE_LIST CUBE_LIST SPHERE_LIST POINTS".split(" "),
  ..."TEXT_VIEW_FACING MESH_RESOURCE TRIANGLE_LIST ARROW_STRIP".split(" "),
];
/** The types with several parts, of which one is hit. */
const LISTS = new Set([4, 5, 6, 7, 8, 11]);

export class MarkersDisplay extends MessageDisplay<Shapes, "Marker" | "MarkerArray"> {
  constructor(
    id: number,
    config: DisplayConfig,
    context: Context,
    private readonly meshes: Meshes,
  ) {
    super(id, config, context);
  }

  private get tools(): MarkerTools {
    return {
      meshes: this.meshes,
      redraw: () => this.context.redraw(),
      problem: (text) => (this.status = { state: "error", text }),
    };
  }

  /** The namespaces received so far. */
  readonly namespaces = new Set<string>();
  /** Called when a new namespace is received. */
  onNamespace = (): void => {};

  /** Whether the markers of a namespace are displayed. */
  isShown(name: string): boolean {
    const all = this.config.options["Namespaces"];
    return !(all && typeof all === "object" && !Array.isArray(all) && Object.hasOwn(all, name) && all[name] === false);
  }

  show(name: string, isShown: boolean): void {
    const all = this.config.options["Namespaces"];
    const others = all && typeof all === "object" && !Array.isArray(all) ? all : {};
    this.config.options["Namespaces"] = { ...others, [name]: isShown };
  }

  override receive(message: DisplayMessage): void {
    super.receive(message);
    if (message.kind !== "shapes" || message.description.kind !== "markers") return;
    const before = this.namespaces.size;
    for (const { ns } of message.description.items) if (this.namespaces.size < MAX_NAMESPACES) this.namespaces.add(ns);
    if (this.namespaces.size > before) this.onNamespace();
  }

  /** Returns the center and the size of each marker. */
  protected override describe(_message: Shapes, object: THREE.Object3D): Record<string, unknown> {
    const markers = object.children.map((part) => {
      const box = new THREE.Box3().setFromObject(part);
      const [center, size] = [box.getCenter(new THREE.Vector3()), box.getSize(new THREE.Vector3())];
      return { ...part.userData.marker, center: this.toFixedFrame(center), size: size.toArray() };
    });
    return { markers };
  }

  protected build({ description, payload }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (description.kind !== "markers") return group;
    for (const item of description.items) {
      const object = this.isShown(item.ns) ? markerObject(item, payload, this.tools) : null;
      if (!object) continue;
      object.userData.item = item;
      object.userData.marker = { ns: item.ns, id: item.id, type: item.type };
      group.add(object);
    }
    return group;
  }

  protected override partAt(message: Shapes, object: THREE.Object3D, hit: Hit): PickedPart {
    const part = super.partAt(message, object, hit);
    const item = object.children.find((child) => isInside(hit.object, child))?.userData.item as MarkerItem | undefined;
    if (!item) return part;
    const numbers = (values: readonly (number | null)[]): string =>
      values.map((value) => Number((value ?? NaN).toPrecision(6))).join(", ");
    return {
      ...part,
      title: `Marker ${item.ns ? `${item.ns} ` : ""}${item.id}`,
      rows: [
        ["namespace", item.ns],
        ["id", String(item.id)],
        ["type", TYPE_NAMES[item.type] ?? String(item.type)],
        ["pose", numbers(item.pose)],
        ["scale", numbers(item.scale)],
        ["color", numbers(item.rgba)],
        ["text", item.text],
        ["mesh", item.mesh ?? ""],
        ["part", hit.index !== null && LISTS.has(item.type) ? String(hit.index) : ""],
      ],
    };
  }

  protected override *partsOf(_message: Shapes, object: THREE.Object3D): Iterable<Hit> {
    for (const child of object.children) {
      const box = new THREE.Box3().setFromObject(child);
      if (!box.isEmpty()) yield { object: child, point: box.getCenter(new THREE.Vector3()), index: null };
    }
  }
}

/** What markers need besides their description. */
export interface MarkerTools {
  meshes: Meshes;
  redraw(): void;
  /** Reports why a part is not drawn. */
  problem(text: string): void;
}

/** The object of a marker, without its pose; null if it cannot be drawn. */
export function markerObject(item: MarkerItem, payload: Float32Array, tools: MarkerTools): THREE.Object3D | null {
  if (!isDrawable(item)) return null;
  const object = shapeOf(item, payload, tools);
  object?.position.fromArray(item.pose);
  object?.quaternion.fromArray(item.pose, 3).normalize();
  return object;
}

function shapeOf(item: DrawableMarker, payload: Float32Array, tools: MarkerTools): THREE.Object3D | null {
  const points = slice(payload, item.points, 3);
  const colors = slice(payload, item.colors, 4);
  switch (item.type) {
    case 0:
      return arrow(item, points);
    case 1:
      return makeSolidMesh(new THREE.BoxGeometry(1, 1, 1), item);
    case 2:
      return makeSolidMesh(new THREE.SphereGeometry(0.5, 24, 16), item);
    case 3:
      return makeSolidMesh(new THREE.CylinderGeometry(0.5, 0.5, 1, 32).rotateX(Math.PI / 2), item);
    case 4:
      return lines(item, pairs(points, 3), pairs(colors, 4));
    case 5:
      return lines(item, points, colors);
    case 6:
      return instanced(new THREE.BoxGeometry(1, 1, 1), item, points, colors);
    case 7:
      return instanced(new THREE.SphereGeometry(0.5, 12, 8), item, points, colors);
    case 8:
      return makeSquares(item, points, colors);
    case 9:
      return text(item);
    case 10:
      return meshOf(item, tools);
    case 11:
      return triangles(item, points, colors);
    case 12:
      return arrowStrip(item, points);
    default:
      tools.problem(`Unknown marker type ${item.type}. Known types: 0 to 12.`);
      return null;
  }
}

function meshOf(item: DrawableMarker, tools: MarkerTools): THREE.Object3D {
  const group = new THREE.Group();
  group.scale.set(...item.scale);
  if (!item.mesh) {
    if (item.mesh_problem) tools.problem(item.mesh_problem);
    return group;
  }
  tools.meshes.load(item.mesh, item.mesh).then(
    ({ object, hasColors: colored }) => {
      if (!(colored && item.use_materials !== false))
        object.traverse((part) => {
          if ((part as Partial<THREE.Mesh>).isMesh) (part as THREE.Mesh).material = material(item);
        });
      for (const part of materialsOf(object)) part.side = THREE.DoubleSide;
      group.add(object);
      tools.redraw();
    },
    (error: unknown) => {
      tools.problem(error instanceof Error ? error.message : String(error));
    },
  );
  return group;
}

/** A marker whose pose and scale are finite. */
type DrawableMarker = Omit<MarkerItem, "pose" | "scale"> & { pose: number[]; scale: Vector };

function isDrawable(item: MarkerItem): item is DrawableMarker {
  return item.pose.length === 7 && item.pose.every(Number.isFinite) && item.scale.every(Number.isFinite);
}

function colorOf([r, g, b]: readonly (number | null)[]): THREE.Color {
  return new THREE.Color().setRGB(r ?? 1, g ?? 1, b ?? 1, THREE.SRGBColorSpace);
}

function alphaOf(item: DrawableMarker): number {
  return Math.max(0, Math.min(1, item.rgba[3] ?? 1));
}

function material(item: DrawableMarker): THREE.MeshLambertMaterial {
  const alpha = alphaOf(item);
  return new THREE.MeshLambertMaterial({
    color: colorOf(item.rgba),
    transparent: alpha < 1,
    opacity: alpha,
    depthWrite: alpha >= 1,
  });
}

function makeSolidMesh(geometry: THREE.BufferGeometry, item: DrawableMarker): THREE.Mesh {
  const mesh = new THREE.Mesh(geometry, material(item));
  mesh.scale.set(...item.scale);
  return mesh;
}

/** An arrow from the first point to the second, or along x with scale as length, width and height. */
function arrow(item: DrawableMarker, points: Float32Array): THREE.Object3D {
  const [x, y, z] = item.scale;
  if (points.length < 6) {
    const shape = { shaftLength: 0.77, shaftRadius: 0.5, headLength: 0.23, headRadius: 1 };
    const mesh = new THREE.Mesh(arrowGeometry(shape), material(item));
    mesh.scale.set(x, y / 2, z / 2);
    return mesh;
  }
  return arrowBetween(item, points, x / 2, y / 2, z);
}

function arrowBetween(
  item: DrawableMarker,
  points: Float32Array,
  shaftRadius: number,
  headRadius: number,
  headLength: number,
): THREE.Object3D {
  const from = new THREE.Vector3().fromArray(points);
  const to = new THREE.Vector3().fromArray(points, 3);
  const length = from.distanceTo(to);
  const head = Math.min(length, headLength > 0 ? headLength : length * 0.23);
  const shape = { shaftLength: length - head, shaftRadius, headLength: head, headRadius };
  const mesh = new THREE.Mesh(arrowGeometry(shape), material(item));
  const group = new THREE.Group();
  mesh.position.copy(from);
  if (length > 0) mesh.quaternion.setFromUnitVectors(new THREE.Vector3(1, 0, 0), to.sub(from).normalize());
  group.add(mesh);
  return group;
}

function arrowStrip(item: DrawableMarker, points: Float32Array): THREE.Object3D {
  const group = new THREE.Group();
  for (let i = 0; i + 6 <= points.length; i += 3)
    group.add(arrowBetween(item, points.subarray(i, i + 6), item.scale[0] / 2, item.scale[1] / 2, item.scale[2]));
  return group;
}

/** Converts a line strip to segments, which repeat all inner points. */
function pairs(values: Float32Array, width: number): Float32Array {
  const count = Math.max(0, values.length / width - 1);
  const out = new Float32Array(count * 2 * width);
  for (let i = 0; i < count; i++) out.set(values.subarray(i * width, (i + 2) * width), i * 2 * width);
  return out;
}

function lines(item: DrawableMarker, points: Float32Array, colors: Float32Array): THREE.Object3D {
  const group = new THREE.Group();
  if (points.length < 6 || !points.every(Number.isFinite)) return group;
  const complete = points.subarray(0, Math.floor(points.length / 6) * 6);
  const geometry = new LineSegmentsGeometry().setPositions(complete);
  const colored = colors.length / 4 >= complete.length / 3;
  if (colored) geometry.setColors(linear(colors, complete.length / 3));
  const alpha = alphaOf(item);
  const segments = new LineSegments2(
    geometry,
    new LineMaterial({
      color: colored ? 0xffffff : colorOf(item.rgba).getHex(),
      vertexColors: colored,
      worldUnits: true,
      linewidth: Math.max(1e-4, item.scale[0]),
      transparent: alpha < 1 && !colored,
      opacity: colored ? 1 : alpha,
    }),
  );
  segments.frustumCulled = false;
  group.add(segments);
  return group;
}

function linear(colors: Float32Array, count: number): Float32Array {
  const out = new Float32Array(count * 3);
  for (let i = 0; i < count; i++) colorOf(colors.subarray(i * 4, i * 4 + 3) as unknown as number[]).toArray(out, i * 3);
  return out;
}

function instanced(
  geometry: THREE.BufferGeometry,
  item: DrawableMarker,
  points: Float32Array,
  colors: Float32Array,
): THREE.Object3D {
  const count = Math.floor(points.length / 3);
  const colored = colors.length / 4 >= count;
  const made = material(item);
  if (colored) made.color.set(0xffffff);
  const mesh = new THREE.InstancedMesh(geometry, made, count);
  const matrix = new THREE.Matrix4();
  const [x, y, z] = item.scale;
  for (let i = 0; i < count; i++) {
    matrix.makeScale(x, y, z).setPosition(new THREE.Vector3().fromArray(points, i * 3));
    mesh.setMatrixAt(i, matrix);
    if (colored) mesh.setColorAt(i, colorOf(colors.subarray(i * 4, i * 4 + 3) as unknown as number[]));
  }
  mesh.frustumCulled = false;
  return mesh;
}

/** Rectangles that face the camera, at points. */
function makeSquares(item: DrawableMarker, points: Float32Array, colors: Float32Array): THREE.Object3D {
  const colored = colors.length / 4 >= points.length / 3;
  const rgba = new Uint8Array((points.length / 3) * 4);
  for (let i = 0; i < rgba.length; i++) {
    const value = colored ? colors[i] : item.rgba[i % 4];
    rgba[i] = Math.round(255 * Math.max(0, Math.min(1, value ?? 1)));
  }
  return billboards(points, rgba, item.scale[0], item.scale[1]);
}

function triangles(item: DrawableMarker, points: Float32Array, colors: Float32Array): THREE.Object3D {
  const count = Math.floor(points.length / 9) * 3;
  const geometry = new THREE.BufferGeometry();
  const scaled = points.slice(0, count * 3).map((value, i) => value * (item.scale[i % 3] as number));
  geometry.setAttribute("position", new THREE.BufferAttribute(scaled, 3));
  geometry.computeVertexNormals();
  const made = material(item);
  made.side = THREE.DoubleSide;
  if (colors.length / 4 >= count) {
    geometry.setAttribute("color", new THREE.BufferAttribute(linear(colors, count), 3));
    made.vertexColors = true;
    made.color.set(0xffffff);
  }
  return new THREE.Mesh(geometry, made);
}

/** Text that faces the camera; scale.z is the height of a line in meters. */
function text(item: DrawableMarker): THREE.Object3D | null {
  return textSprite(item.text.slice(0, MAX_TEXT), colorOf(item.rgba), item.scale[2], alphaOf(item));
}
