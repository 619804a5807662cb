// SPDX-License-Identifier: Apache-2.0
/** The LaserScan and PointCloud2 displays: points, colored on the graphics card. */

import * as THREE from "three";
import { srgb } from "../scene/frames";
import type { Cloud, DisplayOptions } from "../protocol/messages";
import type { PickedPart } from "../model/picked";
import type { Hit } from "../scene/picking";
import { MessageDisplay } from "./display";

const SAMPLES = 4096;
const VIEWPORT = new THREE.Vector4();
/** Software rendering takes 2.5 microseconds per point, during which the page blocks. */
const MAX_POINTS_IN_SOFTWARE = 40_000;

export class CloudDisplay extends MessageDisplay<Cloud, "LaserScan" | "PointCloud2"> {
  override subscription(): DisplayOptions {
    return {
      ...super.subscription(),
      ...(this.context.software() ? { max_points: MAX_POINTS_IN_SOFTWARE } : {}),
    };
  }

  protected build(message: Cloud): THREE.Object3D {
    const reason = this.context.replayed() ? "thinned for the replay" : "thinned without a graphics card";
    this.note = message.step > 1 ? `1 of ${message.step} points, ${reason}` : "";
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(message.points, 3));
    const mode = this.mode(message);
    if (mode === "rgb" && message.rgba) geometry.setAttribute("rgba", new THREE.BufferAttribute(message.rgba, 4, true));
    if (mode === "scalar" && message.scalar)
      geometry.setAttribute("scalar", new THREE.BufferAttribute(message.scalar, 1));
    const points = new THREE.Points(geometry, this.material(mode, message));
    points.frustumCulled = false;
    return points;
  }

  protected override describe(message: Cloud, object: THREE.Object3D): Record<string, unknown> {
    const { range } = ((object as THREE.Points).material as THREE.ShaderMaterial).uniforms;
    const colors = (range as THREE.IUniform<THREE.Vector2>).value.toArray();
    return {
      points: message.count,
      step: message.step,
      colors,
      first: Array.from(message.points.subarray(0, 3 * 1024)),
    };
  }

  protected override partAt(message: Cloud, object: THREE.Object3D, hit: Hit): PickedPart {
    return { ...super.partAt(message, object, hit), title: "Point" };
  }

  protected override *partsOf(message: Cloud, object: THREE.Object3D): Iterable<Hit> {
    object.updateWorldMatrix(true, false);
    const hit = { object, point: new THREE.Vector3(), index: 0 };
    for (; hit.index < message.count; hit.index++) {
      hit.point.fromArray(message.points, hit.index * 3).applyMatrix4(object.matrixWorld);
      yield hit;
    }
  }

  private mode(message: Cloud): "rgb" | "scalar" | "axis" | "flat" {
    const transformer = this.options.choice("Color Transformer");
    if (transformer === "RGB8" && message.rgba) return "rgb";
    if (transformer === "AxisColor") return "axis";
    if ((transformer === "Intensity" || transformer === "Distance") && message.scalar) return "scalar";
    return "flat";
  }

  private material(mode: "rgb" | "scalar" | "axis" | "flat", message: Cloud): THREE.ShaderMaterial {
    const alpha = this.options.number("Alpha");
    const style = this.options.choice("Style");
    const material = new THREE.ShaderMaterial({
      transparent: alpha < 1,
      depthWrite: alpha >= 0.5,
      defines: {
        [`BY_${mode.toUpperCase()}`]: 1,
        ...(this.options.flag("Use Fixed Frame") ? {} : { OWN_AXIS: 1 }),
        ...(style === "Points" ? {} : { IN_METERS: 1 }),
        ...(style === "Spheres" ? { ROUND: 1 } : {}),
        ...(this.context.distinct() ? { DISTINCT: 1 } : {}),
      },
      uniforms: {
        alpha: { value: alpha },
        flatColor: { value: srgb(this.options.color("Color")) },
        axis: { value: "XYZ".indexOf(this.options.choice("Axis")) },
        range: { value: new THREE.Vector2(...message.range) },
        size: { value: this.options.number(style === "Points" ? "Size (Pixels)" : "Size (m)") },
        height: { value: 1 },
      },
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
    });
    material.onBeforeRender = (renderer): void => {
      const height = style === "Points" ? renderer.getPixelRatio() : renderer.getCurrentViewport(VIEWPORT).w;
      (material.uniforms.height as THREE.IUniform<number>).value = height;
      material.uniformsNeedUpdate = true;
    };
    return material;
  }

  protected override onPose(object: THREE.Object3D, message: Cloud): void {
    if (this.mode(message) !== "axis" || object.userData.rangeFrame === this.context.model.fixed) return;
    object.userData.rangeFrame = this.context.model.fixed;
    object.updateMatrixWorld();
    const pose = this.options.flag("Use Fixed Frame") ? object.matrixWorld : new THREE.Matrix4();
    const axis = "XYZ".indexOf(this.options.choice("Axis"));
    const material = (object as THREE.Points).material as THREE.ShaderMaterial;
    const range = material.uniforms.range as THREE.IUniform<THREE.Vector2>;
    range.value.set(...axisRange(message, pose, axis));
  }
}

