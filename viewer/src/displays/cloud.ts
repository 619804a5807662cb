// SPDX-License-Identifier: Apache-2.0
/** The LaserScan and PointCloud2 displays: points, colored on the graphics card. */

import * as THREE from "three";
import { srgb } from "../scene/frames";
import type { Cloud, DisplayOptions } from "../protocol/messages";
import type { PickedPart } from "../model/picked";
import type { Hit } from "../scene/picking";
import { MessageDisplay } from "./display";
import { cloudColors } from "./cloud_colors";
import { topicColor } from "./topic_colors";

const SAMPLES = 4096;
const MAX_SHADES = 64;
const VIEWPORT = new THREE.Vector4();
/** Heights that differ less than this have one color; the scale would show their noise. */
const MIN_HEIGHT_RANGE_M = 1e-3;
/** Software rendering takes 2.5 microseconds per point, during which the page blocks. */
const MAX_POINTS_IN_SOFTWARE = 40_000;

export type CloudClass =
  | "DepthCloud"
  | "FluidPressure"
  | "Illuminance"
  | "LaserScan"
  | "PointCloud"
  | "PointCloud2"
  | "RelativeHumidity"
  | "Temperature";

export class CloudDisplay extends MessageDisplay<Cloud, CloudClass> {
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
    const points = new THREE.Points(geometry, this.material(mode));
    const fixed = this.fixedRange(mode);
    if (fixed) rangeOf(points).value.set(...fixed);
    else if (mode === "scalar") this.setOwnRange(points, ...message.range);
    points.frustumCulled = false;
    return points;
  }

  protected override describe(message: Cloud, object: THREE.Object3D): Record<string, unknown> {
    const colors = rangeOf(object).value.toArray();
    const shade = cloudColors(object as THREE.Points, this.context.distinct());
    return {
      points: message.count,
      step: message.step,
      colors,
      style: this.options.choice("Style"),
      shades: Array.from({ length: Math.min(message.count, MAX_SHADES) }, (_, i) => shade(i)),
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
    if (message.rgba) return "rgb";
    if (transformer === "AxisColor") return "axis";
    return transformer !== "FlatColor" && message.scalar ? "scalar" : "flat";
  }

  /** The range of values that the color scale covers, or null if it is that of each message. */
  private fixedRange(mode: string): [number, number] | null {
    const { options } = this;
    const byIntensity = mode === "scalar" && options.choice("Color Transformer") === "Intensity";
    if (byIntensity && !options.flag("Autocompute Intensity Bounds"))
      return [options.number("Min Intensity"), options.number("Max Intensity")];
    if (mode === "axis" && !options.flag("Autocompute Value Bounds/Value"))
      return [
        options.number("Autocompute Value Bounds/Min Value"),
        options.number("Autocompute Value Bounds/Max Value"),
      ];
    return null;
  }

  /**
   * Sets the range of the color scale to that of a message. A cloud with one value has the color of its topic, so that
   * several flat scans differ, unless the user or a file has chosen what the colors show.
   */
  private setOwnRange(object: THREE.Object3D, low: number, high: number, isFlat = low === high): void {
    const { uniforms } = (object as THREE.Points).material as THREE.ShaderMaterial;
    (uniforms.plain as THREE.IUniform<boolean>).value = isFlat && !this.options.isSet("Color Transformer");
    rangeOf(object).value.set(low, high);
  }

  private material(mode: "rgb" | "scalar" | "axis" | "flat"): THREE.ShaderMaterial {
    const alpha = this.options.number("Alpha");
    const style = this.options.choice("Style");
    const byIntensity = mode === "scalar" && this.options.choice("Color Transformer") === "Intensity";
    const material = new THREE.ShaderMaterial({
      transparent: alpha < 1,
      depthWrite: alpha >= 0.5,
      defines: {
        [`BY_${mode.toUpperCase()}`]: 1,
        ...(this.options.flag("Use Fixed Frame") ? {} : { OWN_AXIS: 1 }),
        ...(style === "Points" ? {} : { IN_METERS: 1 }),
        ...(style === "Spheres" ? { SOLID: 1, SPHERES: 1 } : {}),
        ...(style === "Boxes" ? { SOLID: 1, BOXES: 1 } : {}),
        ...(this.hasRainbow ? {} : { TWO_COLORS: 1 }),
        ...(this.options.flag("Invert Rainbow") && byIntensity ? { INVERTED: 1 } : {}),
        ...(this.context.distinct() ? { DISTINCT: 1 } : {}),
      },
      uniforms: {
        alpha: { value: alpha },
        flatColor: { value: srgb(this.options.color("Color")) },
        axis: { value: "XYZ".indexOf(this.options.choice("Axis")) },
        range: { value: new THREE.Vector2(0, 1) },
        plain: { value: false },
        topicColor: { value: srgb(topicColor(this.config.topic ?? "")) },
        low: { value: srgb(this.options.color("Min Color")) },
        high: { value: srgb(this.options.color("Max Color")) },
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

  /** Whether values have the colors of the rainbow, and not those between two colors. */
  private get hasRainbow(): boolean {
    return this.options.choice("Color Transformer") !== "Intensity" || this.options.flag("Use rainbow");
  }

  protected override onPose(object: THREE.Object3D, message: Cloud): void {
    const mode = this.mode(message);
    if (mode !== "axis" || this.fixedRange(mode) || object.userData.rangeFrame === this.context.model.fixed) return;
    object.userData.rangeFrame = this.context.model.fixed;
    object.updateMatrixWorld();
    const pose = this.options.flag("Use Fixed Frame") ? object.matrixWorld : new THREE.Matrix4();
    const [low, high] = axisRange(message, pose, "XYZ".indexOf(this.options.choice("Axis")));
    // Points of equal height get the color in the middle of the scale instead of amplified noise.
    if (high - low > MIN_HEIGHT_RANGE_M) this.setOwnRange(object, low, high);
    else this.setOwnRange(object, low - 0.5, low + 0.5, true);
  }
}

function rangeOf(object: THREE.Object3D): THREE.IUniform<THREE.Vector2> {
  const { uniforms } = (object as THREE.Points).material as THREE.ShaderMaterial;
  return uniforms.range as THREE.IUniform<THREE.Vector2>;
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
  return low <= high ? [low, high] : [0, 1];
}

const VERTEX = `
  uniform float size, height;
  uniform vec2 range;
  uniform int axis;
  uniform bool plain;
  uniform vec3 flatColor, topicColor, low, high;
  #ifdef BY_RGB
    attribute vec4 rgba;
  #endif
  #ifdef BY_SCALAR
    attribute float scalar;
  #endif
  varying vec3 color;
  #ifdef SOLID
    varying vec3 center;
    varying mat3 turn;
    varying vec4 depthRow;
    varying float spread3;
  #endif

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

  // The smallest value is red, as in RViz, unless the scale is inverted.
  vec3 paint(float t) {
    if (plain) return topicColor;
    #ifdef TWO_COLORS
      return mix(low, high, clamp(t, 0.0, 1.0));
    #elif defined(INVERTED)
      return scale(t);
    #else
      return scale(1.0 - t);
    #endif
  }

  void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * viewMatrix * world;
    float spread = max(range.y - range.x, 1e-6);
    #if defined(BY_RGB)
      color = rgba.rgb;
    #elif defined(BY_SCALAR)
      color = paint((scalar - range.x) / spread);
    #elif defined(BY_AXIS) && defined(OWN_AXIS)
      color = paint((position[axis] - range.x) / spread);
    #elif defined(BY_AXIS)
      color = paint((world[axis] - range.x) / spread);
    #else
      color = flatColor;
    #endif
    #ifdef SOLID
      center = (viewMatrix * world).xyz;
      turn = mat3(viewMatrix) * mat3(modelMatrix);
      depthRow = vec4(projectionMatrix[2][2], projectionMatrix[3][2], projectionMatrix[2][3], projectionMatrix[3][3]);
      // A corner of a box is this far from its center; a perspective enlarges it a little.
      spread3 = 1.9 * size;
      gl_PointSize = max(1.5, 0.5 * spread3 * height * projectionMatrix[1][1] / max(gl_Position.w, 1e-3));
    #elif defined(IN_METERS)
      gl_PointSize = max(1.5, 0.5 * size * height * projectionMatrix[1][1] / max(gl_Position.w, 1e-3));
    #else
      gl_PointSize = size * height;
    #endif
  }`;

const FRAGMENT = `
  uniform float alpha, size;
  varying vec3 color;
  #ifdef SOLID
    varying vec3 center;
    varying mat3 turn;
    varying vec4 depthRow;
    varying float spread3;
  #endif
  void main() {
    #ifdef SOLID
      // The ray through this pixel, in the coordinates of the camera.
      vec3 pixel = center + vec3(gl_PointCoord.x - 0.5, 0.5 - gl_PointCoord.y, 0.0) * spread3;
      vec3 from = isOrthographic ? vec3(pixel.xy, 0.0) : vec3(0.0);
      vec3 ray = isOrthographic ? vec3(0.0, 0.0, -1.0) : normalize(pixel);
      vec3 start = from - center;
      #ifdef BOXES
        vec3 o = start * turn;
        vec3 d = ray * turn;
        vec3 inverse = 1.0 / (abs(d) + 1e-9) * (step(0.0, d) * 2.0 - 1.0);
        vec3 entry = -o * inverse - abs(inverse) * 0.5 * size;
        vec3 exit = -o * inverse + abs(inverse) * 0.5 * size;
        float at = max(max(entry.x, entry.y), entry.z);
        if (at > min(min(exit.x, exit.y), exit.z)) discard;
        vec3 normal = turn * (-sign(d) * step(entry.yzx, entry.xyz) * step(entry.zxy, entry.xyz));
      #else
        float along = dot(start, ray);
        float under = along * along - dot(start, start) + 0.25 * size * size;
        if (under < 0.0) discard;
        float at = -along - sqrt(under);
        vec3 normal = normalize(start + at * ray);
      #endif
      float z = from.z + at * ray.z;
      gl_FragDepth = 0.5 + 0.5 * (depthRow.x * z + depthRow.y) / (depthRow.z * z + depthRow.w);
      gl_FragColor = vec4(color * (0.55 + 0.45 * abs(dot(normal, ray))), alpha);
    #else
      gl_FragColor = vec4(color, alpha);
    #endif
  }`;
