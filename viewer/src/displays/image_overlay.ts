// SPDX-License-Identifier: Apache-2.0
/** Draws frames, clouds and shapes of the scene where a camera sees them, above its image. */

import * as THREE from "three";
import type { Project } from "../util/camera_model";
import { h, shorten } from "../util/dom";
import type { Palette } from "../util/theme";
import { cloudColors } from "./cloud_colors";

/** What is drawn; all poses are in the scene. */
export interface OverlayContent {
  frames: readonly { name: string; pose: THREE.Matrix4 }[];
  axisLength: number;
  clouds: readonly THREE.Points[];
  /** Meshes and lines. */
  shapes: readonly THREE.Object3D[];
}

type Pixel = [u: number, v: number];

/** Larger clouds are thinned, because a canvas takes about 0.1 microseconds per point. */
const MAX_POINTS = 20_000;
const MAX_EDGES = 20_000;
/** Lines are divided into this many parts, because lenses bend them. */
const PARTS = 6;
const POINT_PX = 2;
const EDGE_ANGLE_DEGREES = 15;

export class ImageOverlay {
  readonly canvas = h("canvas", { class: "projection", aria: { hidden: "true" } });
  /** What was drawn last, in pixels of the image, for tests. */
  projected: { frames: Record<string, Pixel>; points: number; edges: number } = { frames: {}, points: 0, edges: 0 };
  private readonly edges = new WeakMap<THREE.BufferGeometry, Float32Array>();
  private project: Project = () => null;
  private toCamera = new THREE.Matrix4();
  private context: CanvasRenderingContext2D | null = null;
  private readonly point = new THREE.Vector3();

  clear(): void {
    this.projected = { frames: {}, points: 0, edges: 0 };
    this.canvas.width = 0;
  }

  /**
   * Draws the content.
   *
   * @param project Projects points in the optical frame to pixels of the full image.
   * @param camera The pose of the optical frame in the scene.
   * @param size The size of the full image in pixels.
   * @param shown The size of the image on the screen in CSS pixels.
   */
  draw(
    project: Project,
    camera: THREE.Matrix4,
    size: { width: number; height: number },
    shown: { width: number; height: number },
    content: OverlayContent,
    palette: Palette,
    distinct: boolean,
  ): void {
    const ratio = devicePixelRatio;
    const { canvas } = this;
    [canvas.width, canvas.height] = [Math.round(shown.width * ratio), Math.round(shown.height * ratio)];
    this.context = canvas.getContext("2d");
    if (!this.context || canvas.width === 0) return;
    this.context.scale(canvas.width / size.width, canvas.height / size.height);
    this.project = project;
    this.toCamera = camera.clone().invert();
    this.projected = { frames: {}, points: 0, edges: 0 };
    const pixel = size.width / shown.width;
    for (const cloud of content.clouds) this.drawCloud(cloud, pixel, distinct);
    this.context.lineWidth = 1.5 * pixel;
    for (const shape of content.shapes) this.drawShape(shape);
    this.drawFrames(content, palette, pixel);
  }

  private drawFrames({ frames, axisLength }: OverlayContent, palette: Palette, pixel: number): void {
    const context = this.context as CanvasRenderingContext2D;
    context.lineWidth = 2 * pixel;
    context.font = `${11 * pixel}px sans-serif`;
    for (const { name, pose } of frames) {
      const inCamera = this.toCamera.clone().multiply(pose);
      const origin = this.pixelOf(inCamera, 0, 0, 0);
      if (!origin) continue;
      this.projected.frames[name] = origin;
      palette.axes.forEach((color, axis) => {
        const end = [0, 0, 0].map((_, k) => (k === axis ? axisLength : 0)) as [number, number, number];
        context.strokeStyle = color;
        this.line(inCamera, [0, 0, 0], end);
      });
      context.strokeStyle = palette.background;
      context.fillStyle = palette.measure;
      const text = shorten(name, 40);
      context.lineWidth = 3 * pixel;
      context.strokeText(text, origin[0] + 5 * pixel, origin[1] - 4 * pixel);
      context.fillText(text, origin[0] + 5 * pixel, origin[1] - 4 * pixel);
      context.lineWidth = 2 * pixel;
    }
  }

