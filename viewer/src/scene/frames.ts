// SPDX-License-Identifier: Apache-2.0
/** Draws the frames: axes, lines to the parents and the highlighted chain, in few draw calls. */

import * as THREE from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import type { Forest } from "../model/model";
import type { FramePoses } from "./frame_poses";
import type { Palette } from "../util/theme";

/** RViz draws a frame with axes of 0.2 m at Marker Scale 1. */
export const AXIS_M = 0.2;
/** Above this number of frames, axes have four sides and no caps: a fifth of the vertices, for software rendering. */
const MAX_DETAILED_FRAMES = 200;

export interface FrameOptions {
  scale: number;
  axes: boolean;
  arrows: boolean;
}

export class FramesView {
  readonly object = new THREE.Group();
  /** The objects that are always drawn. */
  readonly alwaysDrawn: THREE.Object3D[];
  private readonly axes: THREE.InstancedMesh;
  private axesCapacity = 0;
  private fade = new THREE.InstancedBufferAttribute(new Float32Array(0), 1);
  private readonly edges: THREE.LineSegments;
  private readonly chain: LineSegments2;
  private readonly chainMaterial = new LineMaterial({ linewidth: 4, depthTest: false, transparent: true });
  private readonly material = axesMaterial();
  private palette: Palette;

  constructor(palette: Palette) {
    this.palette = palette;
    this.axes = new THREE.InstancedMesh(new THREE.BufferGeometry(), this.material, 0);
    this.axes.frustumCulled = false;
    this.edges = new THREE.LineSegments(
      new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({ vertexColors: true }),
    );
    this.edges.frustumCulled = false;
    this.chain = new LineSegments2(new LineSegmentsGeometry(), this.chainMaterial);
    this.chain.frustumCulled = false;
    this.chain.visible = false;
    this.chain.renderOrder = 10;
    this.alwaysDrawn = [this.axes, this.edges];
    this.object.add(...this.alwaysDrawn, this.chain);
    this.setPalette(palette);
  }

  setPalette(palette: Palette): void {
    this.palette = palette;
    this.rebuildAxes();
    (this.material.uniforms.background as THREE.IUniform<THREE.Vector3>).value = srgb(palette.background);
    this.chainMaterial.color.set(palette.chain);
    this.edges.geometry.deleteAttribute("position");
  }

  update(framePoses: FramePoses, forest: Forest, options: FrameOptions): void {
    this.updateAxes(framePoses, options);
    this.updateEdges(framePoses, forest, options);
  }

  /** Draws the chain between two frames on top of everything else. */
  setChain(framePoses: FramePoses, chain: number[]): void {
    const points: number[] = [];
    for (let k = 1; k < chain.length; k++) {
      const [a, b] = [chain[k - 1] as number, chain[k] as number];
      if (!framePoses.drawn[a] || !framePoses.drawn[b]) continue;
      for (const i of [a, b])
        for (let axis = 0; axis < 3; axis++) points.push(framePoses.positions[i * 3 + axis] as number);
    }
    this.chain.visible = points.length > 0;
    if (!this.chain.visible) return;
    this.chain.geometry.dispose();
    this.chain.geometry = new LineSegmentsGeometry().setPositions(points);
  }

  private updateAxes(framePoses: FramePoses, options: FrameOptions): void {
    const { count } = framePoses;
    this.axes.visible = options.axes && count > 0;
    if (!this.axes.visible) return;
    if (count > this.axesCapacity) this.reserve(count);
    this.axes.count = count;
    const fade = this.fade.array as Float32Array;
    const length = AXIS_M * options.scale;
    const out = this.axes.instanceMatrix.array as Float32Array;
    for (let i = 0; i < count; i++) {
      fade[i] = framePoses.fade[i] as number;
      writeMatrix(out, i * 16, framePoses, i, framePoses.drawn[i] ? length : 0);
    }
    this.fade.needsUpdate = true;
    this.axes.instanceMatrix.needsUpdate = true;
  }

  private rebuildAxes(): void {
    this.axes.geometry.dispose();
    this.axes.geometry = axesGeometry(this.palette, undefined, this.axesCapacity > MAX_DETAILED_FRAMES);
    this.axes.geometry.setAttribute("fade", this.fade);
  }

  private reserve(count: number): void {
    this.axesCapacity = Math.ceil(count * 1.25) + 16;
    this.axes.dispose();
    this.axes.instanceMatrix = new THREE.InstancedBufferAttribute(new Float32Array(this.axesCapacity * 16), 16);
    this.fade = new THREE.InstancedBufferAttribute(new Float32Array(this.axesCapacity), 1);
    this.rebuildAxes();
  }

