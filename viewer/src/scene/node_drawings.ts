// SPDX-License-Identifier: Apache-2.0
/** What is drawn of a node that a program has added: axes, points, lines, a mesh, text or an image. */

import * as THREE from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import type { NodeGeometry, SceneNode } from "../protocol/messages";
import type { Palette } from "../util/theme";
import { axesGeometry } from "./frames";
import { textSprite } from "./text_sprite";

const VIEWPORT = new THREE.Vector4();
/** The color of nodes without one. */
const DEFAULT_COLOR: [number, number, number] = [0.3, 0.63, 0.96];

/** Returns the object of a node; null if it draws nothing, or its geometry has not arrived yet. */
export function drawNode(node: SceneNode, geometry: NodeGeometry | null, palette: Palette): THREE.Object3D | null {
  if (node.kind === "frame") return node.size > 0 ? axes(node, palette) : null;
  if (node.kind === "text") return text(node, palette);
  if (!geometry) return null;
  const object = fromGeometry(node, geometry);
  object.position.fromArray(geometry.offset);
  return object;
}

function fromGeometry(node: SceneNode, geometry: NodeGeometry): THREE.Object3D {
  switch (node.kind) {
    case "points":
      return points(node, geometry);
    case "lines":
      return lines(node, geometry);
    case "image":
      return image(node, geometry);
    default:
      return mesh(node, geometry);
  }
}

function colorOf(node: SceneNode, other?: string): THREE.Color {
  if (!node.color && other) return new THREE.Color(other);
  return new THREE.Color().setRGB(...(node.color ?? DEFAULT_COLOR), THREE.SRGBColorSpace);
}

function transparency({ opacity }: SceneNode): { transparent: boolean; opacity: number; depthWrite: boolean } {
  return { transparent: opacity < 1, opacity, depthWrite: opacity >= 1 };
}

/** Text on top of everything else, because a half hidden text cannot be read. */
function text(node: SceneNode, palette: Palette): THREE.Object3D | null {
  const object = textSprite(node.text, colorOf(node, palette.measure), node.size, node.opacity);
  if (object) {
    object.material.depthTest = false;
    object.renderOrder = 11;
  }
  return object;
}

function axes(node: SceneNode, palette: Palette): THREE.Object3D {
  const object = new THREE.Mesh(axesGeometry(palette, 0.03), makeMaterial(node, "axes"));
  object.scale.setScalar(node.size);
  return object;
}

function points(node: SceneNode, { vertices, colors }: NodeGeometry): THREE.Object3D {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(vertices, 3));
  if (colors.length > 0) geometry.setAttribute("rgba", new THREE.BufferAttribute(colors, 4, true));
  const object = new THREE.Points(geometry, makeMaterial(node, colors.length > 0 ? "colored" : "plain"));
  object.frustumCulled = false;
  return object;
}

function lines(node: SceneNode, { vertices, colors }: NodeGeometry): THREE.Object3D {
  const geometry = new LineSegmentsGeometry().setPositions(vertices);
  if (colors.length > 0) geometry.setColors(linear(colors));
  const material = new LineMaterial({ linewidth: node.size, vertexColors: colors.length > 0, ...transparency(node) });
  if (colors.length === 0) material.color.copy(colorOf(node));
  const object = new LineSegments2(geometry, material);
  object.frustumCulled = false;
  object.visible = vertices.length > 0;
  return object;
}

function mesh(node: SceneNode, { vertices, indices, colors }: NodeGeometry): THREE.Object3D {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(vertices, 3));
  geometry.setIndex(new THREE.BufferAttribute(indices, 1));
  geometry.computeVertexNormals();
  const colored = colors.length > 0;
  if (colored) geometry.setAttribute("color", new THREE.BufferAttribute(linear(colors), 3));
  const { wireframe } = node;
  const material = new THREE.MeshLambertMaterial({
    vertexColors: colored,
    wireframe,
    side: THREE.DoubleSide,
    ...transparency(node),
  });
  if (!colored) material.color.copy(colorOf(node));
  return new THREE.Mesh(geometry, material);
}

/** The image with x to the right and y to its lower edge, as in an optical frame. */
function image(node: SceneNode, { colors, width }: NodeGeometry): THREE.Object3D {
  const columns = Math.max(1, width);
  const rows = Math.max(1, Math.floor(colors.length / 4 / columns));
  const texture = new THREE.DataTexture(colors, columns, rows);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.magFilter = THREE.NearestFilter;
  texture.minFilter = THREE.LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.needsUpdate = true;
  const opaque = node.opacity >= 1 && colors.every((value, i) => i % 4 < 3 || value === 255);
  const material = new THREE.MeshBasicMaterial({
    map: texture,
    side: THREE.DoubleSide,
    transparent: !opaque,
    opacity: node.opacity,
  });
  return new THREE.Mesh(new THREE.PlaneGeometry(node.size, (node.size * rows) / columns), material);
}

/** Converts sRGB bytes to the linear colors that three.js expects of vertices. */
function linear(colors: Uint8Array): Float32Array {
  const table = Float32Array.from({ length: 256 }, (_, i) => new THREE.Color().setRGB(i / 255, 0, 0, "srgb").r);
  const out = new Float32Array((colors.length / 4) * 3);
  for (let i = 0, k = 0; i < colors.length; i++) if (i % 4 < 3) out[k++] = table[colors[i] as number] as number;
  return out;
}

/** A material that writes sRGB colors unchanged; three.js would convert them from linear colors. */
function makeMaterial(node: SceneNode, kind: "axes" | "plain" | "colored"): THREE.ShaderMaterial {
  const [red, green, blue] = node.color ?? DEFAULT_COLOR;
  const material = new THREE.ShaderMaterial({
    vertexColors: kind === "axes",
    defines: { [kind.toUpperCase()]: 1 },
    transparent: node.opacity < 1 || kind === "colored",
    uniforms: {
      flatColor: { value: new THREE.Vector4(red, green, blue, 1) },
      opacity: { value: node.opacity },
      size: { value: node.size },
      height: { value: 1 },
    },
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
  });
  material.onBeforeRender = (renderer): void => {
    (material.uniforms.height as THREE.IUniform<number>).value = renderer.getCurrentViewport(VIEWPORT).w;
    material.uniformsNeedUpdate = true;
  };
  return material;
}

const VERTEX = `
  uniform vec4 flatColor;
  uniform float size, height;
  #ifdef COLORED
    attribute vec4 rgba;
  #endif
  varying vec4 color;
  void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    #if defined(AXES)
      color = vec4(color * (0.72 + 0.28 * abs(normalize(normalMatrix * normal).z)), 1.0);
    #else
      #ifdef COLORED
        color = rgba;
      #else
        color = flatColor;
      #endif
      gl_PointSize = max(1.5, 0.5 * size * height * projectionMatrix[1][1] / max(gl_Position.w, 1e-3));
    #endif
  }`;

const FRAGMENT = `
  uniform float opacity;
  varying vec4 color;
  void main() {
    #ifndef AXES
      if (length(gl_PointCoord - 0.5) > 0.5) discard;
    #endif
    gl_FragColor = vec4(color.rgb, color.a * opacity);
  }`;