  private drawCloud(cloud: THREE.Points, pixel: number, useDistinctColors: boolean): void {
    const context = this.context as CanvasRenderingContext2D;
    const inCamera = this.toCamera.clone().multiply(cloud.matrixWorld);
    const positions = cloud.geometry.getAttribute("position").array;
    const colorOf = cloudColors(cloud, useDistinctColors);
    const count = positions.length / 3;
    const step = Math.max(1, Math.ceil(count / MAX_POINTS));
    const width = POINT_PX * pixel;
    for (let i = 0; i < count; i += step) {
      const [x, y, z] = [positions[i * 3], positions[i * 3 + 1], positions[i * 3 + 2]] as [number, number, number];
      const at = this.pixelOf(inCamera, x, y, z);
      if (!at) continue;
      this.projected.points++;
      context.fillStyle = colorOf(i);
      context.fillRect(at[0] - width / 2, at[1] - width / 2, width, width);
    }
  }

  private drawShape(object: THREE.Object3D): void {
    const context = this.context as CanvasRenderingContext2D;
    const segments = this.segmentsOf(object);
    if (!segments) return;
    context.strokeStyle = colorOf(object);
    const poses: THREE.Matrix4[] = [];
    if (object instanceof THREE.InstancedMesh)
      for (let i = 0; i < object.count; i++) {
        const own = new THREE.Matrix4();
        object.getMatrixAt(i, own);
        poses.push(own.premultiply(object.matrixWorld));
      }
    else poses.push(object.matrixWorld);
    for (const pose of poses) {
      const inCamera = this.toCamera.clone().multiply(pose);
      for (let i = 0; i + 5 < segments.length && this.projected.edges < MAX_EDGES; i += 6) {
        this.projected.edges++;
        const [a, b] = [segments.subarray(i, i + 3), segments.subarray(i + 3, i + 6)];
        this.line(inCamera, a as unknown as [number, number, number], b as unknown as [number, number, number]);
      }
    }
  }

  /** Pairs of points: the edges of a mesh, or the segments of a line; null for other objects. */
  private segmentsOf(object: THREE.Object3D): Float32Array | null {
    const { geometry } = object as Partial<THREE.Mesh>;
    if (!geometry) return null;
    const start = geometry.getAttribute("instanceStart") as THREE.InterleavedBufferAttribute | undefined;
    if (start) return start.data.array as Float32Array;
    const known = this.edges.get(geometry);
    if (known) return known;
    let found: Float32Array | null = null;
    if (object instanceof THREE.Mesh) {
      const edges = new THREE.EdgesGeometry(geometry, EDGE_ANGLE_DEGREES);
      found = edges.getAttribute("position").array as Float32Array;
      edges.dispose();
    } else if (object instanceof THREE.Line) {
      const points = geometry.getAttribute("position").array;
      const pairs = object instanceof THREE.LineSegments;
      const out: number[] = [];
      for (let i = 0; i + 5 < points.length; i += pairs ? 6 : 3) out.push(...points.slice(i, i + 6));
      found = new Float32Array(out);
    }
    if (found) this.edges.set(geometry, found);
    return found;
  }

  private line(inCamera: THREE.Matrix4, a: ArrayLike<number>, b: ArrayLike<number>): void {
    const context = this.context as CanvasRenderingContext2D;
    context.beginPath();
    let drawing = false;
    for (let k = 0; k <= PARTS; k++) {
      const [x, y, z] = [0, 1, 2].map(
        (axis) => (a[axis] as number) + (((b[axis] as number) - (a[axis] as number)) * k) / PARTS,
      ) as [number, number, number];
      const at = this.pixelOf(inCamera, x, y, z);
      if (at && drawing) context.lineTo(...at);
      else if (at) context.moveTo(...at);
      drawing = at !== null;
    }
    context.stroke();
  }

  private pixelOf(inCamera: THREE.Matrix4, x: number, y: number, z: number): Pixel | null {
    const point = this.point.set(x, y, z).applyMatrix4(inCamera);
    return this.project(point.x, point.y, point.z);
  }
}

function colorOf(object: THREE.Object3D): string {
  const { material } = object as THREE.Mesh;
  const first = Array.isArray(material) ? material[0] : material;
  const color = (first as Partial<THREE.MeshBasicMaterial> | undefined)?.color;
  return color ? `#${color.getHexString()}` : "#ffffff";
}