/** The range of the transformed points along an axis, estimated from a sample. */
function axisRange(message: Cloud, pose: THREE.Matrix4, axis: number): [number, number] {
  const step = Math.max(1, Math.floor(message.count / SAMPLES));
  const e = pose.elements;
  let low = Infinity;
  let high = -Infinity;
  for (let i = 0; i < message.count; i += step) {
    const [x, y, z] = message.points.subarray(i * 3, i * 3 + 3) as unknown as [number, number, number];
    const value =
      (e[axis] as number) * x + (e[4 + axis] as number) * y + (e[8 + axis] as number) * z + (e[12 + axis] as number);
    if (value < low) low = value;
    if (value > high) high = value;
  }
  // Points of equal height get the color in the middle of the scale instead of amplified noise.
  return high - low > 1e-3 ? [low, high] : [low - 0.5, low + 0.5];
}

const VERTEX = `
  uniform float size, height;
  uniform vec2 range;
  uniform int axis;
  uniform vec3 flatColor;
  #ifdef BY_RGB
    attribute vec4 rgba;
  #endif
  #ifdef BY_SCALAR
    attribute float scalar;
  #endif
  varying vec3 color;

  // Turbo (polynomial fit by A. Mikhailov), or a blue-to-yellow scale for color-blind users.
  vec3 scale(float t) {
    t = clamp(t, 0.0, 1.0);
    #ifdef DISTINCT
      return mix(mix(vec3(0.13, 0.35, 0.72), vec3(0.62, 0.62, 0.6), smoothstep(0.0, 0.55, t)), vec3(0.99, 0.91, 0.2), smoothstep(0.45, 1.0, t));
    #else
      const vec4 r4 = vec4(0.13572138, 4.61539260, -42.66032258, 132.13108234);
      const vec4 g4 = vec4(0.09140261, 2.19418839, 4.84296658, -14.18503333);
      const vec4 b4 = vec4(0.10667330, 12.64194608, -60.58204836, 110.36276771);
      const vec2 r2 = vec2(-152.94239396, 59.28637943);
      const vec2 g2 = vec2(4.27729857, 2.82956604);
      const vec2 b2 = vec2(-89.90310912, 27.34824973);
      vec4 v4 = vec4(1.0, t, t * t, t * t * t);
      vec2 v2 = v4.zw * v4.z;
      return vec3(dot(v4, r4) + dot(v2, r2), dot(v4, g4) + dot(v2, g2), dot(v4, b4) + dot(v2, b2));
    #endif
  }

  void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * viewMatrix * world;
    float spread = max(range.y - range.x, 1e-6);
    #if defined(BY_RGB)
      color = rgba.rgb;
    #elif defined(BY_SCALAR)
      color = scale((scalar - range.x) / spread);
    #elif defined(BY_AXIS) && defined(OWN_AXIS)
      color = scale((position[axis] - range.x) / spread);
    #elif defined(BY_AXIS)
      color = scale((world[axis] - range.x) / spread);
    #else
      color = flatColor;
    #endif
    #ifdef IN_METERS
      gl_PointSize = max(1.5, 0.5 * size * height * projectionMatrix[1][1] / max(gl_Position.w, 1e-3));
    #else
      gl_PointSize = size * height;
    #endif
  }`;

const FRAGMENT = `
  uniform float alpha;
  varying vec3 color;
  void main() {
    #ifdef ROUND
      if (length(gl_PointCoord - 0.5) > 0.5) discard;
    #endif
    gl_FragColor = vec4(color, alpha);
  }`;