  private updateEdges(framePoses: FramePoses, forest: Forest, options: FrameOptions): void {
    const { count, positions } = framePoses;
    this.edges.visible = options.arrows && count > 1;
    if (!this.edges.visible) return;
    const geometry = this.edges.geometry;
    let position = geometry.getAttribute("position") as THREE.BufferAttribute | undefined;
    if (!position || position.count < count * 2) {
      position = new THREE.BufferAttribute(new Float32Array(count * 6), 3);
      geometry.dispose();
      geometry.setAttribute("position", position);
      geometry.setAttribute("color", new THREE.BufferAttribute(edgeColors(count, this.palette), 3));
    }
    const out = position.array as Float32Array;
    let used = 0;
    for (let i = 0; i < count; i++) {
      const parent = forest.frames[i]?.parent ?? -1;
      if (parent < 0 || !framePoses.drawn[i] || !framePoses.drawn[parent]) continue;
      for (let axis = 0; axis < 3; axis++) {
        out[used * 6 + axis] = positions[i * 3 + axis] as number;
        out[used * 6 + 3 + axis] = positions[parent * 3 + axis] as number;
      }
      used++;
    }
    geometry.setDrawRange(0, used * 2);
    position.needsUpdate = true;
  }
}

/** Writes rotation, uniform scale and position as a column-major matrix into the array of the instances. */
function writeMatrix(out: Float32Array, o: number, framePoses: FramePoses, i: number, scale: number): void {
  const q = framePoses.quaternions;
  const [x, y, z, w] = [q[i * 4] as number, q[i * 4 + 1] as number, q[i * 4 + 2] as number, q[i * 4 + 3] as number];
  if (scale === 0) {
    out.fill(0, o, o + 16);
    return;
  }
  const s = scale;
  out[o] = (1 - 2 * (y * y + z * z)) * s;
  out[o + 1] = 2 * (x * y + w * z) * s;
  out[o + 2] = 2 * (x * z - w * y) * s;
  out[o + 3] = 0;
  out[o + 4] = 2 * (x * y - w * z) * s;
  out[o + 5] = (1 - 2 * (x * x + z * z)) * s;
  out[o + 6] = 2 * (y * z + w * x) * s;
  out[o + 7] = 0;
  out[o + 8] = 2 * (x * z + w * y) * s;
  out[o + 9] = 2 * (y * z - w * x) * s;
  out[o + 10] = (1 - 2 * (x * x + y * y)) * s;
  out[o + 11] = 0;
  out[o + 12] = framePoses.positions[i * 3] as number;
  out[o + 13] = framePoses.positions[i * 3 + 1] as number;
  out[o + 14] = framePoses.positions[i * 3 + 2] as number;
  out[o + 15] = 1;
}

/** The axes x, y and z as one geometry: colored cylinders of length 1. */
export function axesGeometry(palette: Palette, radius = 0.055, plain = false): THREE.BufferGeometry {
  const parts = palette.axes.map((color, axis) => {
    const part = new THREE.CylinderGeometry(radius, radius, 1, plain ? 4 : 8, 1, plain);
    part.translate(0, 0.5, 0);
    if (axis === 0) part.rotateZ(-Math.PI / 2);
    if (axis === 2) part.rotateX(Math.PI / 2);
    const rgb = srgb(color);
    const colors = new Float32Array(part.getAttribute("position").count * 3);
    for (let k = 0; k < colors.length; k += 3) colors.set([rgb.x, rgb.y, rgb.z], k);
    part.setAttribute("color", new THREE.BufferAttribute(colors, 3));
    part.deleteAttribute("uv");
    return part;
  });
  const merged = mergeGeometries(parts);
  parts.forEach((part) => part.dispose());
  return merged;
}

/** Colors with slight shading; stale frames fade into the background. */
function axesMaterial(): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    vertexColors: true,
    uniforms: { background: { value: new THREE.Vector3() } },
    vertexShader: `
      attribute float fade;
      uniform vec3 background;
      varying vec3 shaded;
      void main() {
        vec3 n = normalize(normalMatrix * mat3(instanceMatrix) * normal);
        float shade = 0.72 + 0.28 * abs(n.z) + 0.08 * n.y;
        shaded = mix(color * shade, background, fade);
        gl_Position = projectionMatrix * modelViewMatrix * instanceMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: `
      varying vec3 shaded;
      void main() { gl_FragColor = vec4(shaded, 1.0); }`,
  });
}

/** The sRGB components of a color, for shaders that write them to the screen unchanged. */
export function srgb(color: string): THREE.Vector3 {
  const rgb = new THREE.Color(color).getRGB({ r: 0, g: 0, b: 0 }, THREE.SRGBColorSpace);
  return new THREE.Vector3(rgb.r, rgb.g, rgb.b);
}

/** Lines are bright at the child and dim at the parent, which shows the direction without arrow heads. */
function edgeColors(count: number, palette: Palette): Float32Array {
  const ends = palette.edge.map((color) => new THREE.Color(color));
  const colors = new Float32Array(count * 6);
  for (let i = 0; i < count; i++) ends.forEach((end, k) => end.toArray(colors, i * 6 + k * 3));
  return colors;
}
